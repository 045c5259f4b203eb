// SPDX-License-Identifier: Apache-2.0
// Checks which definition of a callback is linked. A definition in an object file replaces the stack's default
// (EXPECTED_CALLS 1). One in a static library from which nothing else is needed does not: the default is called
// (EXPECTED_CALLS 0).
#include "callback_place.h"

#include "fakes.h"
#include "unity.h"

unsigned CallsOfTheCallback;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
};

static CO_NODE Node;

static void test_the_callback_runs_where_the_linker_sees_it(void) {
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
  BusReceive(&Node, "123#01");
  TEST_ASSERT_EQUAL(EXPECTED_CALLS, CallsOfTheCallback);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_the_callback_runs_where_the_linker_sees_it);
  return UNITY_END();
}
