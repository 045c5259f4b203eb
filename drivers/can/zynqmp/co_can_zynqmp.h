// SPDX-License-Identifier: Apache-2.0
/// \file co_can_zynqmp.h
/// Driver for the CAN controllers of Xilinx (AMD) Zynq UltraScale+ and Zynq-7000 (UG1085, UG585): two in each device,
/// one context for each. C and C++, bare metal or in a task of an RTOS.
///
///     static CO_IF_FRM frames[32];
///     static CO_CAN_ZYNQMP can0 = {.Registers = (volatile uint32_t *)0xFF060000, .Rates = rates, .RateNum = 1,
///                                  .Frames = frames, .FrameNum = 32};
///     ext.Can = &ZynqmpCanDriver;  ext.CanCtx = &can0;             // CO_NODE_EXT
///     void CAN0_IRQHandler(void) { COCanZynqmpInterrupt(&can0); }  // GIC: 55 (CAN0), 56 (CAN1) of ZynqMP, level
///
/// The board must set up clock, reset and pins of the controller before CONodeInit(). The bit timings that the node may
/// use (also by LSS) are a table. In C++ zynqmp_rates.hpp computes and checks it; in C the macro
/// CO_CAN_ZYNQMP_RATE_OF() does, with a given number of quanta per bit (16 where clock / rate is a multiple of it).
///
///     static const CO_CAN_ZYNQMP_RATE rates[] = {CO_CAN_ZYNQMP_RATE_OF(24000000, 500000, 16)};
///
/// With a rate that is not in the table, the controller stays off the bus: Send returns -1.
///
/// Receiving. The interrupt moves frames from the receive FIFO (64 frames) into the queue at CO_CAN_ZYNQMP.Frames, from
/// which the loop reads them, without a lock. A frame that arrives while either is full is lost: COCanZynqmpLost()
/// counts it, and the node reports CO_CAN_OVERRUN. Without an interrupt, call COCanZynqmpInterrupt() in the loop, often
/// enough for the FIFO: at 1 Mbit/s it is full after 3 ms.
///
/// The driver sets the four acceptance filters from the identifiers that the node receives. They are exact for up to
/// four identifiers, or for identifiers that differ in few bits; otherwise some more frames pass, which the node
/// ignores. Remote frames pass like data frames.
///
/// Sending. The controller is given one frame at a time, so that the node's queue selects the next one as late as
/// possible. If that frame has lost the arbitration and the node sends one of higher priority, the latter is sent
/// first, by the high priority transmit buffer; so a frame waits for at most one frame of lower priority of this node,
/// at any bus load. Frames of one identifier keep their order, and no frame overtakes the boot-up message.
///
/// Bus-off. The controller stays off the bus (automatic recovery is disabled) until COIfCanReset(), which any NMT reset
/// calls, or CO_IF_CAN_DRV_EX.Enable. Meanwhile Send returns -1. The node reports CO_CAN_BUS_OFF, and CO_CAN_RECOVERED
/// when the controller is on the bus again. Read detects CO_CAN_PASSIVE, and CO_CAN_RECOVERED after it.
///
/// A reset without bus-off discards received frames; a frame that the controller already has is still sent, before the
/// boot-up message.
///
/// Context: the loop, and one interrupt on the same CPU, COCanZynqmpInterrupt().
/// Owner: the caller owns context, rates and frames; they must outlive the node. One context per node.
#ifndef CO_CAN_ZYNQMP_H_
#define CO_CAN_ZYNQMP_H_

#include "../co_can_controller.h"
#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit rate and the values of the registers BRPR and BTR for it.
typedef struct CO_CAN_ZYNQMP_RATE_T {
  uint32_t Baud;       ///< bit/s
  uint16_t Prescaler;  ///< value of BRPR: clock periods in a quantum, less 1
  uint16_t Timing;     ///< value of BTR: the segments and the jump width, each less 1
} CO_CAN_ZYNQMP_RATE;

/// \name Bit timing in C: \a clock in Hz, \a baud in bit/s, and the number of quanta in a bit, 8…10 or 14…20
/// \{

/// Initialises a CO_CAN_ZYNQMP_RATE. The sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_ZYNQMP_RATE_OF(clock, baud, quanta)                                                 \
  {                                                                                                \
    (baud) * CO_REQUIRED(CO_CAN_ZYNQMP_RATE_FITS(clock, baud, quanta)),                            \
        (uint16_t)((clock) / ((baud) * (quanta)) - 1u),                                            \
        (uint16_t)(((CO_CAN_SEGMENT2(quanta) - 1u) << 7) | ((CO_CAN_SEGMENT2(quanta) - 1u) << 4) | \
                   (CO_CAN_SEGMENT1(quanta) - 1u))                                                 \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_ZYNQMP_RATE_FITS(clock, baud, quanta) \
  (CO_CAN_QUANTA_FIT(quanta, 20) && CO_CAN_IS_EXACT(clock, baud, quanta, 256))
/// \}

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_ZYNQMP_T {
  volatile uint32_t* Registers;     ///< ZynqMP: FF06 0000h, FF07 0000h; Zynq-7000: E000 8000h, E000 9000h
  const CO_CAN_ZYNQMP_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                  ///< elements of Rates
  CO_IF_FRM* Frames;  ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;  ///< elements of Frames, 1…32767
  bool Loopback;      ///< self-test: the controller receives its frames, and no others; it is off the bus

  /// \cond internal
  CO_RING Received;
  const CO_CAN_ZYNQMP_RATE* Rate;  // null: off the bus
  CO_CAN_REPORT Report;
  uint8_t IsBusOff;      // written by the interrupt
  uint8_t IsSending;     // a frame is in the transmit FIFO
  uint8_t FilterNum;     // 0: all frames are received
  uint32_t SendingWord;  // identifier of that frame, in the coding of the controller; 0: no frame may
                         // overtake it
  uint32_t FilterMask[4];
  uint32_t FilterId[4];
  /// \endcond
} CO_CAN_ZYNQMP;

/// The driver; its context is a CO_CAN_ZYNQMP.
extern const CO_IF_CAN_DRV_EX ZynqmpCanDriver;

/// Moves received frames into the queue and stores events. Call it in the interrupt of the controller. Has no effect
/// while the controller is off the bus.
void COCanZynqmpInterrupt(CO_CAN_ZYNQMP* can);

/// Enables the sleep mode of the controller, which lasts until a frame is sent or received; its end wakes the CPU by
/// the interrupt. The controller may lose the frame that wakes it. Has no effect while the controller is off the bus,
/// in bus-off, or sends a frame. Context: the loop.
void COCanZynqmpSleep(CO_CAN_ZYNQMP* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO was full (each overflow of the FIFO counts as one). Returns 0 if \a can is null. Context: the loop.
uint32_t COCanZynqmpLost(const CO_CAN_ZYNQMP* can);

#ifdef __cplusplus
}
#endif

#endif
