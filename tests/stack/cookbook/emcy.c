// SPDX-License-Identifier: Apache-2.0
// Example of docs/cookbook.md: EMCY producer with a history, EMCY consumer.
#include "bench.h"
#include "cookbook.h"
#include "unity.h"

static uint8_t ErrorRegister;  // in RAM, as the stack writes it
static uint8_t HistoryNum;     // storage that the entry requires
static uint32_t History[4];
static uint32_t EmcyId = 0x80;       // plus node-ID (flag N)
static uint16_t EmcyInhibit = 0;     // 100 us
static uint32_t EmcyOfNode1 = 0x81;  // a complete COB-ID

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1003, 0, CO_OBJ_____RW), CO_TEMCY_HIST, (CO_DATA)(&HistoryNum)},
    {CO_KEY(0x1003, 1, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&History[0])},
    {CO_KEY(0x1003, 2, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&History[1])},
    {CO_KEY(0x1003, 3, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&History[2])},
    {CO_KEY(0x1003, 4, CO_OBJ_____R_), CO_TEMCY_HIST, (CO_DATA)(&History[3])},
    {CO_KEY(0x1014, 0, CO_OBJ__N__RW), CO_TEMCY_ID, (CO_DATA)(&EmcyId)},
    {CO_KEY(0x1015, 0, CO_OBJ_____RW), CO_TUNSIGNED16, (CO_DATA)(&EmcyInhibit)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1028, 1, CO_OBJ_____RW), CO_TEMCY_CONS, (CO_DATA)(&EmcyOfNode1)},  // sub-index: node-ID
};

enum { TOO_HOT, NO_SUPPLY, ERROR_NUM };

static CO_EMCY_TBL Errors[ERROR_NUM] = {
    {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_DEVICE_ERR},
    {CO_EMCY_REG_VOLTAGE, CO_EMCY_CODE_VOL_INPUT_ERR},
};

static void StartNode(void) {
  Spec.EmcyCode = Errors;
  Ext.EmcyNum = ERROR_NUM;
  TEST_ASSERT_EQUAL_INT(CO_ERR_NONE, BenchStart(Dictionary, BENCH_NUM(Dictionary)));
}

void an_error_is_raised_and_cleared(void) {
  StartNode();
  CO_NODE* node = &Node;
  COEmcySet(&node->Emcy, TOO_HOT, NULL);
  TEST_ASSERT_EQUAL_STRING("085: 00 42 09 00 00 00 00 00", BenchRun(1));
  TEST_ASSERT_EQUAL_HEX8(0x09, ErrorRegister);
  CO_EMCY_USR details = {0x1234, {0x34, 0x12, 3, 4, 5}};
  COEmcySet(&node->Emcy, NO_SUPPLY, &details);
  TEST_ASSERT_EQUAL_STRING("085: 00 31 0D 34 12 03 04 05", BenchRun(1));
  COEmcyClr(&node->Emcy, TOO_HOT);
  TEST_ASSERT_EQUAL_STRING("085: 00 00 05 00 00 00 00 00", BenchRun(1));
  // 1003h: two errors, the newest first; writing 0 to sub-index 0 empties it
  TEST_ASSERT_EQUAL_STRING("585: 4F 03 10 00 02 00 00 00", BenchSend("605: 40 03 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 43 03 10 01 00 31 34 12", BenchSend("605: 40 03 10 01 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 60 03 10 00 00 00 00 00", BenchSend("605: 2F 03 10 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_STRING("585: 4F 03 10 00 00 00 00 00", BenchSend("605: 40 03 10 00 00 00 00 00"));
}

static uint16_t CodeOfNode1;

void COEmcyReceived(CO_NODE* node, uint8_t nodeId, uint16_t code, uint8_t reg, const uint8_t msef[5]) {
  (void)node;
  (void)reg;
  (void)msef;
  if (nodeId == 1) {
    CodeOfNode1 = code;  // 0: the error of node 1 is resolved
  }
}

void an_error_of_another_node_is_received(void) {
  StartNode();
  TEST_ASSERT_EQUAL_STRING("", BenchSend("081: 10 43 09 00 00 00 00 00"));
  TEST_ASSERT_EQUAL_HEX16(0x4310, CodeOfNode1);
}
