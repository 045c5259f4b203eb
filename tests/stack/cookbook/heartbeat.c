// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: heartbeat producer and consumer, error behaviour, self-start.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint16_t HeartbeatTime = 500;                                // ms
static CO_HBCONS Master = {NULL, NULL, CO_INVALID, 0, 1500, 1, 0};  // 1500 ms, node 1
static CO_HBCONS Spare = {NULL, NULL, CO_INVALID, 0, 0, 0, 0};      // written by the master
static uint8_t ErrorBehaviour = CO_ERROR_BEHAVIOUR_PREOP;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(2)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&Master)},
    {CO_KEY(0x1016, 2, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&Spare)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1029, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1029, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, (CO_DATA)(&ErrorBehaviour)},
    {CO_KEY(0x1F80, 0, CO_OBJ_D___R_), CO_TNMT_STARTUP, (CO_DATA)(0)},  // the node starts itself
};

static unsigned Missing;
static CO_MODE LastState;

void CONmtHbConsEvent(CO_NMT* nmt, uint8_t nodeId) {
  (void)nmt;
  if (nodeId == 1) {
    ++Missing;  // no heartbeat for 1500 ms
  }
}

void CONmtHbConsChange(CO_NMT* nmt, uint8_t nodeId, CO_MODE mode) {
  (void)nmt;
  (void)nodeId;
  LastState = mode;
}

void heartbeats_are_produced(void) {
  HeartbeatTime = 500;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("705: 05 | 705: 05", BenchRun(1000));
  TEST_ASSERT_EQUAL_STRING("585: 60 17 10 00 00 00 00 00", BenchSend("605: 2B 17 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("", BenchRun(1000));
}

void a_missing_heartbeat_is_noticed(void) {
  HeartbeatTime = 0;
  Missing = 0;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_INT(CO_OPERATIONAL, CONmtGetMode(&Node.Nmt));
  TEST_ASSERT_EQUAL_STRING("", BenchSend("701: 05"));
  TEST_ASSERT_EQUAL_INT(CO_OPERATIONAL, LastState);
  TEST_ASSERT_EQUAL_STRING("", BenchRun(1400));
  // 8130h: heartbeat error, of node 1
  TEST_ASSERT_EQUAL_STRING("085: 30 81 11 00 00 01 00 00", BenchRun(200));
  TEST_ASSERT_EQUAL_UINT(1, Missing);
  TEST_ASSERT_EQUAL_INT(CO_PREOP, CONmtGetMode(&Node.Nmt));
  TEST_ASSERT_EQUAL_STRING("085: 00 00 00 00 00 01 00 00", BenchSend("701: 05"));
}

void the_master_writes_a_heartbeat_consumer(void) {
  HeartbeatTime = 0;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  // node 9, 1000 ms
  TEST_ASSERT_EQUAL_STRING("585: 60 16 10 02 00 00 00 00", BenchSend("605: 23 16 10 02 E8 03 09 00"));
  TEST_ASSERT_EQUAL_UINT16(1000, Spare.Time);
  TEST_ASSERT_EQUAL_UINT8(9, Spare.NodeId);
}
