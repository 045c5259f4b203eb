// SPDX-License-Identifier: Apache-2.0
#include <stdio.h>

#include "thermostat.h"

static CO_VIRTUAL_CLOCK* Clock;
static CO_VIRTUAL_PORT* Tool;

static void Print(void* clock, const CO_IF_FRM* frame, const char* sender) {
  printf("%4u ms  %-10s  %03X ", COVirtualClockNow(clock), sender, frame->Identifier);
  for (int n = 0; n < frame->DLC; ++n) {
    printf(" %02X", frame->Data[n]);
  }
  puts("");
}

static void Run(int milliseconds) {
  for (int ms = 0; ms < milliseconds; ++ms, COVirtualClockAdvance(Clock, 1)) {
    ThermostatRun();
  }
}

int main(void) {
  CO_VIRTUAL_BUS* bus = COVirtualBusNew();
  Clock = COVirtualClockNew();
  Tool = COVirtualBusAttach(bus, "tool");
  COVirtualPortEnable(Tool, 250000);
  COVirtualBusTrace(bus, Print, Clock);

  ThermostatPowerOn(bus, Clock);
  Run(10);
  COVirtualPortSend(Tool, &(CO_IF_FRM){0x000, {0x01, 5}, 2});  // NMT: start node 5
  Run(10);
  ThermostatMeasure(185);  // 18.5 degrees: below the setpoint
  Run(10);
  COVirtualPortSend(Tool, &(CO_IF_FRM){0x205, {0xB4, 0x00}, 2});  // RPDO: setpoint 18.0 degrees
  Run(10);
  COVirtualPortSend(Tool, &(CO_IF_FRM){0x605, {0x23, 0x10, 0x10, 0x01, 's', 'a', 'v', 'e'}, 8});  // SDO: 1010h:1
  Run(10);

  puts("power off and on");
  ThermostatPowerOn(bus, Clock);
  Run(10);
  printf("setpoint: %d.%d degrees\n", ThermostatSetpoint() / 10, ThermostatSetpoint() % 10);
  COVirtualBusFree(bus);
  return 0;
}
