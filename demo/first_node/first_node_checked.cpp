// SPDX-License-Identifier: Apache-2.0
// first_node.c in C++: the compiler checks the dictionary, and values of objects have types.
#include <cstdio>

#include "co_can_virtual.h"
#include "co_core.h"
#include "co_virtual_clock.h"
#include "lexican/dictionary.hpp"
#include "lexican/object.hpp"

static std::uint8_t error_register, hour = 12;
static std::uint16_t heartbeat_time = 500;  // ms

constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&heartbeat_time)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x2100, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&hour)},
};
CO_OD_CHECK(od);  // a mistake names the entry in the compiler's message

static void print(void* clock, const CO_IF_FRM* frame, const char* sender) {
  std::printf("%4u ms, %s: %03X %02X\n", COVirtualClockNow(static_cast<CO_VIRTUAL_CLOCK*>(clock)), sender,
              frame->Identifier, frame->Data[0]);
}

int main() {
  static CO_NODE node;
  CO_VIRTUAL_BUS* const bus = COVirtualBusNew();
  CO_VIRTUAL_CLOCK* const clock = COVirtualClockNew();
  CO_NODE_SPEC spec = {};
  spec.NodeId = 5;
  spec.Baudrate = 250000;
  spec.Dict = const_cast<CO_OBJ*>(od);
  spec.DictLen = sizeof(od) / sizeof(od[0]);
  spec.TmrFreq = 1000;
  CO_NODE_EXT drivers = {};
  drivers.Size = sizeof(drivers);
  drivers.Can = &COVirtualBusDriver;
  drivers.CanCtx = COVirtualBusAttach(bus, "node 5");
  drivers.Timer = &COVirtualTimerDriver;
  drivers.TimerCtx = COVirtualTimerNew(clock);
  COVirtualBusTrace(bus, print, clock);
  CONodeInitEx(&node, &spec, &drivers);
  CONodeStart(&node);
  const auto shown_hour = co::object<std::uint8_t>(node, 0x2100, 0);
  if (const CO_ERR error = shown_hour.set(13); error != CO_ERR_NONE) {
    std::puts(COErrText(error));
  }
  for (int ms = 0; ms < 2000; ++ms, COVirtualClockAdvance(clock, 1)) {
    CONodeProcess(&node);
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  std::printf("hour: %u\n", shown_hour.get().value());
  char text[CO_NODE_ERR_TEXT];
  CONodeGetErrText(&node, text, sizeof text);
  std::puts(text);
}
