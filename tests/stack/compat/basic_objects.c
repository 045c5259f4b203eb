// SPDX-License-Identifier: Apache-2.0
// Objects of 8, 16 and 32 bits: the table, its flags, and the access of the application by entry and by value.
#include "co_core.h"
#include "fakes.h"
#include "unity.h"

static uint8_t ErrorRegister;
static uint32_t EmergencyId = 0x80;
static uint32_t Identity[] = {0x0000CAFE, 0x00000002};
static uint32_t Position = 0x11223344;
static uint16_t Speed = 0x5566;
static uint8_t Gear = 0x77;
static int16_t Temperature = -2;
static uint8_t Loaded = 5;
static uint32_t Channel = 0x600;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1014, 0, CO_OBJ__N__R_), CO_TUNSIGNED32, (CO_DATA)(&EmergencyId)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1018, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&Identity[0])},
    {CO_KEY(0x1018, 2, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&Identity[1])},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ__N__R_), CO_TUNSIGNED32, (CO_DATA)(&Channel)},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x2400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x2400, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&Position)},
    {CO_KEY(0x2400, 2, CO_OBJ____PRW), CO_TUNSIGNED16, (CO_DATA)(&Speed)},
    {CO_KEY(0x2400, 3, CO_OBJ______W), CO_TUNSIGNED8, (CO_DATA)(&Gear)},
    {CO_KEY(0x2400, 4, CO_OBJ___APR_), CO_TSIGNED16, (CO_DATA)(&Temperature)},
    {CO_KEY(0x2401, 0, CO_OBJ_______), CO_TUNSIGNED8, (CO_DATA)(&Loaded)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;

void setUp(void) {
  Position = 0x11223344;
  Speed = 0x5566;
  Gear = 0x77;
  Loaded = 5;
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

static void test_values_are_read_in_the_width_of_their_type(void) {
  uint8_t byte = 0;
  uint16_t word = 0;
  uint32_t value = 0;
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdLong(&Node.Dict, CO_DEV(0x2400, 1), &value));
  TEST_ASSERT_EQUAL_HEX32(0x11223344, value);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdWord(&Node.Dict, CO_DEV(0x2400, 2), &word));
  TEST_ASSERT_EQUAL_HEX16(0x5566, word);
  ErrorRegister = 0x11; /* written by the node */
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdByte(&Node.Dict, CO_DEV(0x1001, 0), &byte));
  TEST_ASSERT_EQUAL_HEX8(0x11, byte);
}

static void test_values_are_written_in_the_width_of_their_type(void) {
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrLong(&Node.Dict, CO_DEV(0x2400, 1), 0xA1A2A3A4));
  TEST_ASSERT_EQUAL_HEX32(0xA1A2A3A4, Position);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrWord(&Node.Dict, CO_DEV(0x2400, 2), 0xB1B2));
  TEST_ASSERT_EQUAL_HEX16(0xB1B2, Speed);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrByte(&Node.Dict, CO_DEV(0x2400, 3), 0xC1));
  TEST_ASSERT_EQUAL_HEX8(0xC1, Gear);
}

static void test_another_width_is_refused(void) {
  uint32_t value = 0;
  uint16_t word = 0;
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_SIZE, CODictRdLong(&Node.Dict, CO_DEV(0x2400, 2), &value));
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_SIZE, CODictRdWord(&Node.Dict, CO_DEV(0x2400, 1), &word));
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_SIZE, CODictWrByte(&Node.Dict, CO_DEV(0x2400, 2), 1));
  TEST_ASSERT_EQUAL_HEX16(0x5566, Speed);
}

static void test_missing_entries_and_null_arguments_are_refused(void) {
  uint32_t value = 0;
  TEST_ASSERT_EQUAL(CO_ERR_OBJ_NOT_FOUND, CODictRdLong(&Node.Dict, CO_DEV(0x2345, 0x56), &value));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, CODictRdLong(&Node.Dict, CO_DEV(0x2400, 1), NULL));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, CODictRdLong(NULL, CO_DEV(0x2400, 1), &value));
  TEST_ASSERT_NULL(CODictFind(&Node.Dict, CO_DEV(0x2345, 0x56)));
  TEST_ASSERT_NULL(CODictFind(NULL, CO_DEV(0x2400, 1)));
  TEST_ASSERT_NULL(CODictFind(&Node.Dict, 0));
}

static void test_an_entry_is_found_once_and_read_often(void) {
  uint32_t value = 0;
  uint32_t rounds = 0;
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x2400, 1));
  TEST_ASSERT_NOT_NULL(obj);
  TEST_ASSERT_EQUAL_PTR(&Dictionary[10], obj);
  Position = 0;
  do {
    TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjRdValue(obj, &Node, &value, sizeof(value)));
    Position = rounds++;
  } while (value == 0);
  TEST_ASSERT_EQUAL_UINT32(1, value);
}

static void test_a_found_entry_is_written(void) {
  uint16_t word = 0x0102;
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_DEV(0x2400, 2));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COObjWrValue(obj, &Node, &word, sizeof(word)));
  TEST_ASSERT_EQUAL_HEX16(0x0102, Speed);
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COObjWrValue(NULL, &Node, &word, sizeof(word)));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COObjWrValue(obj, NULL, &word, sizeof(word)));
  TEST_ASSERT_EQUAL(CO_ERR_BAD_ARG, COObjWrValue(obj, &Node, NULL, sizeof(word)));
}

static void test_flags_of_the_search_key_are_ignored(void) {
  CO_OBJ* obj = CODictFind(&Node.Dict, CO_KEY(0x2400, 1, CO_OBJ______W));
  TEST_ASSERT_EQUAL_PTR(&Dictionary[10], obj);
}

static void test_a_direct_value_is_read_by_application_and_network(void) {
  uint8_t byte = 0;
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdByte(&Node.Dict, CO_DEV(0x2400, 0), &byte));
  TEST_ASSERT_EQUAL(4, byte);
  BusReceive(&Node, "601#4000240000000000");
  TEST_ASSERT_SENT("581#4F00240004000000");
}

static void test_a_node_id_relative_value_is_read_with_the_node_id(void) {
  uint32_t value = 0;
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdLong(&Node.Dict, CO_DEV(0x1014, 0), &value));
  TEST_ASSERT_EQUAL_HEX32(0x81, value);
  BusReceive(&Node, "601#4014100000000000");
  TEST_ASSERT_SENT("581#4314100081000000");
  TEST_ASSERT_EQUAL_HEX32(0x80, EmergencyId);
}

static void test_the_network_reads_and_writes(void) {
  BusReceive(&Node, "601#4000240100000000");
  TEST_ASSERT_SENT("581#4300240144332211");
  BusReceive(&Node, "601#23002401D4C3B2A1");
  TEST_ASSERT_SENT("581#6000240100000000");
  TEST_ASSERT_EQUAL_HEX32(0xA1B2C3D4, Position);
  BusReceive(&Node, "601#4000240400000000");
  TEST_ASSERT_SENT("581#4B002404FEFF0000");
}

static void test_rights_limit_the_network_but_not_the_application(void) {
  BusReceive(&Node, "601#2F00240005000000");
  TEST_ASSERT_SENT("581#8000240002000106");
  BusReceive(&Node, "601#4000240300000000");
  TEST_ASSERT_SENT("581#8000240301000106");
  BusReceive(&Node, "601#4001240000000000");
  TEST_ASSERT_SENT("581#8001240000000106");
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictWrByte(&Node.Dict, CO_DEV(0x2401, 0), 6));
  TEST_ASSERT_EQUAL(6, Loaded);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_values_are_read_in_the_width_of_their_type);
  RUN_TEST(test_values_are_written_in_the_width_of_their_type);
  RUN_TEST(test_another_width_is_refused);
  RUN_TEST(test_missing_entries_and_null_arguments_are_refused);
  RUN_TEST(test_an_entry_is_found_once_and_read_often);
  RUN_TEST(test_a_found_entry_is_written);
  RUN_TEST(test_flags_of_the_search_key_are_ignored);
  RUN_TEST(test_a_direct_value_is_read_by_application_and_network);
  RUN_TEST(test_a_node_id_relative_value_is_read_with_the_node_id);
  RUN_TEST(test_the_network_reads_and_writes);
  RUN_TEST(test_rights_limit_the_network_but_not_the_application);
  return UNITY_END();
}
