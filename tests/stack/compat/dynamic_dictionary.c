// SPDX-License-Identifier: Apache-2.0
// A dictionary in RAM that the application fills at run time, and extends later.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#define DYNAMIC_LENGTH 32u

typedef struct DYNAMIC_DICTIONARY {
  CO_OBJ Root[DYNAMIC_LENGTH];
  uint16_t Used;
} DYNAMIC_DICTIONARY;

static DYNAMIC_DICTIONARY Dynamic;
static CO_NODE Node;
static uint8_t ErrorRegister;
static uint32_t Values[8];

/* Appends an entry and moves the end mark behind it. Entries must be added in ascending order. */
static void Append(DYNAMIC_DICTIONARY* self, uint32_t key, const CO_OBJ_TYPE* type, CO_DATA data) {
  const CO_OBJ end = CO_OBJ_DICT_ENDMARK;
  CO_OBJ* obj = &self->Root[self->Used];
  TEST_ASSERT_LESS_THAN(DYNAMIC_LENGTH - 1, self->Used);
  obj->Key = key;
  obj->Type = type;
  obj->Data = data;
  self->Used++;
  self->Root[self->Used] = end;
}

static void AppendMandatory(DYNAMIC_DICTIONARY* self) {
  Append(self, CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0));
  Append(self, CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister));
  Append(self, CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1));
  Append(self, CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0));
}

static void AppendValues(DYNAMIC_DICTIONARY* self, uint16_t index, uint8_t num) {
  for (uint8_t i = 0; i < num; i++) {
    Values[i] = 0x100u * index + i;
    Append(self, CO_KEY(index, i, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&Values[i]));
  }
}

void setUp(void) {
  memset(&Dynamic, 0, sizeof(Dynamic));
  AppendMandatory(&Dynamic);
  AppendValues(&Dynamic, 0x2000, 3);
}

static void test_a_dictionary_built_at_run_time_works(void) {
  uint32_t value = 0;
  NodeUp(&Node, Dynamic.Root, DYNAMIC_LENGTH);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdLong(&Node.Dict, CO_DEV(0x2000, 2), &value));
  TEST_ASSERT_EQUAL_HEX32(0x200002, value);
  BusReceive(&Node, "601#4000200100000000");
  TEST_ASSERT_SENT("581#4300200101002000");
}

static void test_the_length_may_be_larger_than_what_is_used(void) {
  NodeUp(&Node, Dynamic.Root, DYNAMIC_LENGTH);
  TEST_ASSERT_EQUAL(7, Node.Dict.Num);
  TEST_ASSERT_NULL(CODictFind(&Node.Dict, CO_DEV(0x2000, 3)));
  TEST_ASSERT_NULL(CODictFind(&Node.Dict, CO_DEV(0xFFFF, 0xFF)));
}

static void test_a_full_table_needs_no_end_mark(void) {
  NodeUp(&Node, Dynamic.Root, Dynamic.Used);
  TEST_ASSERT_NOT_NULL(CODictFind(&Node.Dict, CO_DEV(0x2000, 2)));
  TEST_ASSERT_NULL(CODictFind(&Node.Dict, CO_DEV(0x2000, 3)));
}

static void test_entries_are_added_to_a_running_node(void) {
  NodeUp(&Node, Dynamic.Root, DYNAMIC_LENGTH);
  AppendValues(&Dynamic, 0x3000, 5);
  TEST_ASSERT_EQUAL(12, CODictInit(&Node.Dict, &Node, Dynamic.Root, DYNAMIC_LENGTH));
  BusReceive(&Node, "601#4000300400000000");
  TEST_ASSERT_SENT("581#4300300404003000");
  BusReceive(&Node, "601#4000200000000000");
  TEST_ASSERT_SENT("581#4300200000003000");
}

static void test_entries_are_taken_from_a_running_node(void) {
  const CO_OBJ end = CO_OBJ_DICT_ENDMARK;
  NodeUp(&Node, Dynamic.Root, DYNAMIC_LENGTH);
  Dynamic.Root[4] = end;
  TEST_ASSERT_EQUAL(4, CODictInit(&Node.Dict, &Node, Dynamic.Root, DYNAMIC_LENGTH));
  BusReceive(&Node, "601#4000200000000000");
  TEST_ASSERT_SENT("581#8000200000000206");
}

static void test_a_direct_value_in_ram_is_written(void) {
  uint16_t word = 0;
  Append(&Dynamic, CO_KEY(0x4000, 0, CO_OBJ_D___RW), CO_TUNSIGNED16, (CO_DATA)(0x1234));
  NodeUp(&Node, Dynamic.Root, DYNAMIC_LENGTH);
  BusReceive(&Node, "601#2B00400078560000");
  TEST_ASSERT_SENT("581#6000400000000000");
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdWord(&Node.Dict, CO_DEV(0x4000, 0), &word));
  TEST_ASSERT_EQUAL_HEX16(0x5678, word);
  TEST_ASSERT_EQUAL_HEX32(0x5678, (uint32_t)Dynamic.Root[7].Data);
}

static void test_a_table_out_of_order_is_named_and_refused_where_tables_are_checked(void) {
  uint32_t key = 0;
  NodeUp(&Node, Dynamic.Root, DYNAMIC_LENGTH);
  Append(&Dynamic, CO_KEY(0x1FFF, 1, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&Values[0]));
  TEST_ASSERT_EQUAL(USE_DICT_CHECK ? -1 : 8, CODictInit(&Node.Dict, &Node, Dynamic.Root, DYNAMIC_LENGTH));
  TEST_ASSERT_EQUAL(CO_DICT_NOT_ASCENDING, CODictGetFault(&Node.Dict, &key));
  TEST_ASSERT_EQUAL_HEX32(CO_DEV(0x1FFF, 1), CO_GET_DEV(key));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_dictionary_built_at_run_time_works);
  RUN_TEST(test_the_length_may_be_larger_than_what_is_used);
  RUN_TEST(test_a_full_table_needs_no_end_mark);
  RUN_TEST(test_entries_are_added_to_a_running_node);
  RUN_TEST(test_entries_are_taken_from_a_running_node);
  RUN_TEST(test_a_direct_value_in_ram_is_written);
  RUN_TEST(test_a_table_out_of_order_is_named_and_refused_where_tables_are_checked);
  return UNITY_END();
}
