// SPDX-License-Identifier: Apache-2.0
// C++ code that uses CO_DATA as an integer, like C code, compiled with CO_DATA_INTEGER.
#include <type_traits>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

static_assert(std::is_same_v<CO_DATA, uintptr_t>, "the plain integer");
static_assert(std::is_same_v<decltype(CO_PARA::Start), uint8_t*>, "the plain pointer");

namespace {

uint32_t counter = 41;

uint32_t count_size(CO_OBJ*, CO_NODE*, uint32_t) { return sizeof(counter); }

CO_ERR count_read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  auto* value = reinterpret_cast<uint32_t*>(obj->Data);
  ASSERT_EQU_ERR(size, sizeof(*value), CO_ERR_BAD_ARG);
  *static_cast<uint32_t*>(buffer) = ++*value;
  return CO_ERR_NONE;
}

const CO_OBJ_TYPE count_type = {count_size, nullptr, count_read, nullptr, nullptr};

const CO_OBJ dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, static_cast<CO_DATA>(0x191)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 0},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, 1},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, 0},
    {CO_KEY(0x2000, 0, CO_OBJ_____R_), &count_type, reinterpret_cast<CO_DATA>(&counter)},
    CO_OBJ_DICT_ENDMARK,
};

CO_NODE node;

void test_old_casts_work() {
  uint32_t value = 0;
  NodeUp(&node, dictionary, 6);
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CODictRdLong(&node.Dict, CO_DEV(0x2000, 0), &value));
  TEST_ASSERT_EQUAL_UINT32(42, value);
  BusReceive(&node, "601#4000100000000000");
  TEST_ASSERT_SENT("581#4300100091010000");
}

void test_bits_of_the_data_are_an_integer() {
  CO_OBJ obj = dictionary[0];
  obj.Data |= 0x10000;
  obj.Data += 1;
  TEST_ASSERT_EQUAL_HEX32(0x10192, obj.Data & 0xFFFFFFFFu);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_old_casts_work);
  RUN_TEST(test_bits_of_the_data_are_an_integer);
  return UNITY_END();
}
