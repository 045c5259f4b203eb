// SPDX-License-Identifier: Apache-2.0
#include <stdio.h>

#include "co_core.h"
#include "thermostat.h"

// The dictionary of the master: an SDO client for node 5, and an RPDO for its TPDO.
static uint8_t ErrorRegister;
static int16_t Temperature;
static uint8_t Heating;
static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1280, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(3)},
    {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x605)},
    {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TSDO_ID, (CO_DATA)(0x585)},
    {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x185)},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 16))},
    {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    {CO_KEY(0x2000, 0, CO_OBJ____PRW), CO_TSIGNED16, (CO_DATA)(&Temperature)},
    {CO_KEY(0x2001, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Heating)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;
static char Name[32];
static uint8_t EventTime[2] = {0xF4, 0x01};  // 500 ms, low byte first as on the bus

// The steps: each SDO transfer ends with its callback, which begins the next step.

static void EventTimeWritten(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t abort_code) {
  if (abort_code != 0) {
    printf("%04Xh:%02X: abort code %08Xh\n", index, sub, abort_code);
    return;
  }
  (void)CONmtCommand(&client->Node->Nmt, CO_NMT_COMMAND_START, 0);  // 0: all nodes, this one, too
}

static void NameRead(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t abort_code) {
  if (abort_code != 0) {
    printf("%04Xh:%02X: abort code %08Xh\n", index, sub, abort_code);
    return;
  }
  Name[COCSdoGetNum(client)] = '\0';
  printf("node 5 is a %s\n", Name);
  (void)COCSdoRequestDownload(client, CO_DEV(0x1800, 5), EventTime, sizeof(EventTime), EventTimeWritten, 1000);
}

int main(void) {
  CO_VIRTUAL_BUS* bus = COVirtualBusNew();
  CO_VIRTUAL_CLOCK* clock = COVirtualClockNew();
  CO_NODE_SPEC spec = {.NodeId = 1, .Baudrate = 250000, .TmrFreq = 1000};
  CO_NODE_EXT drivers = {.Size = sizeof(drivers), .Can = &COVirtualBusDriver, .Timer = &COVirtualTimerDriver};
  spec.Dict = (CO_OBJ*)Dictionary;
  spec.DictLen = sizeof(Dictionary) / sizeof(Dictionary[0]);
  drivers.CanCtx = COVirtualBusAttach(bus, "master");
  drivers.TimerCtx = COVirtualTimerNew(clock);
  CONodeInitEx(&Node, &spec, &drivers);
  CONodeStart(&Node);
  ThermostatPowerOn(bus, clock);

  (void)COCSdoRequestUpload(COCSdoFind(&Node, 0), CO_DEV(0x1008, 0), (uint8_t*)Name, sizeof(Name) - 1, NameRead, 1000);
  int16_t temperature = 0;
  uint8_t heating = 0;
  for (int ms = 0; ms < 2000; ++ms, COVirtualClockAdvance(clock, 1)) {
    ThermostatRun();
    CONodeProcess(&Node);
    (void)COTmrService(&Node.Tmr);
    COTmrProcess(&Node.Tmr);
    if (ms % 400 == 0) {
      ThermostatMeasure((int16_t)(180 + ms / 40));
    }
    if (temperature != Temperature || heating != Heating) {
      temperature = Temperature;
      heating = Heating;
      printf("%4d ms: %d.%d degrees, heating %s\n", ms, temperature / 10, temperature % 10,
             Heating != 0 ? "on" : "off");
    }
  }
  COVirtualBusFree(bus);
  return 0;
}
