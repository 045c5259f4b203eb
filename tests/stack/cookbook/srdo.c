// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: an SRDO that is received, and the global fail-safe command.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint8_t GfcUsed = 1;
static uint8_t Mapped = 2;  // objects: plain, inverse
static uint8_t Direction = CO_SRDO_RX;
static uint16_t Sct = 50;  // ms: the next pair
static uint8_t Srvt = 20;  // ms: the inverse frame
static uint8_t ConfigurationValid = CO_SRDO_CONFIGURATION_VALID;
static uint16_t Signature = 0x1AD9;  // COSrdoSignature()
static uint8_t Stop, StopInverse = 0xFF;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1300, 0, CO_OBJ_____RW), CO_TGFC, (CO_DATA)(&GfcUsed)},
    {CO_KEY(0x1301, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(6)},
    {CO_KEY(0x1301, 1, CO_OBJ_____RW), CO_TSRDO_COM, (CO_DATA)(&Direction)},
    {CO_KEY(0x1301, 2, CO_OBJ_____RW), CO_TSRDO_COM, (CO_DATA)(&Sct)},
    {CO_KEY(0x1301, 3, CO_OBJ_____RW), CO_TSRDO_COM, (CO_DATA)(&Srvt)},
    {CO_KEY(0x1301, 4, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(CO_SRDO_TYPE)},
    {CO_KEY(0x1301, 5, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(CO_SRDO_COBID1(6))},
    {CO_KEY(0x1301, 6, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(CO_SRDO_COBID2(6))},
    {CO_KEY(0x1381, 0, CO_OBJ_____RW), CO_TSRDO_MAP, (CO_DATA)(&Mapped)},
    {CO_KEY(0x1381, 1, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2200, 1, 8))},
    {CO_KEY(0x1381, 2, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(CO_LINK(0x2200, 2, 8))},
    {CO_KEY(0x13FE, 0, CO_OBJ_____RW), CO_TSRDO_VALID, (CO_DATA)(&ConfigurationValid)},
    {CO_KEY(0x13FF, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x13FF, 1, CO_OBJ_____RW), CO_TSRDO_SIGNATURE, (CO_DATA)(&Signature)},
    {CO_KEY(0x2200, 1, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Stop)},
    {CO_KEY(0x2200, 2, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&StopInverse)},
};

static bool IsSafe = true;  // outputs are switched off

void COSrdoChange(CO_NODE* node, uint8_t number, CO_SRDO_STATE state) {
  (void)number;
  (void)state;
  IsSafe = !COSrdoIsEstablished(node);
}

void COGfcReceived(CO_NODE* node) {
  (void)node;
  IsSafe = true;
}

void an_srdo_ends_the_safe_state_and_its_loss_begins_it(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  uint16_t signature = 0;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, COSrdoSignature(&Node, 0, &signature));
  TEST_ASSERT_EQUAL_HEX16(signature, Signature);
  (void)BenchSend("000: 01 00");
  TEST_ASSERT_TRUE(IsSafe);
  (void)BenchSend("10B: 01");
  (void)BenchSend("10C: FE");
  TEST_ASSERT_FALSE(IsSafe);
  TEST_ASSERT_EQUAL_UINT8(1, Stop);
  (void)BenchRun(60);
  TEST_ASSERT_TRUE(IsSafe);
  TEST_ASSERT_EQUAL_INT(CO_SRDO_ERR_SCT, COSrdoGetState(&Node, 0));
}

void a_gfc_begins_the_safe_state(void) {
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  (void)BenchSend("000: 01 00");
  (void)BenchSend("10B: 01");
  (void)BenchSend("10C: FE");
  TEST_ASSERT_FALSE(IsSafe);
  (void)BenchSend("001:");
  TEST_ASSERT_TRUE(IsSafe);
}
