// SPDX-License-Identifier: Apache-2.0
// Positional initialisers with fewer values than members: the other members are 0.
#include "co_core.h"
#include "fakes.h"
#include "unity.h"

static uint32_t PlainSize(CO_OBJ* obj, CO_NODE* node, uint32_t width) { return CO_TUNSIGNED8->Size(obj, node, width); }

static CO_ERR PlainRead(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return CO_TUNSIGNED8->Read(obj, node, buffer, size);
}

static CO_ERR PlainWrite(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return CO_TUNSIGNED8->Write(obj, node, buffer, size);
}

static const CO_OBJ_TYPE FourFunctions = {PlainSize, 0, PlainRead, PlainWrite};
static const CO_OBJ_TYPE ThreeFunctions = {PlainSize, 0, PlainRead};

static uint8_t First = 1;
static uint8_t Second = 2;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2000, 1, CO_OBJ_____RW), &FourFunctions, (CO_DATA)(&First)},
    {CO_KEY(0x2000, 2, CO_OBJ_____RW), &ThreeFunctions, (CO_DATA)(&Second)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_IF_DRV Drivers = {&FakeCanDriver, &FakeCyclicTimerDriver};
static CO_NODE Node;

static void Start(void) {
  CO_NODE_SPEC spec = {3, 125000, (CO_OBJ*)Dictionary, 7, NULL, NULL, 0, 1000, &Drivers};
  FakesReset();
  CONodeInit(&Node, &spec);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NONE, CONodeGetErr(&Node));
  CONodeStart(&Node);
  TEST_ASSERT_SENT("703#00");
}

static void test_a_specification_without_sdo_buffer_serves_short_and_long_values(void) {
  Start();
  BusReceive(&Node, "603#4000200100000000");
  TEST_ASSERT_SENT("583#4F00200101000000");
}

static void test_a_type_with_four_functions_needs_no_reset(void) {
  Start();
  BusReceive(&Node, "603#2F00200105000000");
  TEST_ASSERT_SENT("583#6000200100000000");
  TEST_ASSERT_EQUAL_UINT8(5, First);
}

static void test_a_type_with_three_functions_cannot_be_written(void) {
  Start();
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_ACC, CODictWrByte(&Node.Dict, CO_DEV(0x2000, 2), 5));
  TEST_ASSERT_EQUAL_UINT8(2, Second);
  BusReceive(&Node, "603#4000200200000000");
  TEST_ASSERT_SENT("583#4F00200202000000");
}

static void test_an_entry_without_data_is_a_direct_zero(void) {
  Start();
  BusReceive(&Node, "603#4000100000000000");
  TEST_ASSERT_SENT("583#4300100000000000");
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_specification_without_sdo_buffer_serves_short_and_long_values);
  RUN_TEST(test_a_type_with_four_functions_needs_no_reset);
  RUN_TEST(test_a_type_with_three_functions_cannot_be_written);
  RUN_TEST(test_an_entry_without_data_is_a_direct_zero);
  return UNITY_END();
}
