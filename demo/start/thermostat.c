// SPDX-License-Identifier: Apache-2.0
#include "thermostat.h"

#include "co_core.h"
#include "co_nvm_ram.h"

// Variables of the object dictionary
static uint8_t ErrorRegister;
static uint16_t HeartbeatTime;
static uint16_t EventTime;   // of the TPDO, ms; 0: sent only when a value changes
static int16_t Temperature;  // 0.1 degrees Celsius
static uint8_t Heating;      // 1: on
static int16_t Setpoint;     // 0.1 degrees Celsius
static char Name[] = "thermostat";
static CO_OBJ_STR NameObject = {0, (uint8_t*)Name};

// 1010h:1 stores the setpoint
static const int16_t SetpointDefault = 200;
static const CO_PARA Settings = {
    0, sizeof(Setpoint), (uint8_t*)&Setpoint, (uint8_t*)&SetpointDefault, CO_RESET_NODE, NULL, CO_PARA___E, 0, 0};

static const CO_OBJ Dictionary[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)(&NameObject)},
    {CO_KEY(0x1010, 0, CO_OBJ_D___R_), CO_TPARA_STORE, (CO_DATA)(1)},
    {CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Settings)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    // RPDO 1, received at 200h + node-ID: the setpoint
    {CO_KEY(0x1400, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(2)},
    {CO_KEY(0x1400, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_RPDO_DEFAULT(0))},
    {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(1)},
    {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2002, 0, 16))},
    // TPDO 1, sent at 180h + node-ID: temperature and heating
    {CO_KEY(0x1800, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(5)},
    {CO_KEY(0x1800, 1, CO_OBJ_DN__R_), CO_TPDO_ID, (CO_DATA)(CO_COBID_TPDO_DEFAULT(0))},
    {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)(254)},
    {CO_KEY(0x1800, 5, CO_OBJ_____RW), CO_TPDO_EVENT, (CO_DATA)(&EventTime)},
    {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)(2)},
    {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2000, 0, 16))},
    {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)(CO_LINK(0x2001, 0, 8))},
    // The application. P: can be mapped; A: a new value sends the TPDO.
    {CO_KEY(0x2000, 0, CO_OBJ___APR_), CO_TSIGNED16, (CO_DATA)(&Temperature)},
    {CO_KEY(0x2001, 0, CO_OBJ___APR_), CO_TUNSIGNED8, (CO_DATA)(&Heating)},
    {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TSIGNED16, (CO_DATA)(&Setpoint)},
    CO_OBJ_DICT_ENDMARK,
};

static CO_NODE Node;
CO_SDO_BUFFER(SdoBuffer);
static uint8_t MemoryBytes[128];
static CO_NVM_RAM Memory = {MemoryBytes, sizeof(MemoryBytes)};
static CO_NODE_EXT Drivers;

void ThermostatPowerOn(CO_VIRTUAL_BUS* bus, CO_VIRTUAL_CLOCK* clock) {
  static CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 250000, .TmrFreq = 1000, .SdoBuf = SdoBuffer};
  spec.Dict = (CO_OBJ*)Dictionary;
  spec.DictLen = sizeof(Dictionary) / sizeof(Dictionary[0]);
  if (Drivers.Size == 0) {
    Drivers.Size = sizeof(Drivers);
    Drivers.Can = &COVirtualBusDriver;
    Drivers.CanCtx = COVirtualBusAttach(bus, "thermostat");
    Drivers.Timer = &COVirtualTimerDriver;
    Drivers.TimerCtx = COVirtualTimerNew(clock);
    Drivers.Nvm = &RamNvmDriver;
    Drivers.NvmCtx = &Memory;
    Drivers.SdoBufLen = SdoBufferLen;
    CONvmRamClear(&Memory);
  } else {  // a power cycle: the RAM loses its contents, the memory does not
    CONodeStop(&Node);
    Setpoint = 0;
  }
  CONodeInitEx(&Node, &spec, &Drivers);
  CONodeStart(&Node);
}

void ThermostatRun(void) {
  CONodeProcess(&Node);
  (void)COTmrService(&Node.Tmr);
  COTmrProcess(&Node.Tmr);
  (void)CODictWrByte(&Node.Dict, CO_DEV(0x2001, 0), Temperature < Setpoint ? 1 : 0);
}

void ThermostatMeasure(int16_t temperature) {
  (void)CODictWrWord(&Node.Dict, CO_DEV(0x2000, 0), (uint16_t)temperature);
}

int16_t ThermostatSetpoint(void) { return Setpoint; }
