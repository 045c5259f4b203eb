// SPDX-License-Identifier: Apache-2.0
// A C++ program that includes the C headers inside extern "C" { }, as the quickstart of CANopen-Stack does.
extern "C" {
#include "co_core.h"
}

#include "fakes.h"
#include "lexican/dictionary.hpp"
#include "unity.h"

namespace {

uint8_t error_register;
uint16_t heartbeat_time = 100;
uint32_t counter = 0x11223344;

constexpr CO_OBJ dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)(&counter)},
    CO_OBJ_DICT_ENDMARK,
};
CO_OD_CHECK(dictionary);

CO_NODE node;

void test_a_node_answers() {
  FakesReset();
  NodeUp(&node, dictionary, sizeof dictionary / sizeof dictionary[0]);
  BusReceive(&node, "601#4000210000000000");
  TEST_ASSERT_SENT("581#4300210044332211");
}

void test_the_compiler_finds_entries() {
  static_assert(co::find(dictionary, CO_DEV(0x2100, 0)) == &dictionary[8]);
  TEST_ASSERT_EQUAL_HEX32(counter, *static_cast<uint32_t*>(dictionary[8].Data));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_node_answers);
  RUN_TEST(test_the_compiler_finds_entries);
  return UNITY_END();
}
