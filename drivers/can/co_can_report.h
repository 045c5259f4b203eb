// SPDX-License-Identifier: Apache-2.0
/// \file co_can_report.h
/// States and events of a CAN controller that its driver has reported to the node. Part of the contexts of
/// drivers/can/bxcan, fdcan, flexcan, mcp2515 and sja1000; report.hpp has the functions.
#ifndef CO_CAN_REPORT_H_
#define CO_CAN_REPORT_H_

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
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
