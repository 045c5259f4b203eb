// SPDX-License-Identifier: Apache-2.0
// The heater and a master on a virtual bus. Prints all frames.
#include <stdio.h>

#include "co_can_virtual.h"
#include "co_nvm_ram.h"
#include "co_virtual_clock.h"
#include "heater.h"
#include "heater_od.h"

#define SEND(identifier, ...) COVirtualPortSend(Master, &(CO_IF_FRM){identifier, {__VA_ARGS__}, 8})

static CO_VIRTUAL_CLOCK* Clock;
static CO_VIRTUAL_PORT* Master;

static uint8_t MemoryBytes[HEATER_PARA_END];
static CO_NVM_RAM Memory = {MemoryBytes, sizeof(MemoryBytes)};

static void Print(void* unused, const CO_IF_FRM* frame, const char* sender) {
  (void)unused;
  printf("%4u ms  %-6s  %03X ", COVirtualClockNow(Clock), sender, frame->Identifier);
  for (int n = 0; n < frame->DLC; ++n) {
    printf(" %02X", frame->Data[n]);
  }
  puts("");
}

static void Run(int milliseconds) {
  for (int ms = 0; ms < milliseconds; ++ms, COVirtualClockAdvance(Clock, 1)) {
    (void)HeaterRun();
  }
}

int main(void) {
  CO_VIRTUAL_BUS* bus = COVirtualBusNew();
  CO_NODE_EXT drivers = {.Can = &COVirtualBusDriver, .CanCtx = COVirtualBusAttach(bus, "heater")};
  Clock = COVirtualClockNew();
  Master = COVirtualBusAttach(bus, "master");
  drivers.Timer = &COVirtualTimerDriver;
  drivers.TimerCtx = COVirtualTimerNew(Clock);
  drivers.Nvm = &RamNvmDriver;
  drivers.NvmCtx = &Memory;
  CONvmRamClear(&Memory);
  COVirtualPortEnable(Master, 250000);
  COVirtualBusTrace(bus, Print, NULL);

  if (!HeaterStart(&drivers, 5)) {
    return 1;
  }
  Run(10);
  puts("NMT: start the node");
  COVirtualPortSend(Master, &(CO_IF_FRM){0x000, {0x01, 5}, 2});
  Run(10);
  puts("SDO: setpoint 900.0 degrees, beyond its limit");
  SEND(0x605, 0x2B, 0x01, 0x20, 0x00, 0x28, 0x23);
  Run(10);
  puts("SDO: setpoint 20.2 degrees; the temperature rises");
  SEND(0x605, 0x2B, 0x01, 0x20, 0x00, 0xCA, 0x00);
  Run(270);
  puts("SDO: read the log");
  SEND(0x605, 0x40, 0x02, 0x20, 0x00);
  Run(10);
  SEND(0x605, 0x60);
  Run(10);
  puts("the sensor breaks, and is replaced");
  HeaterBreakSensor(true);
  Run(100);
  HeaterBreakSensor(false);
  Run(100);
  puts("SDO: save");
  SEND(0x605, 0x23, 0x10, 0x10, 0x01, 's', 'a', 'v', 'e');
  Run(10);
  puts("power off and on; SDO: read the setpoint");
  HeaterStop();
  if (!HeaterStart(&drivers, 5)) {
    return 1;
  }
  Run(10);
  SEND(0x605, 0x40, 0x01, 0x20, 0x00);
  Run(10);
  COVirtualBusFree(bus);
  return 0;
}
