// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: multiplex PDOs with source addressing (CO_MPDO_N).
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint8_t Input[2] = {0x11, 0x22};
static uint8_t Remote;
static uint32_t ScanList = CO_MPDO_SCAN(2, 0x2500, 1);                        // 2500h:1 and 2500h:2
static uint64_t DispatchList = CO_MPDO_DISPATCH(1, 0x2501, 0, 0x2500, 1, 9);  // 2501h:0 from node 9, 2500h:1

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x189)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0xFE)},  // source addressing
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(0xFE)},
    {CO_KEY(0x1FA0, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1FA0, 1, CO_OBJ_____RW), CO_TPDO_SCAN, (CO_DATA)(&ScanList)},
    {CO_KEY(0x1FD0, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1FD0, 1, CO_OBJ_____RW), CO_TPDO_DISPATCH, (CO_DATA)(&DispatchList)},
    {CO_KEY(0x2500, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x2500, 1, CO_OBJ___APR_), CO_TUNSIGNED8, (CO_DATA)(&Input[0])},
    {CO_KEY(0x2500, 2, CO_OBJ___APR_), CO_TUNSIGNED8, (CO_DATA)(&Input[1])},
    {CO_KEY(0x2501, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Remote)},
};

void a_multiplex_pdo_names_its_object(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("000: 01 05");
  (void)BenchRun(10);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, CODictWrByte(&Node.Dict, CO_DEV(0x2500, 2), 0x33));
  TEST_ASSERT_EQUAL_STRING("185: 05 00 25 02 33 00 00 00", BenchRun(1));
  (void)BenchSend("189: 09 00 25 01 44 00 00 00");
  TEST_ASSERT_EQUAL_HEX8(0x44, Remote);
}
