// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: SDO servers.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t SecondRequest = CO_SDO_ID_OFF;   // client to server; written by the master
static uint32_t SecondResponse = CO_SDO_ID_OFF;  // server to client
static uint8_t SecondClient;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TSDO_ID, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x1201, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1201, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&SecondRequest)},
    {CO_KEY(0x1201, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&SecondResponse)},
    {CO_KEY(0x1201, 3, CO_OBJ_____RW), CO_TUNSIGNED8, (CO_DATA)(&SecondClient)},
};

void the_master_switches_a_second_server_on(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("585: 43 00 12 01 05 06 00 00", BenchSend("605: 40 00 12 01 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 01 12 01 00 00 00 00", BenchSend("605: 23 01 12 01 A5 06 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 01 12 02 00 00 00 00", BenchSend("605: 23 01 12 02 B5 06 00 00"));
  TEST_ASSERT_EQUAL_STRING("6B5: 43 00 10 00 00 00 00 00", BenchSend("6A5: 40 00 10 00 00 00 00 00"));
}
