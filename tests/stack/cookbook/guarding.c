// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: node guarding and life guarding.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint16_t GuardTime = 100;    // ms
static uint8_t LifeTimeFactor = 3;  // no guarding by the master for 300 ms is an error

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x100C, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&GuardTime)},
    {CO_KEY(0x100D, 0, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&LifeTimeFactor)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
};

static bool MasterIsMissing;

void CONmtLifeGuardEvent(CO_NMT* nmt, bool occurred) {
  (void)nmt;
  MasterIsMissing = occurred;
}

void a_missing_master_is_noticed(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("705: 7F", BenchSend("705: R"));
  TEST_ASSERT_EQUAL_STRING("705: FF", BenchSend("705: R"));
  (void)BenchRun(290);
  TEST_ASSERT_FALSE(MasterIsMissing);
  TEST_ASSERT_EQUAL_STRING("", BenchRun(20));
  TEST_ASSERT_TRUE(MasterIsMissing);
}
