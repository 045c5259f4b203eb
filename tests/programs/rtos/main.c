// SPDX-License-Identifier: Apache-2.0
// Runs a device and a master, each in a task, with interrupts; other tasks of the master read and write the device's
// objects. Prints "1..N" and N lines "ok …" or "not ok …".
#include <stdio.h>
#include <string.h>

#include "sdo_request.h"
#include "wire.h"

#define LARGE 5000u

static NODE_TASK Device;
static NODE_TASK Master;
static CONTROLLER DeviceCan = {.Node = &Device};
static CONTROLLER MasterCan = {.Node = &Master};

static uint8_t Errors[2];
static uint32_t Value = 7;
static uint16_t Heartbeat = 5;
static CO_HBCONS Watch = {.Time = 1000, .NodeId = 2};
static uint32_t Pair[2] = {0, 0xFFFFFFFF};
static uint8_t Large[LARGE];
static CO_OBJ_DOM Domain = {0, LARGE, Large};
static CO_OBJ_STR Name = {0, (const uint8_t*)"a device that lives in a task"};
static uint8_t DeviceBuffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
static CO_TMR_MEM Timers[2];

static CO_OBJ DeviceObjects[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x12345678},
                                 {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)&Errors[0]},
                                 {CO_KEY(0x1008, 0, CO_OBJ_____R_), CO_TSTRING, (CO_DATA)&Name},
                                 {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)&Heartbeat},
                                 {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)1},
                                 {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)&Value},
                                 {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)&Domain},
                                 {CO_KEY(0x2002, 1, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)&Pair[0]},
                                 {CO_KEY(0x2002, 2, CO_OBJ_____R_), CO_TUNSIGNED32, (CO_DATA)&Pair[1]},
                                 CO_OBJ_DICT_ENDMARK};

static CO_OBJ MasterObjects[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                                 {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)&Errors[1]},
                                 {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)&Watch},
                                 {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)1},
                                 {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x602},
                                 {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0x582},
                                 {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)2},
                                 CO_OBJ_DICT_ENDMARK};

static unsigned Cases;
static unsigned Failed;

static void Say(bool good, const char* text) {
  ++Cases;
  Failed += good ? 0 : 1;
  printf("%sok %s\n", good ? "" : "not ", text);
}

static CO_ERR Begin(NODE_TASK* node, CONTROLLER* can, uint8_t id, CO_OBJ* objects, size_t num, uint8_t* buffer) {
  CO_NODE_SPEC spec = {id, 250000, objects, (uint16_t)num, NULL, NULL, 0, 0, NULL, buffer};
  spec.TmrMem = id == 2 ? Timers : NULL;
  spec.TmrNum = id == 2 ? 2 : 0;
  node->Can = &WireDriver;
  node->CanCtx = can;
  return NodeTaskStart(node, &spec);
}

// Waits minutes for an event, so that the verdict does not depend on the speed of the machine.
static bool Comes(bool (*happened)(void)) {
  for (unsigned ms = 0; ms < 600000; ++ms) {
    if (happened()) {
      return true;
    }
    vTaskDelay(1);
  }
  return false;
}

static bool MasterHearsHeartbeats(void) {
  NodeTaskLock(&Master);
  const bool hears = CONmtLastHbState(&Master.Node.Nmt, 2) == CO_PREOP;
  NodeTaskUnlock(&Master);
  return hears;
}

static unsigned Elapsed;
static void Count(void* parameter) { ++*(unsigned*)parameter; }

static bool TimerElapsed(void) {
  NodeTaskLock(&Device);
  const bool elapsed = Elapsed == 1;
  NodeTaskUnlock(&Device);
  return elapsed;
}

static void TestSdo(SDO_REQUEST* sdo) {
  static uint8_t buffer[LARGE];
  static uint8_t sent[LARGE];
  uint32_t num = 0;
  const uint8_t value[4] = {1, 2, 3, 4};
  const bool type = SdoRead(sdo, CO_DEV(0x1000, 0), buffer, 4, &num) == 0;
  Say(type && num == 4 && memcmp(buffer, "\x78\x56\x34\x12", 4) == 0, "1000h is read by another task");
  const bool name = SdoRead(sdo, CO_DEV(0x1008, 0), buffer, sizeof(buffer), &num) == 0;
  Say(name && num == 29 && memcmp(buffer, "a device that lives in a task", 29) == 0, "a string is read");
  const bool written = SdoWrite(sdo, CO_DEV(0x2000, 0), value, 4) == 0;
  Say(written && SdoRead(sdo, CO_DEV(0x2000, 0), buffer, 4, &num) == 0 && memcmp(buffer, value, 4) == 0,
      "2000h is written and read back");
  Say(SdoRead(sdo, CO_DEV(0x3000, 0), buffer, 4, &num) == CO_SDO_ERR_OBJ, "a missing object is an abort 0602 0000h");
  for (unsigned n = 0; n < LARGE; ++n) {
    sent[n] = (uint8_t)(n * 7 + n / 256);
  }
  Say(SdoWrite(sdo, CO_DEV(0x2001, 0), sent, LARGE) == 0, "5000 bytes are written by a block transfer");
  const bool read = SdoRead(sdo, CO_DEV(0x2001, 0), buffer, LARGE, &num) == 0;
  Say(read && num == LARGE && memcmp(buffer, sent, LARGE) == 0, "and are read back");
}

// Changes objects in another task of the device, while the network reads them.
static void ChangeObjects(void* parameter) {
  CO_UNUSED(parameter);
  for (uint32_t n = 1;; ++n) {
    NodeTaskLock(&Device);
    Pair[0] = n;
    Pair[1] = ~n;
    NodeTaskUnlock(&Device);
    vTaskDelay(1);
  }
}

static void TestTasks(SDO_REQUEST* sdo) {
  static StaticTask_t memory;
  uint8_t buffer[4];
  uint32_t num = 0;
  unsigned good = 0;
  (void)xTaskCreateStatic(ChangeObjects, "application", 0, NULL, 1, NULL, &memory);
  for (unsigned n = 0; n < 50; ++n) {
    good += SdoRead(sdo, CO_DEV(0x2002, (n & 1) + 1), buffer, 4, &num) == 0 && num == 4 ? 1 : 0;
  }
  Say(good == 50, "objects are read while a task changes them");
}

// Checks that the node's task is notified of a timer that another task has started: without it, the task would sleep
// for ever.
static void TestTimer(SDO_REQUEST* sdo) {
  const uint8_t off[2] = {0, 0};
  const bool silent = SdoWrite(sdo, CO_DEV(0x1017, 0), off, 2) == 0;
  NodeTaskLock(&Device);
  const int16_t id = COTmrCreate(&Device.Node.Tmr, 3, 0, Count, &Elapsed);
  NodeTaskUnlock(&Device);
  Say(silent && id >= 0 && Comes(TimerElapsed), "a timer that another task has started elapses");
}

static void TestCounters(void) {
  NodeTaskLock(&Master);
  const CO_NODE_COUNTERS master = CONodeGetCounters(&Master.Node);
  NodeTaskUnlock(&Master);
  NodeTaskLock(&Device);
  const CO_NODE_COUNTERS device = CONodeGetCounters(&Device.Node);
  NodeTaskUnlock(&Device);
  const bool lost = master.CanEvents[CO_CAN_OVERRUN] != 0 || device.CanEvents[CO_CAN_OVERRUN] != 0;
  Say(!lost && master.Dropped == 0 && device.Dropped == 0 && master.Received > 700, "no frame was lost");
}

int main(void) {
  SDO_REQUEST sdo = {&Master, 0};
  WireConnect(&DeviceCan, &MasterCan);
  const CO_ERR master =
      Begin(&Master, &MasterCan, 1, MasterObjects, sizeof(MasterObjects) / sizeof(MasterObjects[0]), NULL);
  const CO_ERR device =
      Begin(&Device, &DeviceCan, 2, DeviceObjects, sizeof(DeviceObjects) / sizeof(DeviceObjects[0]), DeviceBuffer);
  Say(master == CO_ERR_NONE && device == CO_ERR_NONE, "both nodes start");
  Say(Comes(MasterHearsHeartbeats), "heartbeats come by the tick of the RTOS");
  TestSdo(&sdo);
  TestTasks(&sdo);
  TestTimer(&sdo);
  TestCounters();
  printf("1..%u\n", Cases);
  return Failed == 0 ? 0 : 1;
}
