// SPDX-License-Identifier: Apache-2.0
// The driver of SJA1000 on a PCI card whose registers are I/O ports, in the file REGISTERS of sysfs. Polled, as Linux
// gives the interrupt of a card to drivers of its kernel only.
//
//     sja1000_card REGISTERS NODE-ID      a node
//     sja1000_card REGISTERS INTERFACE    the driver check, with a SocketCAN interface on the same bus as peer
#define _DEFAULT_SOURCE  // pread, usleep
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "co_can_sja1000.h"
#include "co_can_socketcan.h"
#include "co_driver_check.h"
#include "co_timer_linux.h"

enum { CHECKS = 16, TURN = 1000 /* us */, FIFO = 5 /* frames with 8 bytes */ };

static uint8_t ReadPort(void* file, uint8_t address) {
  uint8_t value = 0;
  if (pread(*(int*)file, &value, 1, address) != 1) {
    perror("read");
    exit(1);
  }
  return value;
}

static void WritePort(void* file, uint8_t address, uint8_t value) {
  if (pwrite(*(int*)file, &value, 1, address) != 1) {
    perror("write");
    exit(1);
  }
}

static int Card;
static const CO_SJA1000_ACCESS Ports = {ReadPort, WritePort};
static const CO_CAN_SJA1000_RATE Rates[] = {CO_CAN_SJA1000_RATE_OF(16000000, 500000, 16)};
static CO_IF_FRM Frames[64];
static CO_CAN_SJA1000 Can = {
    .Access = &Ports, .AccessCtx = &Card, .Rates = Rates, .RateNum = 1, .Frames = Frames, .FrameNum = 64};
static CO_NODE_EXT Drivers = {.Size = sizeof(Drivers), .Can = &Sja1000CanDriver, .CanCtx = &Can};

static uint8_t ErrorRegister;
static uint16_t HeartbeatTime = 1000;  // ms
static CO_HBCONS Watched;
static uint8_t Text[200];
static CO_OBJ_DOM TextDomain = {0, sizeof(Text), Text};
static uint32_t Lost;
static CO_OBJ Od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&ErrorRegister)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1016, 0, CO_OBJ_D___R_), CO_THB_CONS, (CO_DATA)(1)},
    {CO_KEY(0x1016, 1, CO_OBJ_____RW), CO_THB_CONS, (CO_DATA)(&Watched)},
    {CO_KEY(0x1017, 0, CO_OBJ_____RW), CO_THB_PROD, (CO_DATA)(&HeartbeatTime)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0x12345678)},
    {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&TextDomain)},
    {CO_KEY(0x2001, 0, CO_OBJ_____R_), CO_VAR(UNSIGNED32, Lost)},
    CO_OBJ_DICT_ENDMARK,
};

static void Print(void* unused, const char* line) {
  (void)unused;
  puts(line);
}

static void Idle(void* unused) {
  (void)unused;
  usleep(TURN);
  COCanSja1000Interrupt(&Can);
}

static int Check(const char* interface) {
  CO_SOCKETCAN* peer = COSocketCanNew();
  CO_NODE_EXT other = {.Can = &COSocketCanDriver, .CanCtx = peer};
  CO_DRIVER_CHECK check = {.Ext = &Drivers, .Print = Print, .Idle = Idle, .Bus = CO_CHECK_PEER, .Peer = &other};
  check.Baudrate = Rates[0].Baud;
  check.Frames = CO_CHECK_29_BIT | CO_CHECK_REMOTE;
  check.Burst = FIFO;
  check.Patience = 10000;
  check.Quiet = 500;
  if (!COSocketCanOpen(peer, interface)) {
    puts(COSocketCanError(peer));
    return 1;
  }
  CODriverCheckCan(&check);
  return check.Failed == 0 && check.Passed == CHECKS ? 0 : 1;
}

static int Run(uint8_t nodeId) {
  static CO_NODE node;
  CO_SDO_BUFFER(buffer);
  CO_NODE_SPEC spec = {.NodeId = nodeId, .Baudrate = Rates[0].Baud, .Dict = Od, .DictLen = sizeof(Od) / sizeof(*Od)};
  char text[CO_NODE_ERR_TEXT];
  spec.TmrFreq = 1000000;
  spec.SdoBuf = buffer;
  Drivers.Timer = &COLinuxTimerDriver;
  Drivers.TimerCtx = COLinuxTimerNew();
  Drivers.SdoBufLen = bufferLen;
  CONodeInitEx(&node, &spec, &Drivers);
  CONodeStart(&node);
  if (CONodeGetErrText(&node, text, sizeof(text)) != CO_ERR_NONE) {
    puts(text);
    return 1;
  }
  for (;;) {
    COCanSja1000Interrupt(&Can);
    CONodeProcess(&node);
    (void)COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
    Lost = COCanSja1000Lost(&Can);
    usleep(TURN);
  }
}

int main(int count, char** arguments) {
  Card = count == 3 ? open(arguments[1], O_RDWR) : -1;
  if (Card < 0) {
    fprintf(stderr, "usage: sja1000_card REGISTERS NODE-ID|INTERFACE\n");
    return 2;
  }
  const int nodeId = atoi(arguments[2]);
  return nodeId != 0 ? Run((uint8_t)nodeId) : Check(arguments[2]);
}
