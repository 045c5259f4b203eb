// SPDX-License-Identifier: Apache-2.0
// Uses the addresses of a CO_PARA in C++: addresses of objects of any type, in constant expressions, and as bytes.
#include <cstring>

#include "co_core.h"
#include "unity.h"

namespace {

struct Parameters {
  uint32_t limit;
  uint16_t rate;
};

Parameters memory;
const Parameters defaults = {0x11223344, 0x5566};
uint8_t bytes[4];

constexpr CO_PARA group = {0, sizeof(memory), &memory, &defaults, CO_RESET_NODE, nullptr, CO_PARA___E};
constexpr CO_PARA without_defaults = {0, sizeof(bytes), bytes, nullptr, CO_RESET_COM, nullptr, CO_PARA____};
constexpr CO_PARA with_null = {0, sizeof(bytes), &bytes[0], NULL, CO_RESET_COM, nullptr, CO_PARA____};
constexpr CO_PARA with_zero = {0, sizeof(bytes), static_cast<void*>(bytes), 0, CO_RESET_COM, nullptr, CO_PARA____};

static_assert(sizeof(CO_PARA::Start) == sizeof(uint8_t*));

void test_the_address_of_any_object_is_taken() {
  TEST_ASSERT_EQUAL_PTR(&memory, group.Start);
  TEST_ASSERT_EQUAL_PTR(&defaults, group.Default);
  TEST_ASSERT_EQUAL_PTR(bytes, with_zero.Start);
}

void test_no_address_is_null() {
  TEST_ASSERT_NULL(without_defaults.Default);
  TEST_ASSERT_TRUE(with_null.Default == nullptr);
  TEST_ASSERT_TRUE(with_zero.Default == 0);
  TEST_ASSERT_FALSE(with_zero.Default);
}

void test_it_is_used_as_a_pointer_to_bytes() {
  uint8_t expected[sizeof(defaults)];
  std::memcpy(expected, &defaults, sizeof(defaults));
  std::memcpy(group.Start, group.Default, group.Size);
  TEST_ASSERT_EQUAL_HEX32(0x11223344, memory.limit);
  for (uint32_t i = 0; i < group.Size; i++) {
    TEST_ASSERT_EQUAL_HEX8(expected[i], group.Start[i]);
    TEST_ASSERT_EQUAL_HEX8(expected[i], *(group.Start + i));
  }
}

void test_it_is_cast_back_to_the_object() {
  static_cast<Parameters*>(group.Start)->rate = 7;
  TEST_ASSERT_EQUAL(7, ((const Parameters*)group.Start)->rate);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_the_address_of_any_object_is_taken);
  RUN_TEST(test_no_address_is_null);
  RUN_TEST(test_it_is_used_as_a_pointer_to_bytes);
  RUN_TEST(test_it_is_cast_back_to_the_object);
  return UNITY_END();
}
