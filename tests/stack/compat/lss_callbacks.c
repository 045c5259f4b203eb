// SPDX-License-Identifier: Apache-2.0
// Tests the default LSS callbacks of the stack, for an application that defines none.
#include "co_core.h"
#include "unity.h"

static void test_what_is_loaded_is_unchanged(void) {
  uint32_t baud = 250000;
  uint8_t id = 5;
  TEST_ASSERT_EQUAL(CO_ERR_NONE, COLssLoad(&baud, &id));
  TEST_ASSERT_EQUAL_UINT32(250000, baud);
  TEST_ASSERT_EQUAL(5, id);
}

/* Storing must fail, so that the LSS master does not assume that the node-ID is stored. */
static void test_nothing_can_be_stored(void) { TEST_ASSERT_EQUAL(CO_ERR_LSS_NO_STORE, COLssStore(250000, 5)); }

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_what_is_loaded_is_unchanged);
  RUN_TEST(test_nothing_can_be_stored);
  return UNITY_END();
}
