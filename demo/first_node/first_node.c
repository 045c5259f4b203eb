// SPDX-License-Identifier: Apache-2.0
#include <stdio.h>
#include "co_can_virtual.h"
#include "co_core.h"
#include "co_virtual_clock.h"

static uint8_t ErrorRegister, Hour = 12;
static uint16_t HeartbeatTime = 500;  // ms
static CO_OBJ Od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // device type: no profile
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},   // identity: one entry
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // vendor-ID
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_VAR(UNSIGNED8, Hour)},
    CO_OBJ_DICT_ENDMARK,
};

static void Print(void* clock, const CO_IF_FRM* frame, const char* sender) {
  printf("%4u ms, %s: %03X %02X\n", COVirtualClockNow(clock), sender, frame->Identifier, frame->Data[0]);
}

int main(void) {
  static CO_NODE node;
  CO_VIRTUAL_BUS* bus = COVirtualBusNew();
  CO_VIRTUAL_CLOCK* clock = COVirtualClockNew();
  CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 250000, .Dict = Od, .DictLen = sizeof Od / sizeof *Od, .TmrFreq = 1000};
  CO_NODE_EXT drivers = {.Size = sizeof(drivers), .Can = &COVirtualBusDriver, .Timer = &COVirtualTimerDriver};
  drivers.CanCtx = COVirtualBusAttach(bus, "node 5");
  drivers.TimerCtx = COVirtualTimerNew(clock);
  COVirtualBusTrace(bus, Print, clock);
  CONodeInitEx(&node, &spec, &drivers);
  CONodeStart(&node);
  for (int ms = 0; ms < 2000; ++ms, COVirtualClockAdvance(clock, 1)) {  // the main loop
    CONodeProcess(&node);
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  char text[CO_NODE_ERR_TEXT];
  CONodeGetErrText(&node, text, sizeof text);
  puts(text);
}
