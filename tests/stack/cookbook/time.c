// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: TIME and the clock of the node.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t TimeId = CO_COBID_TIME_STD(1, 0, 0x100);  // consumes TIME, does not produce it

static uint32_t TimeStamp;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1012, 0, CO_OBJ_____RW), CO_TTIME_ID, (CO_DATA)(&TimeId)},
    {CO_KEY(0x1013, 0, CO_OBJ____PRW), CO_TTIME_HIGH_RES, (CO_DATA)(&TimeStamp)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2101, 0, CO_OBJ____PRW), CO_TTIME_CLOCK, 0},
};

void a_time_message_sets_the_clock(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  CO_NODE* node = &Node;
  (void)BenchSend("100: E8 03 00 00 02 00");  // second 1 of day 2
  (void)BenchRun(499);
  CO_TIME_OF_DAY now;
  CO_ERR error = COTimeGet(node, &now);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, error);
  TEST_ASSERT_UINT32_WITHIN(1, 1500, now.Ms);
  TEST_ASSERT_EQUAL_UINT16(2, now.Days);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, COTimeHighResSet(node, 5));
  uint32_t microseconds;
  error = COTimeHighResGet(node, &microseconds);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, error);
  TEST_ASSERT_EQUAL_UINT32(5, microseconds);
}
