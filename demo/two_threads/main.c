// SPDX-License-Identifier: Apache-2.0
// Two nodes on a virtual bus: a device with two threads, and a partner that gives it a fixed amount of work. Ends with
// 0 when all work is done without lost frames or inconsistent data, regardless of the time needed.
#include <stdio.h>

#include "bus.h"
#include "clock.h"
#include "device.h"
#include "partner.h"

#define ROUNDS 20u
#define PDOS 200u
#define ANSWERS 50u
#define TIME_LIMIT 600000000u  // time limit of each wait, µs: minutes, because the test runs on busy machines

static unsigned Failures;

static void Check(bool good, const char* what) {
  if (!good) {
    ++Failures;
    printf("FAILED: %s\n", what);
  }
}

// Callbacks of both nodes.
void COPdoUpdate(CO_RPDO* pdo) {
  if (IsDevice(pdo->Node)) {
    DeviceCountPdo();
  } else {
    PartnerProcessPdo(pdo);
  }
}

void COEmcyReceived(CO_NODE* node, uint8_t nodeId, uint16_t code, uint8_t reg, const uint8_t msef[5]) {
  CO_UNUSED(node);
  CO_UNUSED(code);
  CO_UNUSED(reg);
  CO_UNUSED(msef);
  PartnerCountError(nodeId);
}

// Waits until a counter of the partner has reached a number.
static bool AwaitCount(const uint32_t* counter, uint32_t number) {
  const uint32_t start = ClockMicroseconds();
  while (*counter < number && ClockMicroseconds() - start < TIME_LIMIT) {
    PartnerProcess();
  }
  return *counter >= number;
}

static void WriteParameters(uint32_t round) {
  static uint8_t profile[PROFILE_SIZE];
  for (uint32_t n = 0; n < PROFILE_SIZE; ++n) {
    profile[n] = (uint8_t)(n * round);
  }
  Check(PartnerWrite(CO_DEV(0x2100, 0), &round, sizeof(round)), "a number is written");
  Check(PartnerWrite(CO_DEV(0x2101, 0), profile, PROFILE_SIZE), "600 bytes are written");
  Check(PartnerWrite(CO_DEV(0x1010, 1), "save", 4), "the parameters are stored");
  Check(PartnerVerify(CO_DEV(0x2100, 0), &round, sizeof(round)), "the number is read back");
  Check(PartnerVerify(CO_DEV(0x2101, 0), profile, PROFILE_SIZE), "600 bytes are read back");
}

static void WriteAlarm(uint32_t round, uint8_t alarm) {
  const uint32_t number = 2 * round - alarm;  // expected number of raised and resolved alarms so far
  Check(PartnerWrite(CO_DEV(0x2102, 0), &alarm, 1), "the alarm is written");
  Check(AwaitCount(&Partner.Errors, number), "an EMCY message reports it");
  Check(AwaitCount(&Partner.Events, number), "an event-driven PDO reports it");
}

int main(void) {
  Check(PartnerStart(BusAttach()) == CO_ERR_NONE, "the partner starts");
  Check(DeviceStart(BusAttach()) == CO_ERR_NONE, "the device starts");
  PartnerStartNetwork();
  for (uint32_t round = 1; round <= ROUNDS && Failures == 0; ++round) {
    WriteParameters(round);
    WriteAlarm(round, 1);
    WriteAlarm(round, 0);
  }
  Check(AwaitCount(&Partner.Pdos, PDOS), "a PDO follows each SYNC");
  Check(AwaitCount(&Partner.Answers, ANSWERS), "the device answers the partner's PDOs");
  const DEVICE_REPORT device = DeviceStop();
  PartnerStop();
  Check(device.MismatchedPairs == 0 && Partner.MismatchedPairs == 0, "the two values of each pair match");
  Check(device.Lost == 0, "no frame is lost");
  Check(DeviceStoredLimit() == ROUNDS, "the last stored value is loaded at the next start");
  printf("%u cycles of 1 ms, the longest %u us; PDOs %u and %u, EMCY %u, stored %u times: %s\n",
         (unsigned)device.Cycles, (unsigned)device.LongestCycle, (unsigned)Partner.Pdos, (unsigned)device.Received,
         (unsigned)Partner.Errors, (unsigned)ROUNDS, Failures == 0 ? "passed" : "FAILED");
  return Failures == 0 ? 0 : 1;
}
