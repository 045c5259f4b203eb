// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: an RPDO and a TPDO whose mapping is constant.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint16_t Inhibit = 100;  // 100 us: not more often than each 10 ms
static uint16_t Event = 1000;   // ms: at least once a second
static int16_t Temperature;
static uint8_t Status;
static int16_t Setpoint;
static uint8_t Command;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},  // 200h + node-ID
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},                     // event-driven
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2200, 0, 16))},
    {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2201, 0, 8))},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},  // 180h + node-ID
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1800, 3, CO_OBJ_____RW), CO_TPDO_INHIBIT, (CO_DATA)(&Inhibit)},
    {CO_KEY(0x1800, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&Event)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 0, 16))},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2101, 0, 8))},
    {CO_KEY(0x2100, 0, CO_OBJ___APR_), CO_TSIGNED16, (CO_DATA)(&Temperature)},  // A: a change sends the TPDO
    {CO_KEY(0x2101, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&Status)},
    {CO_KEY(0x2200, 0, CO_OBJ____PRW), CO_TSIGNED16, (CO_DATA)(&Setpoint)},
    {CO_KEY(0x2201, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Command)},
};

static void StartNode(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("000: 01 05");  // NMT: start
  (void)BenchRun(20);
}

void an_rpdo_writes_what_it_maps(void) {
  StartNode();
  (void)BenchSend("205: 2C 01 07");
  TEST_ASSERT_EQUAL_INT16(300, Setpoint);
  TEST_ASSERT_EQUAL_UINT8(7, Command);
}

static void ShowTemperature(CO_NODE* node, int16_t temperature) {
  (void)CODictWrWord(&node->Dict, CO_DEV(0x2100, 0), (uint16_t)temperature);  // sends the TPDO if the value is new
}

static void ShowStatus(CO_NODE* node, uint8_t status) {
  Status = status;
  COTPdoTrigPdo(node->TPdo, 0);  // sends TPDO 0 (1800h)
}

void a_change_sends_the_tpdo(void) {
  Temperature = 0;
  Status = 0;
  StartNode();
  ShowTemperature(&Node, -25);
  TEST_ASSERT_EQUAL_STRING("185: E7 FF 00", BenchRun(15));
  ShowTemperature(&Node, -25);
  TEST_ASSERT_EQUAL_STRING("", BenchRun(15));
  ShowStatus(&Node, 9);
  TEST_ASSERT_EQUAL_STRING("185: E7 FF 09", BenchRun(15));
}

void the_event_timer_sends_the_tpdo(void) {
  Temperature = -25;
  StartNode();
  ShowStatus(&Node, 1);
  (void)BenchRun(10);
  TEST_ASSERT_EQUAL_STRING("185: E7 FF 01 | 185: E7 FF 01", BenchRun(2000));
}
