// SPDX-License-Identifier: Apache-2.0
/// \file co_can_flexcan.h
/// Driver for FlexCAN, the CAN controller of NXP's i.MX 6, 8 and RT, S32K and Kinetis (docs/drivers/flexcan.md), used
/// for classic CAN frames. What it has in common with other drivers is in co_can_controller.h. Tested on a register
/// model and in QEMU on the controllers of an i.MX 6, not on silicon.
///
///     static const CO_CAN_FLEXCAN_RATE rates[] = {CO_CAN_FLEXCAN_RATE_OF(40000000, 500000, 16)};
///     static CO_IF_FRM frames[32];
///     static CO_CAN_FLEXCAN can1 = {.Registers = CO_CAN_FLEXCAN_RT_1, .MailboxNum = 64, .Rates = rates, .RateNum = 1,
///                                   .Frames = frames, .FrameNum = 32};
///     ext.Can = &FlexcanCanDriver;  ext.CanCtx = &can1;               // CO_NODE_EXT
///     void CAN1_IRQHandler(void) { COCanFlexcanInterrupt(&can1); }    // or each of the vectors of the controller
///
/// The board must enable the clocks of the controller, its pins and its interrupts, with one priority, before
/// CONodeInit().
///
/// CO_CAN_FLEXCAN.Receive selects where the controller stores received frames:
/// - the receive FIFO: six frames, 282 us at 1 Mbit/s;
/// - message buffers: 12 of a controller with 16, 28 of one with 32 or more. They are divided among the filters; the
///   interrupt function puts the frames into the order of their time stamps. It needs 750 bytes of stack.
///
/// The FIFO compares up to 24 11-bit identifiers exactly in a controller with 16 message buffers, 40 in one with more;
/// message buffers compare 6 or 14. For more of them some other frames pass, too, which the node ignores. Filters can
/// be changed in freeze mode only: a change on the bus waits for the end of the frame on the wire, and frames that
/// begin in the next bit times are not received (docs/drivers/flexcan.md).
///
/// A frame also waits for one of lower priority that the controller has selected before (LBUF and LPRIOEN are 0).
#ifndef CO_CAN_FLEXCAN_H_
#define CO_CAN_FLEXCAN_H_

#include "../co_can_controller.h"
#include "co_if_can.h"
#include "co_ring.h"
#include "flexcan_registers.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Addresses of controllers, for CO_CAN_FLEXCAN.Registers; others: docs/drivers/flexcan.md
/// \{
#define CO_CAN_FLEXCAN_IMX6_1 ((CO_FLEXCAN_REGISTERS*)0x02090000u)  ///< FLEXCAN1 of i.MX 6
#define CO_CAN_FLEXCAN_IMX6_2 ((CO_FLEXCAN_REGISTERS*)0x02094000u)  ///< FLEXCAN2 of i.MX 6
#define CO_CAN_FLEXCAN_RT_1 ((CO_FLEXCAN_REGISTERS*)0x401D0000u)    ///< CAN1 of i.MX RT105x, RT106x
#define CO_CAN_FLEXCAN_RT_2 ((CO_FLEXCAN_REGISTERS*)0x401D4000u)    ///< CAN2 of i.MX RT105x, RT106x
#define CO_CAN_FLEXCAN_K_0 ((CO_FLEXCAN_REGISTERS*)0x40024000u)     ///< CAN0 of Kinetis K and S32K1
/// \}

/// A bit rate and the registers for it.
typedef struct CO_CAN_FLEXCAN_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< bit timing in CTRL1
  uint32_t Wide;    ///< bit timing in CBT, with BTF, for controllers with this register; 0: that of CTRL1 is used
} CO_CAN_FLEXCAN_RATE;

/// Places for received frames.
typedef enum CO_CAN_FLEXCAN_RECEIVE_T {
  CO_CAN_FLEXCAN_FIFO = 0,  ///< receive FIFO ("legacy" in controllers that have two)
  CO_CAN_FLEXCAN_MAILBOXES  ///< message buffers, also for controllers without FIFO
} CO_CAN_FLEXCAN_RECEIVE;

/// \cond internal
#define CO_CAN_FLEXCAN_SEGMENT2(quanta) ((quanta) < 12u ? 2u : ((quanta) + 4u) / 8u)
#define CO_CAN_FLEXCAN_SEGMENT1(quanta) ((quanta)-1u - CO_CAN_FLEXCAN_SEGMENT2(quanta))
#define CO_CAN_FLEXCAN_PHASE1(quanta)                                                                            \
  (CO_CAN_FLEXCAN_SEGMENT1(quanta) > 8u + CO_CAN_FLEXCAN_SEGMENT2(quanta) ? CO_CAN_FLEXCAN_SEGMENT1(quanta) - 8u \
                                                                          : CO_CAN_FLEXCAN_SEGMENT2(quanta))
/// \endcond

/// \name Bit timing in C: \a clock in Hz, \a baud in bit/s, and the number of quanta in a bit, 14…20; from 800 kbit/s
/// on 8…20
/// \{

/// Initialises a CO_CAN_FLEXCAN_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_FLEXCAN_RATE_OF(clock, baud, quanta)                                                                 \
  {                                                                                                                 \
    (baud) * CO_REQUIRED(CO_CAN_FLEXCAN_RATE_FITS(clock, baud, quanta)),                                            \
        (((uint32_t)((clock) / ((baud) * (quanta))) - 1u) << 24) | ((CO_CAN_FLEXCAN_SEGMENT2(quanta) - 1u) << 22) | \
            ((CO_CAN_FLEXCAN_PHASE1(quanta) - 1u) << 19) | ((CO_CAN_FLEXCAN_SEGMENT2(quanta) - 1u) << 16) |         \
            (CO_CAN_FLEXCAN_SEGMENT1(quanta) - CO_CAN_FLEXCAN_PHASE1(quanta) - 1u),                                 \
        0                                                                                                           \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_FLEXCAN_RATE_FITS(clock, baud, quanta) \
  ((quanta) >= ((baud) >= 800000u ? 8 : 14) && (quanta) <= 20 && CO_CAN_IS_EXACT(clock, baud, quanta, 256))
/// \}

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_FLEXCAN_T {
  CO_FLEXCAN_REGISTERS* Registers;   ///< CO_CAN_FLEXCAN_RT_1 and others
  uint8_t MailboxNum;                ///< message buffers that the controller has, 16…128
  CO_CAN_FLEXCAN_RECEIVE Receive;    ///< where received frames are stored
  const CO_CAN_FLEXCAN_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                   ///< length of that array
  CO_IF_FRM* Frames;  ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;  ///< length of that array, 1…32767
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  bool BusClock;             ///< clock of the protocol engine: CTRL1.CLKSRC, in devices with this bit
  bool Ecc;                  ///< the memory of the controller has ECC: the register MECR exists
  uint16_t EccFirst;         ///< second section of that memory, first byte; EccEnd 0: there is none
  uint16_t EccEnd;           ///< byte behind that section
  bool IgnoreFd;             ///< ignores CAN FD frames of other nodes: CTRL2.PREXCEN, in controllers for CAN FD
  bool Loopback;             ///< self-test: the controller receives its own frames, and no others; it is off the bus

  /// \cond internal
  CO_RING Received;
  const CO_CAN_FLEXCAN_RATE* Rate;  // null: off the bus, in freeze mode
  CO_CAN_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  uint32_t GlobalMask;  // RXFGMASK
  bool RejectsAll;      // the FIFO receives no frame
  bool IsRecovering;    // BOFFREC is cleared until the controller has left bus-off
  /// \endcond
} CO_CAN_FLEXCAN;

/// The driver; its context is a CO_CAN_FLEXCAN.
extern const CO_IF_CAN_DRV_EX FlexcanCanDriver;

/// Moves received frames into the queue, stores events and refills message buffers. Call it in all interrupts of the
/// controller: message buffers, bus-off, error.
void COCanFlexcanInterrupt(CO_CAN_FLEXCAN* can);

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanFlexcanHasFrames(const CO_CAN_FLEXCAN* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO or all message buffers of a filter were full (each overrun counts as one).
uint32_t COCanFlexcanLost(const CO_CAN_FLEXCAN* can);

/// Returns the error counters of the controller.
CO_CAN_ERROR_COUNTERS COCanFlexcanErrors(const CO_CAN_FLEXCAN* can);

#ifdef __cplusplus
}
#endif

#endif
