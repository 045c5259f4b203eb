// SPDX-License-Identifier: Apache-2.0
// The other node on the bus: it answers each SYNC with a PDO, and reads and writes the device's objects. It has one
// thread, that of its caller.
#ifndef DEMO_TWO_THREADS_PARTNER_H_
#define DEMO_TWO_THREADS_PARTNER_H_

#include "co_core.h"

// What has come from the device.
typedef struct PARTNER_REPORT_T {
  uint32_t Pdos;     // with each SYNC
  uint32_t Answers;  // of these: the device has got what the partner has sent
  uint32_t Events;   // event-driven PDOs
  uint32_t Torn;     // what belongs together was seen apart
  uint32_t Errors;   // EMCY messages of an error, and that it is gone
} PARTNER_REPORT;

extern PARTNER_REPORT Partner;

// Prints the error of the node, if there is one.
CO_ERR PartnerStart(void* controller);
void PartnerStop(void);

// Lets the node work for a moment.
void PartnerTurn(void);

// All nodes become operational.
void PartnerStartNetwork(void);

// SDO transfers with the device. False: aborted, or other bytes than these.
bool PartnerWrite(uint32_t key, const void* data, uint32_t size);
bool PartnerFinds(uint32_t key, const void* data, uint32_t size);

// For COPdoUpdate() and COEmcyReceived().
void PartnerUpdate(const CO_RPDO* pdo);
void PartnerHearError(uint8_t node_id);

#endif
