// SPDX-License-Identifier: Apache-2.0
// Checks that the library of the tests reports a violated invariant to the application (co_assert.h).
#include <string.h>

#include "co_assert.h"
#include "co_core.h"
#include "fakes.h"
#include "unity.h"

static CO_HBCONS Consumer;

static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(1)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&Consumer)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
};

static CO_NODE Node;
static unsigned Failures;
static char Condition[64];
static char File[64];
static int Line;

void COAssertFailed(const char* condition, const char* file, int line) {
  Failures++;
  strncpy(Condition, condition, sizeof(Condition) - 1);
  strncpy(File, strrchr(file, '/') != NULL ? strrchr(file, '/') + 1 : file, sizeof(File) - 1);
  Line = line;
}

void setUp(void) {
  Failures = 0;
  Consumer.Time = 100;
  Consumer.NodeId = 5;
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
}

static void test_a_node_that_is_used_as_documented_violates_nothing(void) {
  BusReceive(&Node, "705#7F");
  BusReceive(&Node, "705#05");
  BusReceive(&Node, "000#8101");
  TEST_ASSERT_EQUAL(0, Failures);
}

static void test_memory_that_the_application_has_overwritten_is_reported(void) {
  Node.HbCons[0].Period = 0;
  BusReceive(&Node, "705#7F");
  TEST_ASSERT_EQUAL(1, Failures);
  TEST_ASSERT_EQUAL_STRING("watch.Cons != nullptr && watch.Period != 0", Condition);
  TEST_ASSERT_EQUAL_STRING("consumer.cpp", File);
  TEST_ASSERT_GREATER_OR_EQUAL(1, Line);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_node_that_is_used_as_documented_violates_nothing);
  RUN_TEST(test_memory_that_the_application_has_overwritten_is_reported);
  return UNITY_END();
}
