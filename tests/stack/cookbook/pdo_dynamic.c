// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: PDOs whose parameters and mapping the master writes.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t RpdoId = CO_COBID_RPDO_DEFAULT(0);  // plus node-ID (flag N)
static uint8_t RpdoType = 254;
static uint16_t RpdoDeadline;  // ms; 0: none
static uint8_t RpdoNum = 1;
static uint32_t RpdoMap[2] = {CO_LINK(0x2200, 0, 16), 0};
static uint32_t TpdoId = CO_TPDO_COBID_OFF | CO_COBID_TPDO_DEFAULT(0);  // disabled until the master enables it
static uint8_t TpdoType = 254;
static uint16_t TpdoInhibit;  // 100 us
static uint16_t TpdoEvent;    // ms
static uint8_t TpdoStart;
static uint8_t TpdoNum;
static uint32_t TpdoMap[2];
static int16_t Temperature = 215;
static uint8_t Status = 3;
static int16_t Setpoint;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1400, 1, CO_OBJ__N__RW), CO_TPDO_ID, (CO_DATA)(&RpdoId)},
    {CO_KEY(0x1400, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&RpdoType)},
    {CO_KEY(0x1400, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&RpdoDeadline)},
    {CO_KEY(0x1600, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA)(&RpdoNum)},
    {CO_KEY(0x1600, 1, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&RpdoMap[0])},
    {CO_KEY(0x1600, 2, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&RpdoMap[1])},
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(6)},
    {CO_KEY(0x1800, 1, CO_OBJ__N__RW), CO_TPDO_ID, (CO_DATA)(&TpdoId)},
    {CO_KEY(0x1800, 2, CO_OBJ_____RW), CO_TPDO_TYPE, (CO_DATA)(&TpdoType)},
    {CO_KEY(0x1800, 3, CO_OBJ_____RW), CO_TPDO_INHIBIT, (CO_DATA)(&TpdoInhibit)},
    {CO_KEY(0x1800, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&TpdoEvent)},
    {CO_KEY(0x1800, 6, CO_OBJ_____RW), CO_TPDO_START, (CO_DATA)(&TpdoStart)},
    {CO_KEY(0x1A00, 0, CO_OBJ_____RW), CO_TPDO_NUM, (CO_DATA)(&TpdoNum)},
    {CO_KEY(0x1A00, 1, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&TpdoMap[0])},
    {CO_KEY(0x1A00, 2, CO_OBJ_____RW), CO_TPDO_MAP, (CO_DATA)(&TpdoMap[1])},
    {CO_KEY(0x2100, 0, CO_OBJ___APR_), CO_TSIGNED16, (CO_DATA)(&Temperature)},
    {CO_KEY(0x2101, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&Status)},
    {CO_KEY(0x2200, 0, CO_OBJ____PRW), CO_TSIGNED16, (CO_DATA)(&Setpoint)},
};

void the_master_maps_a_tpdo(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("605: 23 00 18 01 85 01 00 C0");  // 1800h:1 = C000 0185h: the TPDO is disabled
  (void)BenchSend("605: 2F 00 18 02 01 00 00 00");  // 1800h:2 = 1: with each SYNC
  (void)BenchSend("605: 2F 00 1A 00 00 00 00 00");  // 1A00h:0 = 0: the mapping may be written
  (void)BenchSend("605: 23 00 1A 01 10 00 00 21");  // 1A00h:1 = 2100 0010h: object 2100h:0, 16 bits
  (void)BenchSend("605: 23 00 1A 02 08 00 01 21");  // 1A00h:2 = 2101 0008h: object 2101h:0, 8 bits
  (void)BenchSend("605: 2F 00 1A 00 02 00 00 00");  // 1A00h:0 = 2: two objects
  (void)BenchSend("605: 23 00 18 01 85 01 00 40");  // 1800h:1 = 4000 0185h: the TPDO is enabled
  TEST_ASSERT_EQUAL_HEX32(0x40000180, TpdoId);      // without the node-ID
  (void)BenchSend("000: 01 05");
  (void)BenchRun(10);
  TEST_ASSERT_EQUAL_STRING("185: D7 00 03", BenchSend("080:"));
  (void)BenchSend("205: 2C 01");  // the RPDO uses the table's COB-ID and mapping
  TEST_ASSERT_EQUAL_INT16(300, Setpoint);
}

void the_mapping_of_a_pdo_that_exists_is_refused(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  // 0601 0000h: unsupported access
  TEST_ASSERT_EQUAL_STRING("585: 80 00 16 00 00 00 01 06", BenchSend("605: 2F 00 16 00 00 00 00 00"));
}
