// SPDX-License-Identifier: Apache-2.0
/// \file co_can_controller.h
/// Properties and types that the drivers for CAN controllers have in common: bxCAN, M_CAN, FlexCAN, MCP2515, MCP251xFD,
/// SJA1000, TWAI and ZynqMP. C and C++, bare metal or in a task of an RTOS. The header of each driver has the
/// differences.
///
/// Each controller has a context, a structure that is initialised with zero. The application sets, besides the members
/// that are described there:
/// - Rates, RateNum: the bit timings that the node may use (also by LSS). With another rate, the controller stays off
///   the bus: Send returns -1. In C++ a header computes and checks the table (bxcan_rates.hpp and others); in C a macro
///   does (CO_CAN_BXCAN_RATE_OF() and others), with a given number of quanta per bit.
/// - Frames, FrameNum: the queue between interrupt and loop, enough for the frames that arrive while the loop is busy.
/// - Recovery: the reaction to bus-off.
/// - Loopback: self-test, the controller receives its own frames.
///
/// Receiving. The interrupt moves frames from the controller into the queue, from which the loop reads them, without a
/// lock. A frame that arrives while the controller's memory or the queue is full is lost: COCan…Lost() counts it, and
/// the node reports CO_CAN_OVERRUN. The driver sets the filters from the identifiers that the node receives.
///
/// Sending. The lowest identifier is sent first; see transmit.hpp. A frame waits for at most one frame of lower
/// priority of this node, the one on the wire; frames of one identifier keep their order, and no frame overtakes the
/// boot-up message. The page of the driver in docs/drivers has the exceptions.
///
/// Bus-off. Recovery selects the rule: by the application (COIfCanReset(), which every NMT reset calls, or Enable), or
/// automatic. Send returns -1 until the controller is on the bus again. The node reports CO_CAN_BUS_OFF, and
/// CO_CAN_RECOVERED when the controller is on the bus again; frames that were accepted before are sent then, after a
/// recovery by Reset or Enable they are discarded. Read detects CO_CAN_PASSIVE, and CO_CAN_RECOVERED after it.
///
/// Reset and Close abort all frames that wait for transmission. A frame that is on the wire is completed.
///
/// Context: the loop, and interrupts of one priority on the same CPU that call the interrupt function of the driver.
/// Owner: context, rates and frames are the caller's and must live as long as the node; one node for each context.
///
/// A new driver has its registers and a port for controller::Driver; controller.hpp has the rules.
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

// Bit timing with a sample point near 87.5 %. CO_CAN_QUANTA_FIT(): quanta for which CiA 301 allows the sample point.
#define CO_CAN_SEGMENT2(quanta) (((quanta) + 4u) / 8u)
#define CO_CAN_SEGMENT1(quanta) ((quanta)-1u - CO_CAN_SEGMENT2(quanta))
#define CO_CAN_QUANTA_FIT(quanta, most) (((quanta) >= 8 && (quanta) <= 10) || ((quanta) >= 14 && (quanta) <= (most)))
#define CO_CAN_IS_EXACT(clock, baud, quanta, prescaler) \
  ((clock) >= (baud) * (quanta) && (clock) % ((baud) * (quanta)) == 0 && (clock) / ((baud) * (quanta)) <= (prescaler))

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
