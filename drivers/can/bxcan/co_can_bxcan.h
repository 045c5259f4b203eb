// SPDX-License-Identifier: Apache-2.0
/// \file co_can_bxcan.h
/// Driver for bxCAN, the CAN controller of STM32 F0, F1, F2, F3, F4, F7 and L4 (docs/drivers/bxcan.md). What it has in
/// common with other drivers is in co_can_controller.h. Tested on a register model, not on silicon.
///
///     static const CO_CAN_BXCAN_RATE rates[] = {CO_CAN_BXCAN_RATE_OF(36000000, 500000, 18)};
///     static CO_IF_FRM frames[32];
///     static CO_CAN_BXCAN can1 = {.Registers = CO_CAN_BXCAN_1, .BankNum = 14, .Rates = rates, .RateNum = 1,
///                                 .Frames = frames, .FrameNum = 32};
///     ext.Can = &BxcanCanDriver;  ext.CanCtx = &can1;                      // CO_NODE_EXT
///     void USB_LP_CAN1_RX0_IRQHandler(void) { COCanBxcanInterrupt(&can1); }  // likewise the vectors TX and SCE
///
/// The board must enable the clock of the controller (of CAN2: also that of CAN1), its pins and the three interrupts
/// TX, RX0 and SCE, with one priority, before CONodeInit().
///
/// Receive FIFO 0 has three frames. Three short frames take 141 us at 1 Mbit/s: no other interrupt, and no section with
/// disabled interrupts, may be longer.
///
/// The driver sets the filter banks from the identifiers that the node receives: two filters in each bank, without
/// interrupting reception. One bank passes all frames during a change. Filters are exact for as many 11-bit identifiers
/// as there are filters (26 with 14 banks); for more of them, and for 29-bit identifiers, of which the controller
/// compares 14 bits, some more frames pass, which the node ignores.
///
/// bxCAN is a controller of CAN 2.0B: it destroys CAN FD frames by error frames. A bus with CAN FD needs another one.
///
/// Controllers that share filter banks (CAN1, CAN2) are used in the same loop.
#ifndef CO_CAN_BXCAN_H_
#define CO_CAN_BXCAN_H_

#include "../co_can_controller.h"
#include "bxcan_registers.h"
#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Addresses of controllers, for CO_CAN_BXCAN.Registers
/// \{
#define CO_CAN_BXCAN_1 ((CO_BXCAN_REGISTERS*)0x40006400u)  ///< CAN1, or CAN, in all families
#define CO_CAN_BXCAN_2 ((CO_BXCAN_REGISTERS*)0x40006800u)  ///< CAN2
#define CO_CAN_BXCAN_3 ((CO_BXCAN_REGISTERS*)0x40006C00u)  ///< CAN3 of STM32F413/423; in the F7 it is 4000 3400h
/// \}

/// A bit rate and the value of the register BTR for it.
typedef struct CO_CAN_BXCAN_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< without LBKM and SILM
} CO_CAN_BXCAN_RATE;

/// \name Bit timing in C: \a clock in Hz, \a baud in bit/s, and the number of quanta in a bit, 8…10 or 14…19
/// \{

/// Initialises a CO_CAN_BXCAN_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_BXCAN_RATE_OF(clock, baud, quanta)                                                     \
  {                                                                                                   \
    (baud) * CO_REQUIRED(CO_CAN_BXCAN_RATE_FITS(clock, baud, quanta)),                                \
        ((CO_CAN_SEGMENT2(quanta) - 1u) << 24) | ((CO_CAN_SEGMENT2(quanta) - 1u) << 20) |             \
            ((CO_CAN_SEGMENT1(quanta) - 1u) << 16) | ((uint32_t)((clock) / ((baud) * (quanta))) - 1u) \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_BXCAN_RATE_FITS(clock, baud, quanta) \
  (CO_CAN_QUANTA_FIT(quanta, 19) && CO_CAN_IS_EXACT(clock, baud, quanta, 1024))
/// \}

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_BXCAN_T {
  CO_BXCAN_REGISTERS* Registers;   ///< CO_CAN_BXCAN_1 and others
  CO_BXCAN_REGISTERS* Master;      ///< null; for CAN2: CAN1, which has the filter banks of both
  uint8_t FirstBank;               ///< first filter bank of this controller: 0; for CAN2 for example 14
  uint8_t BankNum;                 ///< number of its banks, 2…28: 14 in devices with one controller
  const CO_CAN_BXCAN_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                 ///< length of that array
  CO_IF_FRM* Frames;  ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;  ///< length of that array, 1…32767
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  bool Loopback;             ///< self-test: the controller receives its own frames, and no others; it is off the bus

  /// \cond internal
  CO_RING Received;
  const CO_CAN_BXCAN_RATE* Rate;  // null: off the bus
  CO_CAN_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  /// \endcond
} CO_CAN_BXCAN;

/// The driver; its context is a CO_CAN_BXCAN.
extern const CO_IF_CAN_DRV_EX BxcanCanDriver;

/// Moves received frames into the queue, stores events and refills mailboxes. Call it in the interrupts TX, RX0 and SCE
/// of the controller; in the STM32F0 in its only interrupt.
void COCanBxcanInterrupt(CO_CAN_BXCAN* can);

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanBxcanHasFrames(const CO_CAN_BXCAN* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO was full (each overrun of the FIFO counts as one).
uint32_t COCanBxcanLost(const CO_CAN_BXCAN* can);

/// Returns the error counters of the controller.
CO_CAN_ERROR_COUNTERS COCanBxcanErrors(const CO_CAN_BXCAN* can);

#ifdef __cplusplus
}
#endif

#endif
