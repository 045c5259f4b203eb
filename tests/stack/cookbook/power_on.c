// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: power-on values without a memory.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

typedef struct COMMUNICATION {
  uint32_t SyncId;
  uint16_t HeartbeatTime;
} COMMUNICATION;

typedef struct APPLICATION {
  int16_t Setpoint;
} APPLICATION;

static COMMUNICATION Com;
static const COMMUNICATION ComDefault = {0x80, 0};
static APPLICATION App;

static const CO_DEFAULTS Defaults[] = {
    CO_DEFAULTS_OF(Com, ComDefault, CO_RESET_COM),  // objects 1000h to 1FFFh
    CO_DEFAULTS_ZERO(App, CO_RESET_NODE),           // all other objects; here with the value 0
    CO_DEFAULTS_END,
};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1005, 0, CO_OBJ_____RW), CO_TSYNC_ID, (CO_DATA)(&Com.SyncId)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&Com.HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2200, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&App.Setpoint)},
    CO_OBJ_DICT_DEFAULTS(Defaults),  // the end mark, which DictLen includes
};

void resets_restore_power_on_values(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("605: 2B 17 10 00 F4 01 00 00");
  (void)BenchSend("605: 2B 00 22 00 2C 01 00 00");
  TEST_ASSERT_EQUAL_UINT16(500, Com.HeartbeatTime);
  TEST_ASSERT_EQUAL_INT16(300, App.Setpoint);
  (void)BenchSend("000: 82 05");  // reset communication
  TEST_ASSERT_EQUAL_UINT16(0, Com.HeartbeatTime);
  TEST_ASSERT_EQUAL_INT16(300, App.Setpoint);
  (void)BenchSend("000: 81 05");  // reset node
  TEST_ASSERT_EQUAL_INT16(0, App.Setpoint);
}
