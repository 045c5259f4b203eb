// SPDX-License-Identifier: Apache-2.0
/// \file co_sja1000_state.h
/// Part of the contexts CO_CAN_SJA1000 and CO_CAN_TWAI: bit rates, and the variables of the driver.
#ifndef CO_SJA1000_STATE_H_
#define CO_SJA1000_STATE_H_

#include "../co_can_controller.h"
#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit rate and the values of the registers for it. Use CO_CAN_SJA1000_RATE_OF() and the like, or sja1000_rates.hpp.
typedef struct CO_CAN_SJA1000_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< bits 0…15: BTR0, 16…23: BTR1
} CO_CAN_SJA1000_RATE;

/// \cond internal
#define CO_CAN_SJA1000_SEGMENT2(quanta) (((quanta) + 4u) / 8u)
#define CO_CAN_SJA1000_SEGMENT1(quanta) ((quanta)-1u - CO_CAN_SJA1000_SEGMENT2(quanta))
#define CO_CAN_SJA1000_TIMING(clock, baud, quanta, shift)                                                        \
  (((uint32_t)((clock) / (2u * (baud) * (quanta))) - 1u) | ((CO_CAN_SJA1000_SEGMENT2(quanta) - 1u) << (shift)) | \
   (((CO_CAN_SJA1000_SEGMENT1(quanta) - 1u) | ((CO_CAN_SJA1000_SEGMENT2(quanta) - 1u) << 4)) << 16))
#define CO_CAN_SJA1000_FITS(clock, baud, quanta, prescaler)                                                         \
  ((((quanta) >= 8 && (quanta) <= 10) || ((quanta) >= 14 && (quanta) <= 19)) && (clock) >= 2 * (baud) * (quanta) && \
   (clock) % (2 * (baud) * (quanta)) == 0 && (clock) / (2 * (baud) * (quanta)) <= (prescaler))

// Frames that wait for transmission, for transmit.hpp: one transmit buffer.
typedef struct CO_SJA1000_TRANSMIT_T {
  CO_IF_FRM Frame[1];      // copy of the frame in the transmit buffer
  CO_IF_FRM Displaced[7];  // frames that were taken from the buffer
  uint8_t DisplacedNum;
  uint8_t Used;
  uint8_t Dropped;
  uint8_t Aborting;
} CO_SJA1000_TRANSMIT;

typedef struct CO_SJA1000_STATE_T {
  CO_RING Received;
  const CO_CAN_SJA1000_RATE* Rate;  // null: off the bus
  CO_SJA1000_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  uint16_t FilterWord[2];  // 11 bits
  uint16_t FilterMask[2];
  uint8_t IsHeld;        // the loop uses the transmit buffer: the interrupt does not
  uint8_t IsMissed;      // the interrupt has occurred meanwhile
  uint8_t BusOff;        // co::sja1000::BusOff
  uint8_t IsAborted;     // the frame was aborted before it was on the wire
  uint8_t NeedsRestart;  // ESP32: the controller needs a reset, because of an erratum
} CO_SJA1000_STATE;
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
