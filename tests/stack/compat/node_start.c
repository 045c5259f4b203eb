// SPDX-License-Identifier: Apache-2.0
// A node from power-on to the main loop, in the order of typical firmware: initialisation, error check, timers of the
// application, start, mode, loop; with a cyclic and with a compare timer, with and without non-volatile memory.
#include <string.h>

#include "co_core.h"
#include "fakes.h"
#include "unity.h"

#define DICTIONARY_LENGTH 128u /* more than the entries in use */

static uint8_t ErrorRegister;
static uint16_t HeartbeatTime = 100;
static uint8_t Seconds;

static CO_OBJ Dictionary[DICTIONARY_LENGTH] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},
    {CO_KEY(0x2100, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&Seconds)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_TMR_MEM TimerMemory[8];
static uint8_t SdoBuffer[CO_SSDO_N * CO_SDO_BUF_BYTE];

static CO_IF_DRV CyclicDrivers = {&FakeCanDriver, &FakeCyclicTimerDriver, &FakeNvmDriver};
static CO_IF_DRV DeltaDrivers = {&FakeCanDriver, &FakeDeltaTimerDriver, &FakeNvmDriver};
static CO_IF_DRV DriversWithoutNvm = {&FakeCanDriver, &FakeCyclicTimerDriver, NULL};

static CO_NODE Node;

static void CountSeconds(void* parg) {
  CO_NODE* node = (CO_NODE*)parg;
  if (CONmtGetMode(&node->Nmt) != CO_OPERATIONAL) {
    return;
  }
  uint8_t seconds = 0;
  (void)CODictRdByte(&node->Dict, CO_DEV(0x2100, 0), &seconds);
  (void)CODictWrByte(&node->Dict, CO_DEV(0x2100, 0), (uint8_t)(seconds + 1));
}

void setUp(void) {
  FakesReset();
  memset(&Node, 0xA5, sizeof(Node));
  memset(TimerMemory, 0xA5, sizeof(TimerMemory));
  memset(SdoBuffer, 0xA5, sizeof(SdoBuffer));
  HeartbeatTime = 100;
  Seconds = 0;
}

/* Starts a node like typical firmware. The specification is a local variable, filled member by member. */
static void Start(CO_NODE* node, CO_IF_DRV* drivers) {
  CO_NODE_SPEC spec;
  memset(&spec, 0xA5, sizeof(spec));
  spec.NodeId = 0x0A;
  spec.Baudrate = 500000;
  spec.Dict = &Dictionary[0];
  spec.DictLen = DICTIONARY_LENGTH;
  spec.EmcyCode = NULL;
  spec.TmrMem = &TimerMemory[0];
  spec.TmrNum = 8;
  spec.TmrFreq = 100;
  spec.Drv = drivers;
  spec.SdoBuf = &SdoBuffer[0];

  CONodeInit(node, &spec);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NONE, CONodeGetErr(node));
  TEST_ASSERT_EQUAL(CO_INIT, CONmtGetMode(&node->Nmt));
  TEST_ASSERT_SENT("");

  const uint32_t ticks = COTmrGetTicks(&node->Tmr, 1000, CO_TMR_UNIT_1MS);
  TEST_ASSERT_EQUAL_UINT32(100, ticks);
  TEST_ASSERT_GREATER_OR_EQUAL(0, COTmrCreate(&node->Tmr, 0, ticks, CountSeconds, node));

  CONodeStart(node);
  TEST_ASSERT_SENT("70A#00");
  TEST_ASSERT_EQUAL(CO_PREOP, CONmtGetMode(&node->Nmt));
  CONmtSetMode(&node->Nmt, CO_OPERATIONAL);
  TEST_ASSERT_EQUAL(CO_OPERATIONAL, CONmtGetMode(&node->Nmt));
  TEST_ASSERT_EQUAL(CO_ERR_NONE, CONodeGetErr(node));
}

static void ExpectARunningNode(CO_NODE* node) {
  for (int i = 0; i < 9; i++) {
    TimePasses(node, 10);
    TEST_ASSERT_SENT("70A#05");
    TEST_ASSERT_SENT("");
  }
  TEST_ASSERT_EQUAL_UINT8(0, Seconds);
  TimePasses(node, 10);
  TEST_ASSERT_SENT("70A#05");
  TEST_ASSERT_EQUAL_UINT8(1, Seconds);
  BusReceive(node, "60A#4000210000000000");
  TEST_ASSERT_SENT("58A#4F00210001000000");
}

static void test_a_node_runs_with_a_cyclic_timer(void) {
  Start(&Node, &CyclicDrivers);
  ExpectARunningNode(&Node);
}

static void test_a_node_runs_with_a_compare_timer(void) {
  Start(&Node, &DeltaDrivers);
  ExpectARunningNode(&Node);
}

static void test_a_node_runs_without_non_volatile_memory(void) {
  Start(&Node, &DriversWithoutNvm);
  ExpectARunningNode(&Node);
  TEST_ASSERT_EQUAL(0, Fakes.NvmInits);
}

static void test_a_node_on_the_stack_needs_no_initialisation(void) {
  CO_NODE node;
  memset(&node, 0xA5, sizeof(node));
  Start(&node, &CyclicDrivers);
  ExpectARunningNode(&node);
  CONodeStop(&node);
}

static void test_init_prepares_the_drivers_once(void) {
  Start(&Node, &CyclicDrivers);
  TEST_ASSERT_EQUAL(1, Fakes.CanInits);
  TEST_ASSERT_EQUAL(1, Fakes.CanEnables);
  TEST_ASSERT_EQUAL(1, Fakes.NvmInits);
  TEST_ASSERT_EQUAL_UINT32(500000, Fakes.Baudrate);
  TEST_ASSERT_EQUAL_UINT32(100, Fakes.TimerFreq);
}

static void test_handles_of_the_node_can_be_read(void) {
  Start(&Node, &CyclicDrivers);
  TEST_ASSERT_EQUAL_UINT8(0x0A, Node.NodeId);
  TEST_ASSERT_EQUAL_UINT32(500000, Node.Baudrate);
  TEST_ASSERT_EQUAL_UINT8(0x0A, CONmtGetNodeId(&Node.Nmt));
}

static void test_the_master_commands_the_mode(void) {
  Start(&Node, &CyclicDrivers);
  BusReceive(&Node, "000#8000");
  TEST_ASSERT_EQUAL(CO_PREOP, CONmtGetMode(&Node.Nmt));
  BusReceive(&Node, "000#020A");
  TEST_ASSERT_EQUAL(CO_STOP, CONmtGetMode(&Node.Nmt));
  BusReceive(&Node, "000#0100");
  TEST_ASSERT_EQUAL(CO_OPERATIONAL, CONmtGetMode(&Node.Nmt));
}

static void test_heartbeat_and_timers_of_the_application_survive_a_communication_reset(void) {
  Start(&Node, &CyclicDrivers);
  BusReceive(&Node, "000#8200");
  TEST_ASSERT_SENT("70A#00");
  TimePasses(&Node, 10);
  TEST_ASSERT_SENT("70A#7F");
  CONmtSetMode(&Node.Nmt, CO_OPERATIONAL);
  TimePasses(&Node, 90);
  TEST_ASSERT_EQUAL_UINT8(1, Seconds);
}

static void test_a_stopped_node_starts_anew(void) {
  Start(&Node, &CyclicDrivers);
  CONodeStop(&Node);
  TEST_ASSERT_EQUAL(CO_INVALID, CONmtGetMode(&Node.Nmt));
  TEST_ASSERT_EQUAL(1, Fakes.CanCloses);
  TimePasses(&Node, 50);
  TEST_ASSERT_SENT("");
  Start(&Node, &CyclicDrivers);
  ExpectARunningNode(&Node);
}

static void test_the_node_id_changes_before_the_start(void) {
  CO_NODE_SPEC spec = {0x0A,        500000, Dictionary, DICTIONARY_LENGTH, NULL,
                       TimerMemory, 8,      100,        &CyclicDrivers,    SdoBuffer};
  CONodeInit(&Node, &spec);
  CONmtSetNodeId(&Node.Nmt, 0x0B);
  CONmtReset(&Node.Nmt, CO_RESET_NODE);
  CONodeStart(&Node);
  TEST_ASSERT_SENT("70B#00");
  BusReceive(&Node, "60B#4000210000000000");
  TEST_ASSERT_SENT("58B#4F00210000000000");
}

static void test_the_last_error_is_kept_until_it_is_read(void) {
  Start(&Node, &CyclicDrivers);
  CONmtSetNodeId(&Node.Nmt, 5);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NMT_MODE, CONodeGetErr(&Node));
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NONE, CONodeGetErr(&Node));
  Fakes.CanBroken = 1;
  CONodeProcess(&Node);
  Fakes.CanBroken = 0;
  CONodeProcess(&Node);
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_IF_CAN_READ, CONodeGetErr(&Node));
}

static void test_timers_of_the_application_are_deleted_and_exhausted(void) {
  int16_t ids[9];
  Start(&Node, &CyclicDrivers);
  for (int i = 0; i < 7; i++) {
    ids[i] = COTmrCreate(&Node.Tmr, 5, 0, CountSeconds, &Node);
    TEST_ASSERT_GREATER_OR_EQUAL(0, ids[i]);
  }
  TEST_ASSERT_EQUAL(-1, COTmrCreate(&Node.Tmr, 5, 0, CountSeconds, &Node));
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_TMR_NO_ACT, CONodeGetErr(&Node));
  TEST_ASSERT_EQUAL(0, COTmrDelete(&Node.Tmr, ids[0]));
  TEST_ASSERT_EQUAL(-1, COTmrDelete(&Node.Tmr, ids[0]));
  TimePasses(&Node, 5);
  TEST_ASSERT_EQUAL_UINT8(6, Seconds);
}

static void test_the_interface_reaches_the_drivers(void) {
  uint8_t out[4] = {1, 2, 3, 4};
  uint8_t in[4] = {0, 0, 0, 0};
  CO_IF_FRM frm;
  Start(&Node, &CyclicDrivers);
  TEST_ASSERT_EQUAL_UINT32(4, COIfNvmWrite(&Node.If, 8, out, 4));
  TEST_ASSERT_EQUAL_UINT32(4, COIfNvmRead(&Node.If, 8, in, 4));
  TEST_ASSERT_EQUAL_HEX8_ARRAY(out, in, 4);
  CO_SET_ID(&frm, 0x123);
  CO_SET_DLC(&frm, 2);
  CO_SET_WORD(&frm, 0xABCD, 0);
  TEST_ASSERT_EQUAL(sizeof(CO_IF_FRM), COIfCanSend(&Node.If, &frm));
  TEST_ASSERT_SENT("123#CDAB");
}

static void test_without_non_volatile_memory_nothing_is_stored(void) {
  uint8_t bytes[4] = {1, 2, 3, 4};
  Start(&Node, &DriversWithoutNvm);
  TEST_ASSERT_EQUAL_UINT32(0, COIfNvmWrite(&Node.If, 0, bytes, 4));
  TEST_ASSERT_EQUAL_UINT32(0, COIfNvmRead(&Node.If, 0, bytes, 4));
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_node_runs_with_a_cyclic_timer);
  RUN_TEST(test_a_node_runs_with_a_compare_timer);
  RUN_TEST(test_a_node_runs_without_non_volatile_memory);
  RUN_TEST(test_a_node_on_the_stack_needs_no_initialisation);
  RUN_TEST(test_init_prepares_the_drivers_once);
  RUN_TEST(test_handles_of_the_node_can_be_read);
  RUN_TEST(test_the_master_commands_the_mode);
  RUN_TEST(test_heartbeat_and_timers_of_the_application_survive_a_communication_reset);
  RUN_TEST(test_a_stopped_node_starts_anew);
  RUN_TEST(test_the_node_id_changes_before_the_start);
  RUN_TEST(test_the_last_error_is_kept_until_it_is_read);
  RUN_TEST(test_timers_of_the_application_are_deleted_and_exhausted);
  RUN_TEST(test_the_interface_reaches_the_drivers);
  RUN_TEST(test_without_non_volatile_memory_nothing_is_stored);
  return UNITY_END();
}
