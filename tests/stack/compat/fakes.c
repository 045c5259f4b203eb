// SPDX-License-Identifier: Apache-2.0
#include "fakes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unity.h"

FAKES Fakes;

static CO_IF_FRM Pending;
static int IsPending;
static CO_IF_FRM Sent[32];
static unsigned SentNum;
static unsigned SentTaken;

static uint32_t TicksLeft; /* ticks of either timer; 0: stopped or elapsed */
static int Compare;        /* 1: the timer interrupts only when its time has elapsed */
static uint8_t NvmMemory[64];

void FakesReset(void) {
  memset(&Fakes, 0, sizeof(Fakes));
  IsPending = 0;
  SentNum = 0;
  SentTaken = 0;
  TicksLeft = 0;
  Compare = 0;
  memset(NvmMemory, 0xFF, sizeof(NvmMemory));
}

static void CanInit(void) { Fakes.CanInits++; }
static void CanReset(void) { Fakes.CanResets++; }
static void CanClose(void) { Fakes.CanCloses++; }

static void CanEnable(uint32_t baud) {
  Fakes.CanEnables++;
  Fakes.Baudrate = baud;
}

static int16_t CanRead(CO_IF_FRM* frm) {
  if (Fakes.CanBroken) {
    return -1;
  }
  if (!IsPending) {
    return 0;
  }
  IsPending = 0;
  *frm = Pending;
  return (int16_t)sizeof(CO_IF_FRM);
}

static int16_t CanSend(CO_IF_FRM* frm) {
  if (Fakes.CanBroken) {
    return -1;
  }
  if (SentTaken == SentNum) {
    SentTaken = 0;
    SentNum = 0;
  }
  if (SentNum == sizeof(Sent) / sizeof(Sent[0])) {
    return 0;
  }
  Sent[SentNum++] = *frm;
  return (int16_t)sizeof(CO_IF_FRM);
}

static void CyclicInit(uint32_t freq) { Fakes.TimerFreq = freq; }
static void TimerReload(uint32_t ticks) { TicksLeft = ticks; }
static uint32_t TimerDelay(void) { return TicksLeft; }
static void TimerStop(void) { TicksLeft = 0; }
static void TimerStart(void) {}

static uint8_t CyclicUpdate(void) {
  if (TicksLeft == 0) {
    return 0;
  }
  TicksLeft--;
  return TicksLeft == 0 ? 1 : 0;
}

static void DeltaInit(uint32_t freq) {
  Fakes.TimerFreq = freq;
  Compare = 1;
}

static uint8_t DeltaUpdate(void) { return 1; }

static void NvmInit(void) { Fakes.NvmInits++; }

static uint32_t NvmRead(uint32_t start, uint8_t* buffer, uint32_t size) {
  memcpy(buffer, &NvmMemory[start], size);
  return size;
}

static uint32_t NvmWrite(uint32_t start, uint8_t* buffer, uint32_t size) {
  memcpy(&NvmMemory[start], buffer, size);
  return size;
}

const CO_IF_CAN_DRV FakeCanDriver = {CanInit, CanEnable, CanRead, CanSend, CanReset, CanClose};
const CO_IF_TIMER_DRV FakeCyclicTimerDriver = {CyclicInit, TimerReload, TimerDelay,
                                               TimerStop,  TimerStart,  CyclicUpdate};
const CO_IF_TIMER_DRV FakeDeltaTimerDriver = {DeltaInit, TimerReload, TimerDelay, TimerStop, TimerStart, DeltaUpdate};
const CO_IF_NVM_DRV FakeNvmDriver = {NvmInit, NvmRead, NvmWrite};

static uint8_t HexByte(const char* text) {
  char digits[3];
  memcpy(digits, text, 2);
  digits[2] = 0;
  return (uint8_t)strtoul(digits, NULL, 16);
}

void BusReceive(CO_NODE* node, const char* frame) {
  const char* data = strchr(frame, '#') + 1;
  memset(&Pending, 0, sizeof(Pending));
  Pending.Identifier = (uint32_t)strtoul(frame, NULL, 16);
  Pending.DLC = (uint8_t)(strlen(data) / 2);
  for (uint8_t i = 0; i < Pending.DLC; i++) {
    Pending.Data[i] = HexByte(&data[2 * i]);
  }
  IsPending = 1;
  CONodeProcess(node);
}

const char* BusSent(void) {
  static char text[32];
  text[0] = 0;
  if (SentTaken == SentNum) {
    return text;
  }
  const CO_IF_FRM* frm = &Sent[SentTaken++];
  int at = snprintf(text, sizeof(text), "%03X#", (unsigned)frm->Identifier);
  for (uint8_t i = 0; i < frm->DLC; i++) {
    at += snprintf(&text[at], sizeof(text) - (size_t)at, "%02X", (unsigned)frm->Data[i]);
  }
  return text;
}

static void TimerInterrupt(CO_NODE* node) {
  if (!Compare) {
    COTmrService(&node->Tmr);
    return;
  }
  if (TicksLeft > 0 && --TicksLeft == 0) {
    COTmrService(&node->Tmr);
  }
}

void TimePasses(CO_NODE* node, uint32_t ticks) {
  for (uint32_t i = 0; i < ticks; i++) {
    TimerInterrupt(node);
    COTmrProcess(&node->Tmr);
    CONodeProcess(node);
  }
}

void NodeUp(CO_NODE* node, const CO_OBJ* dict, uint16_t len) { NodeUpEx(node, dict, len, NULL); }

void NodeUpEx(CO_NODE* node, const CO_OBJ* dict, uint16_t len, const CO_NODE_EXT* ext) {
  static CO_IF_DRV drivers;
  static uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
  CO_NODE_SPEC spec = {1, 250000, (CO_OBJ*)dict, len, NULL, NULL, 0, 1000, &drivers, sdo_buffer};
  drivers.Can = &FakeCanDriver;
  drivers.Timer = &FakeCyclicTimerDriver;
  drivers.Nvm = &FakeNvmDriver;
  FakesReset();
  if (ext == NULL) {
    CONodeInit(node, &spec);
  } else {
    CONodeInitEx(node, &spec, ext);
  }
  TEST_ASSERT_EQUAL_HEX32(CO_ERR_NONE, CONodeGetErr(node));
  CONodeStart(node);
  TEST_ASSERT_SENT("701#00");
}
