// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: manufacturer status, error status bits, reactions to errors of the device.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;

static uint32_t Status;                     // written by CONodeSetStatus()
static CO_EMCY_BITS ErrorBits = {0, 2, 0};  // 2 bytes: errors 0 to 15
static uint8_t Reaction[2] = {CO_ERROR_BEHAVIOUR_PREOP, CO_ERROR_BEHAVIOUR_STOP};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1002, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&Status)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1029, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1029, 1, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, (CO_DATA)(&Reaction[0])},
    {CO_KEY(0x1029, 2, CO_OBJ_____RW), CO_TERROR_BEHAVIOUR, (CO_DATA)(&Reaction[1])},  // errors of the output stage
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(255)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x1002, 0, 32))},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2100, 0, 16))},
    {CO_KEY(0x2100, 0, CO_OBJ____PR_), CO_TEMCY_BITS, (CO_DATA)(&ErrorBits)},
};

static CO_EMCY_TBL Errors[10];

static void StartNode(void) {
  Spec.EmcyCode = Errors;
  Ext.EmcyNum = 10;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
  TEST_ASSERT_EQUAL_STRING("", BenchSend("000: 01 05"));
}

void a_change_of_the_status_sends_the_tpdo(void) {
  StartNode();
  CO_NODE* node = &Node;
  CO_ERR error = CONodeSetStatus(node, 0x12);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, error);
  TEST_ASSERT_EQUAL_STRING("185: 12 00 00 00 00 00", BenchRun(1));
  TEST_ASSERT_EQUAL_HEX32(0x12, CONodeGetStatus(node));
  (void)CONodeSetStatus(node, 0);
  TEST_ASSERT_EQUAL_STRING("185: 00 00 00 00 00 00", BenchRun(1));
}

void error_status_bits_show_each_error(void) {
  StartNode();
  COEmcySet(&Node.Emcy, 9, NULL);
  TEST_ASSERT_EQUAL_STRING("085: 00 00 01 00 00 00 00 00 | 185: 00 00 00 00 00 02", BenchRun(1));
  TEST_ASSERT_EQUAL_STRING("585: 4B 00 21 00 00 02 00 00", BenchSend("605: 40 00 21 00 00 00 00 00"));
}

void an_error_of_the_device_stops_the_node(void) {
  StartNode();
  CO_NODE* node = &Node;
  COEmcySet(&node->Emcy, 3, NULL);
  CO_ERR error = COErrorBehaviour(node, 2);
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, error);
  TEST_ASSERT_EQUAL_INT(CO_STOP, CONmtGetMode(&node->Nmt));
}
