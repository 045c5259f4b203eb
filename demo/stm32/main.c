// SPDX-License-Identifier: Apache-2.0
// A node with node-ID 5 at 500 kbit/s: SDO server, heartbeat, a TPDO with a counter, an LED that SDO and an RPDO
// switch. It leaves bus-off half a second after it has occurred. "save" (1010h) stores the times of heartbeat and TPDO,
// if the board has a memory.
#include "board.h"
#include "co_core.h"
#include "co_timer_systick.h"

typedef struct PARAMETERS {
  uint16_t HeartbeatTime;  // ms
  uint16_t EventTime;      // of the TPDO, ms
} PARAMETERS;

static PARAMETERS Parameters;
static const PARAMETERS Defaults = {1000, 1000};
static const CO_PARA Group = {.Offset = 0,
                              .Size = sizeof(Parameters),
                              .Start = (uint8_t*)&Parameters,
                              .Default = (uint8_t*)&Defaults,
                              .Type = CO_RESET_COM,
                              .Value = CO_PARA___E};

// Other variables of the object dictionary
static uint8_t ErrorRegister;
static uint32_t Seconds;
static uint8_t Led;

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // device type: no profile
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Group)},
    {CO_KEY(0x1011, 0, CO_OBJ_D___R_), CO_TPARA_RESTORE, (CO_DATA)(1)},
    {CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&Group)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&Parameters.HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // vendor-ID: get one from CiA
    // RPDO 1, received at 200h + node-ID
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    // TPDO 1, sent at 180h + node-ID
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1800, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&Parameters.EventTime)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 32))},
    {CO_KEY(0x2000, 0, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)(&Seconds)},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Led)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;
static CO_TMR_MEM Timers[2];
CO_SDO_BUFFER(SdoBuffer);
static CO_SYSTICK SysTick;

static volatile bool Happened;  // an interrupt has occurred since the current iteration of the loop began

void CanHandler(void) {
  BoardCanInterrupt();
  Happened = true;
}

void SysTickHandler(void) {
  COSysTickInterrupt(&SysTick);
  (void)COTmrService(&Node.Tmr);
  Happened = true;
}

static void DisableInterrupts(void) { __asm volatile("cpsid i" ::: "memory"); }
static void EnableInterrupts(void) { __asm volatile("cpsie i" ::: "memory"); }

// The timer interrupt is disabled while the timer lists change. The calls do not nest.
void COTmrLock(void) { DisableInterrupts(); }
void COTmrUnlock(void) { EnableInterrupts(); }

static void CountSecond(void* unused) {
  CO_UNUSED(unused);
  ++Seconds;
}

// Leaves bus-off. If the fault of the bus persists, bus-off occurs again.
static void Recover(void* unused) {
  CO_UNUSED(unused);
  COIfCanReset(&Node.If);
}

// Called for changes of the CAN controller's state.
void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event) {
  if (event == CO_CAN_BUS_OFF) {
    (void)COTmrCreate(&node->Tmr, COTmrGetTicks(&node->Tmr, 500, CO_TMR_UNIT_1MS), 0, Recover, NULL);
  }
}

// Sleeps until the next interrupt, unless there is work. WFI returns when an interrupt is pending, even if interrupts
// are disabled; the interrupt is served when they are enabled again. So no interrupt can be missed between the check
// and WFI.
static void SleepUntilInterrupt(void) {
  const bool is_due = CONodeNextDeadline(&Node) == 0;
  DisableInterrupts();
  if (!Happened && !is_due && !BoardCanHasFrames()) {
    __asm volatile("dsb\n\twfi" ::: "memory");
  }
  EnableInterrupts();
}

int main(void) {
  static CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 500000, .TmrMem = Timers, .TmrNum = 2, .TmrFreq = 1000000};
  static CO_NODE_EXT drivers = {.Size = sizeof(drivers), .Timer = &SysTickDriver, .TimerCtx = &SysTick};
  BoardStart();
  SysTick.Regs = CO_SYSTICK_REGISTERS;
  SysTick.Icsr = CO_SYSTICK_CONTROL;
  SysTick.Hz = Board.Hz;
  spec.Dict = (CO_OBJ*)Dictionary;
  spec.DictLen = sizeof(Dictionary) / sizeof(Dictionary[0]);
  spec.SdoBuf = SdoBuffer;
  drivers.Can = Board.Can;
  drivers.CanCtx = Board.CanContext;
  drivers.Nvm = Board.Memory;
  drivers.NvmCtx = Board.MemoryContext;
  drivers.SdoBufLen = SdoBufferLen;
  CONodeInitEx(&Node, &spec, &drivers);
  (void)COTmrCreate(&Node.Tmr, 1000000, 1000000, CountSecond, NULL);
  CONodeStart(&Node);
  for (;;) {
    Happened = false;
    CONodeProcess(&Node);
    COTmrProcess(&Node.Tmr);
    BoardLed(Led != 0);
    SleepUntilInterrupt();
  }
}
