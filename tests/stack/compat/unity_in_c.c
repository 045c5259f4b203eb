// SPDX-License-Identifier: Apache-2.0
// Tests the assertions of unity.h in C: a failure ends its test and is reported once. (tests/stack/unit/unity_test.cpp
// tests which values pass.)
#include "unity.h"

#include <string.h>

static unsigned Failures;
static unsigned Others;
static int LastLine;
static char LastText[80];
static unsigned SetUps;
static unsigned TearDowns;
static int Reached;

void setUp(void) { SetUps++; }
void tearDown(void) { TearDowns++; }

static void Record(UNITY_KIND kind, const char* file, int line, const char* text) {
  (void)file;
  if (kind == UNITY_FAILED) {
    Failures++;
    LastLine = line;
    strncpy(LastText, text, sizeof(LastText) - 1);
  } else {
    Others++;
  }
}

/* Runs a test like RUN_TEST, and counts its reports instead of printing them. */
static void RunRecorded(void (*test)(void)) {
  Failures = 0;
  Others = 0;
  Reached = 0;
  const UNITY_SINK before = unity_report_to(Record);
  unity_run(test, "inner", __FILE__, __LINE__);
  unity_report_to(before);
}

static int FailingLine;
static void Fails(void) {
  FailingLine = __LINE__ + 1;
  TEST_ASSERT_EQUAL_HEX8_MESSAGE(0x5A, 0xA5, "why");
  Reached = 1;
}

static void Ignores(void) {
  TEST_IGNORE_MESSAGE("not here");
  Reached = 1;
}

static void PassesEarly(void) {
  TEST_PASS();
  Reached = 1;
}

static void Passes(void) {
  const uint8_t bytes[] = {1, 2};
  TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, bytes, 2);
  TEST_ASSERT_EQUAL_STRING("a", "a");
  TEST_ASSERT_INT_WITHIN(1, 5, 6);
  Reached = 1;
}

/* Each of the following tests runs a recorded test, and checks its results outside of it. */
static void test_a_failed_assertion_ends_its_test(void) {
  RunRecorded(Fails);
  TEST_ASSERT_EQUAL(1, Failures);
  TEST_ASSERT_EQUAL(0, Others);
  TEST_ASSERT_EQUAL(0, Reached);
  TEST_ASSERT_EQUAL(FailingLine, LastLine);
  TEST_ASSERT_EQUAL_STRING("Expected 0x5A Was 0xA5. why", LastText);
}

static void test_ignore_and_pass_end_their_test(void) {
  RunRecorded(Ignores);
  TEST_ASSERT_EQUAL(0, Failures);
  TEST_ASSERT_EQUAL(0, Reached);
  RunRecorded(PassesEarly);
  TEST_ASSERT_EQUAL(0, Failures);
  TEST_ASSERT_EQUAL(0, Reached);
}

static void test_passed_assertions_let_the_test_go_on(void) {
  RunRecorded(Passes);
  TEST_ASSERT_EQUAL(0, Failures);
  TEST_ASSERT_EQUAL(1, Reached);
}

static void test_set_up_and_tear_down_surround_every_test(void) {
  SetUps = 0;
  TearDowns = 0;
  RunRecorded(Fails);
  RunRecorded(Passes);
  TEST_ASSERT_EQUAL(2, SetUps);
  TEST_ASSERT_EQUAL(2, TearDowns);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_failed_assertion_ends_its_test);
  RUN_TEST(test_ignore_and_pass_end_their_test);
  RUN_TEST(test_passed_assertions_let_the_test_go_on);
  RUN_TEST(test_set_up_and_tear_down_surround_every_test);
  return UNITY_END();
}
