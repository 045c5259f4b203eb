// SPDX-License-Identifier: Apache-2.0
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "co_can_virtual.h"
#include "co_nvm_ram.h"
#include "co_virtual_clock.h"
#include "unity.h"

CO_NODE Node;
CO_NODE_SPEC Spec;
CO_NODE_EXT Ext;

static CO_VIRTUAL_BUS* Bus;
static CO_VIRTUAL_PORT* Master;
static CO_VIRTUAL_CLOCK* Clock;
static CO_VIRTUAL_TIMER* Timer;
CO_SDO_BUFFER(SdoBuffer);
static uint8_t MemoryBytes[1024];
static CO_NVM_RAM Memory = {MemoryBytes, sizeof(MemoryBytes)};
static char Sent[1024];    // frames since the last call
static char Result[1024];  // result of the last call

static void Append(const char* text) {
  const size_t length = strlen(Sent);
  (void)snprintf(&Sent[length], sizeof(Sent) - length, "%s", text);
}

// Records the frames of the node.
static void Note(void* user, const CO_IF_FRM* frame, const char* sender) {
  char text[16];
  (void)user;
  if (strcmp(sender, "node") != 0) {
    return;
  }
  (void)snprintf(text, sizeof(text), "%s%03X:", Sent[0] != '\0' ? " | " : "", (unsigned)frame->Identifier);
  Append(text);
  for (unsigned n = 0; n < frame->DLC; ++n) {
    (void)snprintf(text, sizeof(text), " %02X", frame->Data[n]);
    Append(text);
  }
}

void setUp(void) {
  Bus = COVirtualBusNew();
  Clock = COVirtualClockNew();
  Timer = COVirtualTimerNew(Clock);
  Master = COVirtualBusAttach(Bus, "master");
  COVirtualPortEnable(Master, 250000);
  COVirtualBusTrace(Bus, Note, NULL);
  CONvmRamClear(&Memory);
  memset(&Node, 0, sizeof(Node));
  memset(&Spec, 0, sizeof(Spec));
  Spec.NodeId = 5;
  Spec.Baudrate = 250000;
  Spec.TmrFreq = 1000;
  Spec.SdoBuf = SdoBuffer;
  memset(&Ext, 0, sizeof(Ext));
  Ext.Size = sizeof(Ext);
  Ext.SdoBufLen = SdoBufferLen;
  Ext.Can = &COVirtualBusDriver;
  Ext.CanCtx = COVirtualBusAttach(Bus, "node");
  Ext.Timer = &COVirtualTimerDriver;
  Ext.TimerCtx = Timer;
  Ext.Nvm = &RamNvmDriver;
  Ext.NvmCtx = &Memory;
}

void tearDown(void) {
  CONodeStop(&Node);
  COVirtualTimerFree(Timer);
  COVirtualClockFree(Clock);
  COVirtualBusFree(Bus);
}

static void Run(unsigned ms) {
  for (; ms > 0; --ms) {
    COVirtualClockAdvance(Clock, 1);
    (void)COTmrService(&Node.Tmr);
    COTmrProcess(&Node.Tmr);
    CONodeProcess(&Node);
  }
}

static const char* TakeSent(void) {
  memcpy(Result, Sent, sizeof(Result));
  Sent[0] = '\0';
  return Result;
}

const char* BenchRun(unsigned ms) {
  Run(ms);
  return TakeSent();
}

CO_ERR BenchStart(const CO_OBJ* dictionary, uint16_t num) {
  if (Node.Ext != NULL) {
    CONodeStop(&Node);
  }
  Spec.Dict = (CO_OBJ*)dictionary;
  Spec.DictLen = num;
  CONodeInitEx(&Node, &Spec, &Ext);
  CONodeStart(&Node);
  (void)BenchRun(1);
  return CONodeGetErr(&Node);
}

const char* BenchSend(const char* text) {
  CO_IF_FRM frame = {0, {0}, 0};
  char* at;
  frame.Identifier = (uint32_t)strtoul(text, &at, 16);
  TEST_ASSERT_EQUAL_CHAR(':', *at);
  ++at;
  if (strcmp(at, " R") == 0) {
    frame.Identifier |= CO_IF_FRM_RTR;
  } else {
    while (*at != '\0' && frame.DLC < 8) {
      frame.Data[frame.DLC++] = (uint8_t)strtoul(at, &at, 16);
    }
  }
  TEST_ASSERT_EQUAL_INT((int)sizeof(CO_IF_FRM), COVirtualPortSend(Master, &frame));
  return BenchRun(1);
}
