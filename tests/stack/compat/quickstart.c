// SPDX-License-Identifier: Apache-2.0
// A first program in the style of CANopen-Stack 4.x: constant dictionary with end mark, drivers as tables of functions,
// CO_NODE_SPEC, CONodeInit(), error check, cyclic timer, CONodeStart(), loop. The CAN driver uses a virtual bus, on
// which a second controller is the NMT master and SDO client.
#include <stdio.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif
#include "co_can_virtual.h"
#include "co_core.h"
#ifdef __cplusplus
}
#endif

#include "unity.h"

/* --- dictionary of a conveyor that counts pieces --- */

static uint8_t ErrorRegister;
static uint16_t HeartbeatTime; /* ms; 0: no heartbeat */
static uint32_t Pieces;
static uint16_t Speed = 120;
static const uint32_t TpdoMap[] = {CO_LINK(0x2100, 1, 32), CO_LINK(0x2100, 2, 16)};

static const CO_OBJ ConveyorOD[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x00000000)},
    {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},

    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(4)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 3, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},

    {CO_KEY(0x1200, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1200, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_REQUEST())},
    {CO_KEY(0x1200, 2, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_SDO_RESPONSE())},

    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TUNSIGNED32, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(254)},

    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1A00, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&TpdoMap[0])},
    {CO_KEY(0x1A00, 2, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)(&TpdoMap[1])},

    {CO_KEY(0x2100, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x2100, 1, CO_OBJ___APR_), CO_TUNSIGNED32, (CO_DATA)(&Pieces)},
    {CO_KEY(0x2100, 2, CO_OBJ____PRW), CO_TUNSIGNED16, (CO_DATA)(&Speed)},
    CO_OBJ_DICT_ENDMARK,
};

/* --- drivers --- */

static CO_VIRTUAL_BUS* Bus;
static CO_VIRTUAL_PORT* Controller;
static uint32_t TicksLeft;
static uint8_t Eeprom[32];

static void CanInit(void) {}
static void CanEnable(uint32_t baud) { COVirtualPortEnable(Controller, baud); }
static int16_t CanRead(CO_IF_FRM* frm) { return COVirtualPortRead(Controller, frm); }
static int16_t CanSend(CO_IF_FRM* frm) { return COVirtualPortSend(Controller, frm); }
static void CanReset(void) {}
static void CanClose(void) {}

static void TimerInit(uint32_t freq) { (void)freq; }
static void TimerReload(uint32_t ticks) { TicksLeft = ticks; }
static uint32_t TimerDelay(void) { return TicksLeft; }
static void TimerStop(void) { TicksLeft = 0; }
static void TimerStart(void) {}
static uint8_t TimerUpdate(void) { return TicksLeft > 0 && --TicksLeft == 0 ? 1 : 0; }

static void NvmInit(void) {}

static uint32_t NvmRead(uint32_t start, uint8_t* buffer, uint32_t size) {
  memcpy(buffer, &Eeprom[start], size);
  return size;
}

static uint32_t NvmWrite(uint32_t start, uint8_t* buffer, uint32_t size) {
  memcpy(&Eeprom[start], buffer, size);
  return size;
}

static const CO_IF_CAN_DRV CanDriver = {CanInit, CanEnable, CanRead, CanSend, CanReset, CanClose};
static const CO_IF_TIMER_DRV TimerDriver = {TimerInit, TimerReload, TimerDelay, TimerStop, TimerStart, TimerUpdate};
static const CO_IF_NVM_DRV NvmDriver = {NvmInit, NvmRead, NvmWrite};
static CO_IF_DRV ConveyorDriver = {&CanDriver, &TimerDriver, &NvmDriver};

/* --- specification --- */

#define CONVEYOR_TICKS_PER_SECOND 100u
#define CONVEYOR_TMR_N 4u
#define CONVEYOR_OBJ_N (sizeof(ConveyorOD) / sizeof(ConveyorOD[0]))

static CO_TMR_MEM TmrMem[CONVEYOR_TMR_N];
static uint8_t SdoSrvMem[CO_SSDO_N * CO_SDO_BUF_BYTE];

static CO_NODE_SPEC ConveyorSpec = {
    1u,                        /* default node-ID */
    250000u,                   /* default bit rate */
    (CO_OBJ*)&ConveyorOD[0],   /* dictionary */
    CONVEYOR_OBJ_N,            /* length of the dictionary */
    NULL,                      /* EMCY table */
    &TmrMem[0],                /* timers */
    CONVEYOR_TMR_N,            /* number of timers */
    CONVEYOR_TICKS_PER_SECOND, /* timer frequency */
    &ConveyorDriver,           /* drivers */
    &SdoSrvMem[0]              /* SDO transfer buffer */
};

/* --- application --- */

static CO_NODE Conveyor;

static void CountPieces(void* p_arg) {
  CO_NODE* node = (CO_NODE*)p_arg;
  uint32_t pieces = 0;
  if (CONmtGetMode(&node->Nmt) != CO_OPERATIONAL) {
    return;
  }
  (void)CODictRdLong(&node->Dict, CO_DEV(0x2100, 1), &pieces);
  (void)CODictWrLong(&node->Dict, CO_DEV(0x2100, 1), pieces + 1u);
}

static CO_ERR Start(void) {
  CONodeInit(&Conveyor, &ConveyorSpec);
  const CO_ERR err = CONodeGetErr(&Conveyor);
  if (err != CO_ERR_NONE) {
    return err;
  }
  const uint32_t ticks = COTmrGetTicks(&Conveyor.Tmr, 1000, CO_TMR_UNIT_1MS);
  TEST_ASSERT_GREATER_OR_EQUAL(0, COTmrCreate(&Conveyor.Tmr, 0, ticks, CountPieces, &Conveyor));
  CONodeStart(&Conveyor);
  return CONodeGetErr(&Conveyor);
}

/* Runs the main loop of the firmware for some ticks of the timer interrupt. */
static void Loop(uint32_t ticks) {
  while (ticks-- > 0) {
    COTmrService(&Conveyor.Tmr); /* timer interrupt */
    CONodeProcess(&Conveyor);
    COTmrProcess(&Conveyor.Tmr);
  }
}

/* --- master on the bus --- */

static CO_VIRTUAL_PORT* Master;
static char Received[1024];

static void Send(uint32_t identifier, uint8_t dlc, const uint8_t* data) {
  CO_IF_FRM frame;
  memset(&frame, 0, sizeof(frame));
  frame.Identifier = identifier;
  frame.DLC = dlc;
  memcpy(frame.Data, data, dlc);
  TEST_ASSERT_EQUAL(sizeof(CO_IF_FRM), COVirtualPortSend(Master, &frame));
}

/* Returns the frames that the master has received since the last call, in the notation of candump. */
static const char* FramesReceived(void) {
  CO_IF_FRM frame;
  size_t at = 0;
  Received[0] = 0;
  while (COVirtualPortRead(Master, &frame) > 0) {
    at += (size_t)snprintf(&Received[at], sizeof(Received) - at, "%s%03X#", at > 0 ? " " : "",
                           (unsigned)frame.Identifier);
    for (uint8_t i = 0; i < frame.DLC; i++) {
      at += (size_t)snprintf(&Received[at], sizeof(Received) - at, "%02X", (unsigned)frame.Data[i]);
    }
  }
  return Received;
}

#define TEST_ASSERT_FRAMES(frames) TEST_ASSERT_EQUAL_STRING(frames, FramesReceived())

void setUp(void) {
  Bus = COVirtualBusNew();
  Controller = COVirtualBusAttach(Bus, "conveyor");
  Master = COVirtualBusAttach(Bus, "master");
  COVirtualPortEnable(Master, 0);
  TicksLeft = 0;
  HeartbeatTime = 0;
  Pieces = 0;
  ConveyorSpec.NodeId = 1;
}

void tearDown(void) { COVirtualBusFree(Bus); }

static void test_the_node_boots(void) {
  TEST_ASSERT_EQUAL(CO_ERR_NONE, Start());
  TEST_ASSERT_FRAMES("701#00");
  TEST_ASSERT_EQUAL(CO_PREOP, CONmtGetMode(&Conveyor.Nmt));
  Loop(3 * CONVEYOR_TICKS_PER_SECOND);
  TEST_ASSERT_FRAMES("");
}

static void test_the_error_check_names_a_wrong_node_id(void) {
  ConveyorSpec.NodeId = 128;
  TEST_ASSERT_EQUAL(CO_ERR_NODE_ID, Start());
  TEST_ASSERT_FRAMES("");
}

static void test_the_cyclic_callback_sends_a_tpdo_each_second(void) {
  static const uint8_t start[] = {1, 1};
  TEST_ASSERT_EQUAL(CO_ERR_NONE, Start());
  TEST_ASSERT_FRAMES("701#00");
  Send(0x000, 2, start);
  Loop(CONVEYOR_TICKS_PER_SECOND - 1);
  TEST_ASSERT_FRAMES("");
  Loop(1);
  TEST_ASSERT_FRAMES("181#010000007800");
  Loop(3 * CONVEYOR_TICKS_PER_SECOND);
  TEST_ASSERT_FRAMES("181#020000007800 181#030000007800 181#040000007800");
}

static void test_a_client_reads_and_writes_objects(void) {
  static const uint8_t read[] = {0x40, 0x00, 0x21, 0x02, 0, 0, 0, 0};
  static const uint8_t write[] = {0x2B, 0x17, 0x10, 0x00, 0xF4, 0x01, 0, 0};
  static const uint8_t write_const[] = {0x2F, 0x00, 0x21, 0x00, 9, 0, 0, 0};
  TEST_ASSERT_EQUAL(CO_ERR_NONE, Start());
  TEST_ASSERT_FRAMES("701#00");
  Send(0x601, 8, read);
  Loop(1);
  TEST_ASSERT_FRAMES("581#4B00210278000000");
  Send(0x601, 8, write_const);
  Loop(1);
  TEST_ASSERT_FRAMES("581#8000210002000106");
  Send(0x601, 8, write);
  Loop(1);
  TEST_ASSERT_FRAMES("581#6017100000000000");
  Loop(CONVEYOR_TICKS_PER_SECOND);
  TEST_ASSERT_FRAMES("701#7F 701#7F");
}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_the_node_boots);
  RUN_TEST(test_the_error_check_names_a_wrong_node_id);
  RUN_TEST(test_the_cyclic_callback_sends_a_tpdo_each_second);
  RUN_TEST(test_a_client_reads_and_writes_objects);
  return UNITY_END();
}
