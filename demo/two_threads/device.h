// SPDX-License-Identifier: Apache-2.0
// The device: one node, two threads. One runs every millisecond, for SYNC and PDOs; the other one runs in the remaining
// time, for SDO, EMCY and storage.
#ifndef DEMO_TWO_THREADS_DEVICE_H_
#define DEMO_TWO_THREADS_DEVICE_H_

#include "co_core.h"

#define DEVICE_ID 5u
#define PROFILE_SIZE 600u

// Dictionary: 2000h:1, :2 received, 2001h:1, :2 transmitted, 2100h a limit, 2101h a profile, 2102h an alarm.

typedef struct DEVICE_REPORT_T {
  uint32_t Cycles;           // cycles of the real-time thread
  uint32_t Received;         // RPDOs that were written to the dictionary
  uint32_t MismatchedPairs;  // pairs of values that were read inconsistently
  uint32_t Lost;             // frames that the node dropped, and overruns of the controller
  uint32_t LongestCycle;     // execution time of the real-time thread in µs, including waiting for the lock
} DEVICE_REPORT;

// Starts the node and its threads. Prints the error of the node, if there is one, and returns it.
CO_ERR DeviceStart(void* controller);
// Ends the threads and stops the node. Returns the numbers of the whole run.
DEVICE_REPORT DeviceStop(void);

// Initialises the node again, and returns the value of 2100h that it loads. Call it after DeviceStop().
uint32_t DeviceStoredLimit(void);

// Counts a received RPDO; for COPdoUpdate().
void DeviceCountPdo(void);
// Returns true for the device's node, false for the partner's.
bool IsDevice(const CO_NODE* node);

#endif
