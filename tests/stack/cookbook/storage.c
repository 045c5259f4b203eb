// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: parameters that survive a loss of power.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

typedef struct COMMUNICATION {
  uint16_t HeartbeatTime;
  uint32_t ConfigurationDate;
  uint32_t ConfigurationTime;
} COMMUNICATION;

typedef struct APPLICATION {
  int16_t Setpoint;
  uint16_t Gain;
} APPLICATION;

static COMMUNICATION Com;
static const COMMUNICATION ComDefault = {500, 0, 0};
static APPLICATION App;
static const APPLICATION AppDefault = {200, 10};

#define SPACE(group) CO_PARA_SPACE(sizeof(group), 1, 1)  // the memory erases and programs single bytes

static const CO_PARA All = {0, 0, NULL, NULL, CO_RESET_NODE, NULL, CO_PARA___E, 0, 0};
static const CO_PARA ComGroup = {
    0, sizeof(Com), (uint8_t*)&Com, (uint8_t*)&ComDefault, CO_RESET_COM, NULL, CO_PARA___E, 0, 0};
static const CO_PARA AppGroup = {
    SPACE(Com), sizeof(App), (uint8_t*)&App, (uint8_t*)&AppDefault, CO_RESET_NODE, NULL, CO_PARA___E, 0, 0};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)(3)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&All)},
    {CO_KEY(0x1010, 2, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&ComGroup)},
    {CO_KEY(0x1010, 3, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&AppGroup)},
    {CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, (CO_DATA)(3)},
    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&All)},
    {CO_KEY(0x1011, 2, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&ComGroup)},
    {CO_KEY(0x1011, 3, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&AppGroup)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&Com.HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1020, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1020, 1, CO_OBJ_____RW), CO_TVERIFY_CONFIG, (CO_DATA)(&Com.ConfigurationDate)},
    {CO_KEY(0x1020, 2, CO_OBJ_____RW), CO_TVERIFY_CONFIG, (CO_DATA)(&Com.ConfigurationTime)},
    {CO_KEY(0x2200, 0, CO_OBJ_____RW), CO_TSIGNED16, (CO_DATA)(&App.Setpoint)},
    {CO_KEY(0x2201, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&App.Gain)},
};

void what_was_saved_survives_a_loss_of_power(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_INT16(200, App.Setpoint);
  TEST_ASSERT_EQUAL_UINT16(500, Com.HeartbeatTime);
  (void)BenchSend("605: 2B 00 22 00 2C 01 00 00");  // 2200h = 300
  TEST_ASSERT_EQUAL_STRING("585: 60 10 10 01 00 00 00 00",
                           BenchSend("605: 23 10 10 01 73 61 76 65"));  // 1010h:1 = "save"
  App.Setpoint = 0;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));  // power off and on
  TEST_ASSERT_EQUAL_INT16(300, App.Setpoint);
  TEST_ASSERT_EQUAL_STRING("585: 60 11 10 01 00 00 00 00",
                           BenchSend("605: 23 11 10 01 6C 6F 61 64"));  // 1011h:1 = "load"
  TEST_ASSERT_EQUAL_STRING("705: 00", BenchSend("000: 81 05"));         // NMT: reset node
  TEST_ASSERT_EQUAL_INT16(200, App.Setpoint);
}

void a_write_resets_the_date_of_the_configuration(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("605: 23 20 10 01 01 00 00 00");
  (void)BenchSend("605: 23 10 10 01 73 61 76 65");
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_UINT32(1, Com.ConfigurationDate);
  (void)BenchSend("605: 2B 01 22 00 05 00 00 00");
  TEST_ASSERT_EQUAL_UINT32(0, Com.ConfigurationDate);
}
