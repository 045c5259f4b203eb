// SPDX-License-Identifier: Apache-2.0
#include "heater.h"

#include <stdio.h>
#include <string.h>

#include "heater_od.h"

static CO_NODE Node;
static CO_TMR_MEM Timer;
CO_SDO_BUFFER(SdoBuffer);
static bool SensorBroken;

// 2002h: the application defines the bytes of a DOMAIN.
static int16_t Log[3];  // latest temperatures, the newest first
CO_OBJ_DOM heater_2002_0 = {0, sizeof(Log), (uint8_t*)Log};

enum { SENSOR_BROKEN, ERROR_NUM };

static CO_EMCY_TBL Errors[ERROR_NUM] = {
    {CO_EMCY_REG_TEMP, CO_EMCY_CODE_TEMP_DEVICE_ERR},  // SENSOR_BROKEN
};

static void SetTemperature(int16_t temperature) {
  memmove(&Log[1], &Log[0], sizeof(Log) - sizeof(Log[0]));
  Log[0] = temperature;
  (void)CODictWrWord(&Node.Dict, HEATER_TEMPERATURE, (uint16_t)temperature);  // sends the TPDO
}

static void CheckSensor(void) {
  if (SensorBroken) {
    COEmcySet(&Node.Emcy, SENSOR_BROKEN, NULL);
  } else {
    COEmcyClr(&Node.Emcy, SENSOR_BROKEN);
  }
}

// Moves the temperature towards the setpoint, by 0.1 degrees each 100 ms.
static void Heat(void* unused) {
  const int16_t temperature = heater_ram.temperature;
  const int16_t setpoint = heater_persist_app.setpoint;
  (void)unused;
  CheckSensor();
  if (temperature != setpoint) {
    SetTemperature((int16_t)(temperature + (temperature < setpoint ? 1 : -1)));
  }
}

bool HeaterStart(CO_NODE_EXT* drivers, uint8_t nodeId) {
  CO_NODE_SPEC spec = {.NodeId = nodeId, .Baudrate = 250000, .TmrFreq = HEATER_TICKS};
  char text[CO_NODE_ERR_TEXT];
  spec.Dict = (CO_OBJ*)heater_od;
  spec.DictLen = HEATER_OD_NUM;
  spec.EmcyCode = Errors;
  spec.TmrMem = &Timer;
  spec.TmrNum = 1;
  spec.SdoBuf = SdoBuffer;
  drivers->Size = sizeof(*drivers);
  drivers->EmcyNum = ERROR_NUM;
  drivers->SdoBufLen = SdoBufferLen;
  CONodeInitEx(&Node, &spec, drivers);
  CONodeStart(&Node);
  (void)COTmrCreate(&Node.Tmr, 0, HEATER_TICKS / 10, Heat, NULL);
  if (CONodeGetErrText(&Node, text, sizeof(text)) != CO_ERR_NONE) {
    fprintf(stderr, "heater: %s\n", text);
    return false;
  }
  return true;
}

void HeaterStop(void) {
  CONodeStop(&Node);
  heater_persist_app.setpoint = 0;
}

uint32_t HeaterRun(void) {
  CONodeProcess(&Node);
  (void)COTmrService(&Node.Tmr);
  COTmrProcess(&Node.Tmr);
  return CONodeNextDeadline(&Node);
}

void HeaterBreakSensor(bool broken) { SensorBroken = broken; }
