// SPDX-License-Identifier: Apache-2.0
// A node behind an MCP2515 with a crystal of 16 MHz: node-ID 5 at 500 kbit/s, SDO server, heartbeat, an LED that SDO
// and an RPDO switch. It leaves bus-off half a second after it has occurred.
#include "board.h"
#include "co_can_mcp2515.h"
#include "co_core.h"
#include "co_timer_software.h"

// Variables of the object dictionary
static uint8_t ErrorRegister;
static uint16_t HeartbeatTime = 1000;  // ms
static uint8_t Led;

static CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // device type: no profile
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // vendor-ID: get one from CiA
    // RPDO 1, received at 200h + node-ID
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Led)},
    CO_OBJ_DICT_ENDMARK,
};

// The controller
static const CO_CAN_MCP2515_RATE Rates[] = {CO_CAN_MCP2515_RATE_OF(16000000, 500000, 16)};
static const CO_CAN_SPI Spi = {BoardSelect, BoardTransfer, BoardHasInterrupt};
static CO_IF_FRM Frames[32];
static CO_CAN_MCP2515 Can = {.Spi = &Spi, .Rates = Rates, .RateNum = 1, .Frames = Frames, .FrameNum = 32};

static CO_NODE Node;
static CO_TMR_MEM Timers[2];
CO_SDO_BUFFER(SdoBuffer);

void CanInterrupt(void) { COCanMcp2515Interrupt(&Can); }

void TickInterrupt(void) { (void)COTmrService(&Node.Tmr); }

// Leaves bus-off. If the fault of the bus persists, bus-off occurs again.
static void Recover(void* unused) {
  CO_UNUSED(unused);
  COIfCanReset(&Node.If);
}

static void CanChange(CO_NODE* node, void* user, CO_CAN_EVENT event) {
  CO_UNUSED(user);
  if (event == CO_CAN_BUS_OFF) {
    (void)COTmrCreate(&node->Tmr, COTmrGetTicks(&node->Tmr, 500, CO_TMR_UNIT_1MS), 0, Recover, NULL);
  }
}

int main(void) {
  static const CO_CALLBACKS callbacks = {.CanChange = CanChange};
  static CO_IF_DRV timer = {.Timer = &SoftwareTimerDriver};
  static CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 500000, .TmrMem = Timers, .TmrNum = 2, .TmrFreq = 1000};
  static CO_NODE_EXT drivers = {.Size = sizeof(drivers), .Can = &Mcp2515CanDriver, .CanCtx = &Can};
  BoardStart();
  spec.Dict = Dictionary;
  spec.DictLen = sizeof(Dictionary) / sizeof(Dictionary[0]);
  spec.Drv = &timer;
  spec.SdoBuf = SdoBuffer;
  drivers.Lock = BoardDisableInterrupts;
  drivers.Unlock = BoardEnableInterrupts;
  drivers.Callbacks = &callbacks;
  drivers.SdoBufLen = SdoBufferLen;
  CONodeInitEx(&Node, &spec, &drivers);
  CONodeStart(&Node);
  do {
    CONodeProcess(&Node);
    COTmrProcess(&Node.Tmr);
    BoardLed(Led != 0);
  } while (COCanMcp2515HasFrames(&Can) || BoardWait());
  CONodeStop(&Node);
  return 0;
}
