// SPDX-License-Identifier: Apache-2.0
/// \file co_can_controller.h
/// Types that the contexts of the drivers for CAN controllers have in common: drivers/can/bxcan, fdcan, flexcan,
/// mcp2515 and sja1000. controller.hpp and transmit.hpp have the functions.
#ifndef CO_CAN_CONTROLLER_H_
#define CO_CAN_CONTROLLER_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Error counters of a controller. [ISO 11898-1]
typedef struct CO_CAN_ERROR_COUNTERS_T {
  uint8_t Transmit;  ///< TEC; its lowest 8 bits if it is larger
  uint8_t Receive;   ///< REC; 128 at least while the receiver is error passive
} CO_CAN_ERROR_COUNTERS;

/// Reaction of the driver to bus-off.
typedef enum CO_CAN_RECOVERY_T {
  /// The controller stays off the bus until COIfCanReset(), which every NMT reset calls.
  CO_CAN_RECOVERY_BY_APPLICATION = 0,
  /// The recovery sequence begins at once: the controller is on the bus again after 128 sequences of 11 recessive bits
  /// (1.4 ms at 1 Mbit/s, 11 ms at 125 kbit/s, if the bus is idle).
  CO_CAN_RECOVERY_AUTOMATIC
} CO_CAN_RECOVERY;

/// \cond internal
typedef struct CO_CAN_REPORT_T {
  uint32_t Overflows;     // overflows of the receive FIFO; written by the interrupt
  uint32_t ReportedLost;  // lost frames that are reported
  uint8_t BusOffs;        // number of bus-off events, modulo 256; written by the interrupt
  uint8_t SeenBusOffs;    // value of BusOffs at the last observation
  uint8_t Reported;       // last reported state: co::report::State
} CO_CAN_REPORT;

#define CO_CAN_MAILBOXES 3
#define CO_CAN_DISPLACED 4

typedef struct CO_CAN_TRANSMIT_T {
  CO_IF_FRM Frame[CO_CAN_MAILBOXES];      // copies of the frames in the mailboxes
  CO_IF_FRM Displaced[CO_CAN_DISPLACED];  // frames that were taken from a mailbox for a frame of higher priority
  uint8_t DisplacedNum;
  uint8_t Used;      // bit n: mailbox n has a frame, or its result was not read yet
  uint8_t Dropped;   // bit n: the frame in mailbox n is discarded unless it is on the wire
  uint8_t Aborting;  // bit n: an abort of mailbox n was requested, to displace its frame
} CO_CAN_TRANSMIT;
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
