// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: SYNC.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t SyncId = 0x80;    // CO_COBID_SYNC_STD(1, 0x80) produces SYNC
static uint32_t SyncPeriod = 0;   // us; of the producer
static uint32_t SyncWindow = 0;   // us; 0: no limit
static uint8_t SyncOverflow = 0;  // 2 to 240: SYNC has a counter

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, (CO_DATA)(&SyncId)},
    {CO_KEY(0x1006, 0, CO_OBJ_____RW), CO_TSYNC_CYCLE, (CO_DATA)(&SyncPeriod)},
    {CO_KEY(0x1007, 0, CO_OBJ_____RW), CO_TSYNC_WINDOW, (CO_DATA)(&SyncWindow)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1019, 0, CO_OBJ_____RW), CO_TSYNC_COUNT, (CO_DATA)(&SyncOverflow)},
};

void the_master_makes_the_node_produce_sync(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("605: 2F 19 10 00 04 00 00 00");  // 1019h: the counter counts from 1 to 4
  (void)BenchSend("605: 23 06 10 00 10 27 00 00");  // 1006h: 10 000 us
  (void)BenchSend("605: 23 05 10 00 80 00 00 40");  // 1005h: bit 30, the node produces SYNC
  TEST_ASSERT_EQUAL_STRING("080: 01 | 080: 02 | 080: 03 | 080: 04 | 080: 01", BenchRun(50));
}
