// SPDX-License-Identifier: Apache-2.0
// The device: one node, two threads. One of them comes every millisecond, for SYNC and PDOs; the other has all the time
// that is left, for SDO, EMCY and storage.
#ifndef DEMO_TWO_THREADS_DEVICE_H_
#define DEMO_TWO_THREADS_DEVICE_H_

#include "co_core.h"

#define DEVICE_ID 5u
#define PROFILE_SIZE 600u

// Dictionary: 2000h:1, :2 from the network, 2001h:1, :2 to it, 2100h a limit, 2101h a profile, 2102h an alarm.

typedef struct DEVICE_REPORT_T {
  uint32_t Cycles;        // of the real-time thread
  uint32_t Received;      // RPDOs that were written
  uint32_t Torn;          // what belongs together was seen apart
  uint32_t Lost;          // frames
  uint32_t LongestCycle;  // µs that the real-time thread has worked, waiting for the other one included
} DEVICE_REPORT;

// Prints the error of the node, if there is one.
CO_ERR DeviceStart(void* controller);
DEVICE_REPORT DeviceStop(void);

// What 2100h is after another start, by what was stored.
uint32_t DeviceStoredLimit(void);

// For COPdoUpdate(): an RPDO of this node.
void DeviceUpdate(void);
bool IsDevice(const CO_NODE* node);

#endif
