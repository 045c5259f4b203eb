// SPDX-License-Identifier: Apache-2.0
// The other node on the bus: answers each SYNC with a PDO, and accesses the device's objects by SDO. It runs in the
// thread of its caller.
#ifndef DEMO_TWO_THREADS_PARTNER_H_
#define DEMO_TWO_THREADS_PARTNER_H_

#include "co_core.h"

// Numbers of messages from the device. Each PDO contains a value and its complement; the device answers each value of
// the partner with the value + 1.
typedef struct PARTNER_REPORT_T {
  uint32_t Pdos;             // synchronous PDOs
  uint32_t Answers;          // synchronous PDOs that answer the partner's last value
  uint32_t Events;           // event-driven PDOs
  uint32_t MismatchedPairs;  // synchronous PDOs whose two values do not match
  uint32_t Errors;           // EMCY messages, of raised and resolved errors
} PARTNER_REPORT;

extern PARTNER_REPORT Partner;

// Starts the partner. Prints the error of the node, if there is one, and returns it.
CO_ERR PartnerStart(void* controller);
void PartnerStop(void);

// Processes the node for a short time.
void PartnerProcess(void);

// Starts all nodes (NMT).
void PartnerStartNetwork(void);

// Writes an object of the device by SDO. Returns false if the transfer is aborted.
bool PartnerWrite(uint32_t key, const void* data, uint32_t size);
// Reads an object of the device by SDO. Returns false if the transfer is aborted, or if the object has other content.
bool PartnerVerify(uint32_t key, const void* data, uint32_t size);

// Process messages of the device; for COPdoUpdate() and COEmcyReceived().
void PartnerProcessPdo(const CO_RPDO* pdo);
void PartnerCountError(uint8_t node_id);

#endif
