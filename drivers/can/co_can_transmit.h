// SPDX-License-Identifier: Apache-2.0
/// \file co_can_transmit.h
/// Frames that a driver has accepted and not yet sent, for controllers with three transmit mailboxes. Part of the
/// contexts of drivers/can/bxcan, fdcan and flexcan; transmit.hpp has the functions.
#ifndef CO_CAN_TRANSMIT_H_
#define CO_CAN_TRANSMIT_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal
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
