// SPDX-License-Identifier: Apache-2.0
#include "partner.h"

#include <string.h>

#include "bus.h"
#include "clock.h"
#include "device.h"
#include "error.h"

#define PARTNER_ID 1u
#define TIME_OUT 600000u  // ms, for each answer: minutes, because the test runs on busy machines

PARTNER_REPORT Partner;

static uint32_t Input[2] = {0, ~0u};
static uint32_t Output[2] = {0, ~0u};
static uint8_t Alarm;
static uint8_t ErrorRegister;

// The sub-indexes of 1028h are node-IDs, so the device has sub-index 5.
static CO_OBJ Objects[] = {{CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                           {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)&ErrorRegister},
                           {CO_KEY(0x1005, 0, CO_OBJ_D___R_), CO_TSYNC_ID, (CO_DATA)0x80},
                           {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)0},
                           {CO_KEY(0x1028, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)DEVICE_ID},
                           {CO_KEY(0x1028, DEVICE_ID, CO_OBJ_D___R_), CO_TEMCY_CONS, (CO_DATA)(0x80 + DEVICE_ID)},
                           {CO_KEY(0x1280, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x600 + DEVICE_ID)},
                           {CO_KEY(0x1280, 2, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x580 + DEVICE_ID)},
                           {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)DEVICE_ID},
                           {CO_KEY(0x1400, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x180 + DEVICE_ID)},
                           {CO_KEY(0x1400, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)255},
                           {CO_KEY(0x1401, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x280 + DEVICE_ID)},
                           {CO_KEY(0x1401, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)255},
                           {CO_KEY(0x1600, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)2},
                           {CO_KEY(0x1600, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20000120},
                           {CO_KEY(0x1600, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20000220},
                           {CO_KEY(0x1601, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)1},
                           {CO_KEY(0x1601, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20020008},
                           {CO_KEY(0x1800, 1, CO_OBJ_D___R_), CO_TPDO_ID, (CO_DATA)(0x40000200 + DEVICE_ID)},
                           {CO_KEY(0x1800, 2, CO_OBJ_D___R_), CO_TPDO_TYPE, (CO_DATA)1},
                           {CO_KEY(0x1A00, 0, CO_OBJ_D___R_), CO_TPDO_NUM, (CO_DATA)2},
                           {CO_KEY(0x1A00, 1, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20010120},
                           {CO_KEY(0x1A00, 2, CO_OBJ_D___R_), CO_TPDO_MAP, (CO_DATA)0x20010220},
                           {CO_KEY(0x2000, 1, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)&Input[0]},
                           {CO_KEY(0x2000, 2, CO_OBJ____PRW), CO_TUNSIGNED32, (CO_DATA)&Input[1]},
                           {CO_KEY(0x2001, 1, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)&Output[0]},
                           {CO_KEY(0x2001, 2, CO_OBJ____PR_), CO_TUNSIGNED32, (CO_DATA)&Output[1]},
                           {CO_KEY(0x2002, 0, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)&Alarm},
                           CO_OBJ_DICT_ENDMARK};
#define OBJECTS (sizeof(Objects) / sizeof(Objects[0]))

static CO_NODE Node;
static CO_NODE_EXT Ext;
static bool TransferEnded;
static uint32_t AbortCode;

CO_ERR PartnerStart(void* controller) {
  CO_NODE_SPEC spec = {PARTNER_ID, 1000000, Objects, OBJECTS, NULL, NULL, 0, TICKS_PER_SECOND, NULL, NULL};
  Ext.Size = sizeof(Ext);
  Ext.Can = &BusDriver;
  Ext.CanCtx = controller;
  Ext.Timer = &ClockDriver;
  CONodeInitEx(&Node, &spec, &Ext);
  const CO_ERR err = PrintError(&Node, "the partner");
  CONodeStart(&Node);
  return err;
}

void PartnerStop(void) { CONodeStop(&Node); }

void PartnerProcess(void) {
  for (unsigned frames = 0; frames < 256; ++frames) {
    CONodeProcess(&Node);
  }
  (void)COTmrService(&Node.Tmr);
  COTmrProcess(&Node.Tmr);
  ClockWait(200);
}

void PartnerStartNetwork(void) { (void)CONmtCommand(&Node.Nmt, CO_NMT_COMMAND_START, 0); }

static void NoteEnd(CO_CSDO* client, uint16_t index, uint8_t sub, uint32_t code) {
  CO_UNUSED(client);
  CO_UNUSED(index);
  CO_UNUSED(sub);
  TransferEnded = true;
  AbortCode = code;
}

static bool AwaitTransfer(CO_ERR started) {
  while (started == CO_ERR_NONE && !TransferEnded) {
    PartnerProcess();
  }
  return started == CO_ERR_NONE && AbortCode == 0;
}

bool PartnerWrite(uint32_t key, const void* data, uint32_t size) {
  TransferEnded = false;
  return AwaitTransfer(COCSdoRequestDownload(COCSdoFind(&Node, 0), key, (uint8_t*)data, size, NoteEnd, TIME_OUT));
}

bool PartnerVerify(uint32_t key, const void* data, uint32_t size) {
  static uint8_t buffer[1024];
  CO_CSDO* const client = COCSdoFind(&Node, 0);
  TransferEnded = false;
  return AwaitTransfer(COCSdoRequestUpload(client, key, buffer, sizeof(buffer), NoteEnd, TIME_OUT)) &&
         COCSdoGetNum(client) == size && memcmp(buffer, data, size) == 0;
}

void PartnerProcessPdo(const CO_RPDO* pdo) {
  if (pdo == &Node.RPdo[1]) {
    ++Partner.Events;
    return;
  }
  ++Partner.Pdos;
  Partner.MismatchedPairs += Input[1] == ~Input[0] ? 0 : 1;
  Partner.Answers += Input[0] == Output[0] + 1u ? 1 : 0;
  Output[0] = Input[0] * 3u;
  Output[1] = ~Output[0];
}

void PartnerCountError(uint8_t node_id) { Partner.Errors += node_id == DEVICE_ID ? 1 : 0; }
