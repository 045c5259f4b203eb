// SPDX-License-Identifier: Apache-2.0
// Uses the tables of mixed_table.c, which may be compiled in the other language. Both files read and write the same
// entries: a link-time optimiser that treats their types as different fails the test.
#include "fakes.h"
#include "mixed.h"
#include "unity.h"

static CO_NODE Node;

static void test_a_table_of_the_other_language_serves_the_node(void) {
  NodeUp(&Node, MixedTable, MIXED_ENTRIES);
  BusReceive(&Node, "601#4000100000000000");
  TEST_ASSERT_SENT("581#4300100091010000");
  BusReceive(&Node, "601#4000200000000000");
  TEST_ASSERT_SENT("581#430020000DF0FECA");
  BusReceive(&Node, "601#4001200000000000");
  TEST_ASSERT_SENT("581#4F0120000A000000");
}

static void test_entries_are_the_same_memory_on_both_sides(void) {
  for (uint32_t i = 0; i < 4; i++) {
    MixedDynamic[1].Data = (CO_DATA)(i);
    MixedDynamic[1].Key = CO_KEY(0x3000, 1, CO_OBJ_D___RW);
    MixedSet(&MixedDynamic[1], i + 100);
    TEST_ASSERT_EQUAL_UINT32(i + 100, (uint32_t)MixedDynamic[1].Data);
    TEST_ASSERT_EQUAL_HEX32(CO_KEY(0x3000, 1, CO_OBJ_D___RW | CO_OBJ_T1), MixedDynamic[1].Key);
    MixedDynamic[1].Data = (CO_DATA)(i + 7);
    TEST_ASSERT_EQUAL_UINT32(i + 7, MixedGet(&MixedDynamic[1]));
  }
}

static void test_the_data_of_an_entry_is_used_as_address_and_as_number(void) {
  uint32_t* address = (uint32_t*)MixedTable[4].Data;
  TEST_ASSERT_EQUAL_PTR(&MixedLong, address);
  TEST_ASSERT_EQUAL_HEX32(0x191, MixedGet(&MixedTable[0]));
  TEST_ASSERT_TRUE(MixedTable[1].Data == 0);
}

static void test_a_parameter_group_is_the_same_on_both_sides(void) {
  const uint8_t* start = MixedGroup.Start;
  TEST_ASSERT_EQUAL_PTR(MixedBytes, start);
  TEST_ASSERT_EQUAL_UINT8(3, MixedGroup.Start[2]);
  TEST_ASSERT_TRUE(MixedGroup.Default == NULL);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_table_of_the_other_language_serves_the_node);
  RUN_TEST(test_entries_are_the_same_memory_on_both_sides);
  RUN_TEST(test_the_data_of_an_entry_is_used_as_address_and_as_number);
  RUN_TEST(test_a_parameter_group_is_the_same_on_both_sides);
  return UNITY_END();
}
