// SPDX-License-Identifier: Apache-2.0
// Checks that the application's definitions of callbacks replace the stack's weak ones.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(0)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
};

static CO_NODE Node;

static unsigned ModeChanges;
static CO_NMT* ChangedNmt;
static CO_MODE ModeBefore;
static CO_MODE ModeAnnounced;
static unsigned ResetRequests;
static CO_NMT_RESET RequestedReset;
static CO_MODE ModeInResetRequest;
static unsigned FramesReceived;
static CO_IF_FRM FrameReceived;
static unsigned Locks;
static unsigned Unlocks;
static int LockDepth;
static unsigned FatalErrors;

void CONmtModeChange(CO_NMT* nmt, CO_MODE mode) {
  ModeChanges++;
  ChangedNmt = nmt;
  ModeBefore = nmt->Mode;
  ModeAnnounced = mode;
}

void CONmtResetRequest(CO_NMT* nmt, CO_NMT_RESET reset) {
  ResetRequests++;
  RequestedReset = reset;
  ModeInResetRequest = CONmtGetMode(nmt);
}

void COIfCanReceive(CO_IF_FRM* frm) {
  FramesReceived++;
  FrameReceived = *frm;
}

void COTmrLock(void) {
  Locks++;
  LockDepth++;
}

void COTmrUnlock(void) {
  Unlocks++;
  LockDepth--;
}

void CONodeFatalError(void) { FatalErrors++; }

void setUp(void) {
  NodeUp(&Node, Dictionary, sizeof(Dictionary) / sizeof(Dictionary[0]));
  ModeChanges = 0;
  ResetRequests = 0;
  FramesReceived = 0;
  FatalErrors = 0;
}

static void test_a_change_of_the_mode_is_announced_before_it_happens(void) {
  CONmtSetMode(&Node.Nmt, CO_OPERATIONAL);
  TEST_ASSERT_EQUAL(1, ModeChanges);
  TEST_ASSERT_EQUAL_PTR(&Node.Nmt, ChangedNmt);
  TEST_ASSERT_EQUAL(CO_PREOP, ModeBefore);
  TEST_ASSERT_EQUAL(CO_OPERATIONAL, ModeAnnounced);
  BusReceive(&Node, "000#0201");
  TEST_ASSERT_EQUAL(2, ModeChanges);
  TEST_ASSERT_EQUAL(CO_STOP, ModeAnnounced);
}

static void test_a_commanded_reset_is_told_after_it_happened(void) {
  BusReceive(&Node, "000#8201");
  TEST_ASSERT_EQUAL(1, ResetRequests);
  TEST_ASSERT_EQUAL(CO_RESET_COM, RequestedReset);
  TEST_ASSERT_EQUAL(CO_PREOP, ModeInResetRequest);
  BusReceive(&Node, "000#8100");
  TEST_ASSERT_EQUAL(2, ResetRequests);
  TEST_ASSERT_EQUAL(CO_RESET_NODE, RequestedReset);
}

static void test_a_reset_of_the_application_is_not_told(void) {
  CONmtReset(&Node.Nmt, CO_RESET_COM);
  TEST_ASSERT_EQUAL(0, ResetRequests);
}

static void test_a_frame_that_nobody_claims_is_given_to_the_application(void) {
  BusReceive(&Node, "123#0102030405");
  TEST_ASSERT_EQUAL(1, FramesReceived);
  TEST_ASSERT_EQUAL_HEX32(0x123, CO_GET_ID(&FrameReceived));
  TEST_ASSERT_EQUAL(5, CO_GET_DLC(&FrameReceived));
  TEST_ASSERT_EQUAL_HEX8(0x05, CO_GET_BYTE(&FrameReceived, 4));
}

static void test_a_frame_of_a_service_is_not_given_to_the_application(void) {
  BusReceive(&Node, "000#0100");
  BusReceive(&Node, "601#4000100000000000");
  TEST_ASSERT_EQUAL(0, FramesReceived);
}

static void Nothing(void* parg) { CO_UNUSED(parg); }

static void test_changes_of_the_timers_are_locked_and_actions_are_not(void) {
  CO_TMR tmr;
  CO_TMR_MEM memory[2];
  memset(&tmr, 0xA5, sizeof(tmr));
  COTmrInit(&tmr, &Node, memory, 2, 1000);
  Locks = 0;
  Unlocks = 0;
  const int16_t id = COTmrCreate(&tmr, 5, 0, Nothing, NULL);
  TEST_ASSERT_GREATER_OR_EQUAL(0, id);
  TEST_ASSERT_GREATER_THAN(0, Locks);
  TEST_ASSERT_EQUAL(0, COTmrDelete(&tmr, id));
  TEST_ASSERT_EQUAL(Locks, Unlocks);
  TEST_ASSERT_EQUAL(0, LockDepth);
}

static void test_null_arguments_that_cannot_be_reported_are_fatal(void) {
  CONodeInit(NULL, NULL);
  TEST_ASSERT_EQUAL(1, FatalErrors);
  TEST_ASSERT_EQUAL(CO_INVALID, CONmtGetMode(NULL));
  TEST_ASSERT_EQUAL(2, FatalErrors);
  TEST_ASSERT_EQUAL(0, CONmtGetNodeId(NULL));
  TEST_ASSERT_EQUAL(3, FatalErrors);
  TEST_ASSERT_EQUAL(-1, COTmrCreate(NULL, 1, 0, Nothing, NULL));
  TEST_ASSERT_EQUAL(4, FatalErrors);
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_change_of_the_mode_is_announced_before_it_happens);
  RUN_TEST(test_a_commanded_reset_is_told_after_it_happened);
  RUN_TEST(test_a_reset_of_the_application_is_not_told);
  RUN_TEST(test_a_frame_that_nobody_claims_is_given_to_the_application);
  RUN_TEST(test_a_frame_of_a_service_is_not_given_to_the_application);
  RUN_TEST(test_changes_of_the_timers_are_locked_and_actions_are_not);
  RUN_TEST(test_null_arguments_that_cannot_be_reported_are_fatal);
  return UNITY_END();
}
