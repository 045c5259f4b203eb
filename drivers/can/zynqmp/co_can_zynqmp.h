// SPDX-License-Identifier: Apache-2.0
/// \file co_can_zynqmp.h
/// The CAN controllers of Xilinx (AMD) Zynq UltraScale+ and Zynq-7000 (UG1085, UG585): two of each in a device, one
/// context for each. C and C++, bare metal or in a task of an RTOS.
///
///     static CO_IF_FRM frames[32];
///     static CO_CAN_ZYNQMP can0 = {.Registers = (volatile uint32_t *)0xFF060000, .Rates = rates, .RateNum = 1,
///                                  .Frames = frames, .FrameNum = 32};
///     ext.Can = &ZynqmpCanDriver;  ext.CanCtx = &can0;             // CO_NODE_EXT
///     void CAN0_IRQHandler(void) { COCanZynqmpInterrupt(&can0); }  // GIC: 55 (CAN0), 56 (CAN1) of ZynqMP, level
///
/// Clock, reset and pins of the controller are the board's: they must be set up before CONodeInit(). The bit timings
/// that the node may be told to use (LSS!) are a table, in C++ computed and proven by zynqmp_rates.hpp, in C made by
/// macros, with the number of quanta chosen by you (16 where clock / rate is a multiple of it):
///
///     static const CO_CAN_ZYNQMP_RATE rates[] = {CO_CAN_ZYNQMP_RATE_OF(24000000, 500000, 16)};
///     _Static_assert(CO_CAN_ZYNQMP_RATE_FITS(24000000, 500000, 16), "500 kbit/s");
///
/// A rate that is not in the table leaves the controller off the bus: Send answers -1.
///
/// Receiving. The interrupt moves frames from the receive FIFO (64 frames) into the queue at CO_CAN_ZYNQMP.Frames, from
/// where the loop reads them; the two need no lock. A frame that finds either full is lost: COCanZynqmpLost() counts,
/// and the node reports CO_CAN_OVERRUN. Without an interrupt, call COCanZynqmpInterrupt() in the loop, often enough for
/// the FIFO: at 1 Mbit/s it is full after 3 ms.
///
/// The acceptance filters are set from what the node wants to receive: the four of them let through exactly that, as
/// long as it is four identifiers or identifiers that differ in few bits; else they let some more through, which the
/// node ignores. Remote frames pass as data frames do.
///
/// Sending. The controller is given one frame at a time, so that the node's queue decides which one is next, as late as
/// possible. Where a frame has lost the arbitration and one of higher priority comes up, that one goes first, by the
/// high priority transmit buffer; so a frame waits for at most one frame of lower priority of this node, whatever the
/// bus carries. Frames of one identifier keep their order, and nothing overtakes the boot-up message.
///
/// Bus-off. The controller stays off the bus, although it could come back by itself, until COIfCanReset(), which any
/// NMT reset calls, or CO_IF_CAN_DRV_EX.Enable: Send answers -1, and the node reports CO_CAN_BUS_OFF; CO_CAN_RECOVERED
/// when it is back. CO_CAN_PASSIVE, and CO_CAN_RECOVERED after it, are noticed when the node reads.
///
/// A reset without bus-off throws away what was received; the frame that the controller has is still sent, before the
/// boot-up message.
///
/// Context: the loop, and one interrupt on the same CPU, COCanZynqmpInterrupt().
/// Owner: context and frames stay the caller's and must live as long as the node; one node for each context.
#ifndef CO_CAN_ZYNQMP_H_
#define CO_CAN_ZYNQMP_H_

#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit rate and what the registers BRPR and BTR hold for it.
typedef struct CO_CAN_ZYNQMP_RATE_T {
  uint32_t Baud;  ///< bit/s
  uint16_t Prescaler;
  uint16_t Timing;
} CO_CAN_ZYNQMP_RATE;

/// \cond internal
#define CO_CAN_ZYNQMP_SEGMENT2(quanta) (((quanta) + 4u) / 8u)
#define CO_CAN_ZYNQMP_SEGMENT1(quanta) ((quanta)-1u - CO_CAN_ZYNQMP_SEGMENT2(quanta))
/// \endcond

/// \name Bit timing in C: \a clock in Hz, \a baud in bit/s, and the number of quanta in a bit, 8…10 or 14…20
/// \{
/// Initialises a CO_CAN_ZYNQMP_RATE; the sample point is as near to 87.5 % as these quanta allow.
#define CO_CAN_ZYNQMP_RATE_OF(clock, baud, quanta)                                                               \
  {                                                                                                              \
    (baud), (uint16_t)((clock) / ((baud) * (quanta)) - 1u),                                                      \
        (uint16_t)(((CO_CAN_ZYNQMP_SEGMENT2(quanta) - 1u) << 7) | ((CO_CAN_ZYNQMP_SEGMENT2(quanta) - 1u) << 4) | \
                   (CO_CAN_ZYNQMP_SEGMENT1(quanta) - 1u))                                                        \
  }
/// True if that is exact, with a sample point that CiA allows, and within what the controller can do.
#define CO_CAN_ZYNQMP_RATE_FITS(clock, baud, quanta)                                                            \
  ((((quanta) >= 8 && (quanta) <= 10) || ((quanta) >= 14 && (quanta) <= 20)) && (clock) >= (baud) * (quanta) && \
   (clock) % ((baud) * (quanta)) == 0 && (clock) / ((baud) * (quanta)) <= 256)
/// \}

/// A controller. Initialise it with zero, then set the first members; the application touches nothing else.
typedef struct CO_CAN_ZYNQMP_T {
  volatile uint32_t* Registers;     ///< ZynqMP: FF06 0000h, FF07 0000h; Zynq-7000: E000 8000h, E000 9000h
  const CO_CAN_ZYNQMP_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                  ///< length of that array
  CO_IF_FRM* Frames;  ///< memory between interrupt and loop: as many frames as come while the loop is busy
  uint16_t FrameNum;  ///< length of that array, 1…32767
  bool Loopback;      ///< self-test: what is sent is received, and nothing else; the bus sees nothing

  /// \cond internal
  CO_RING Received;
  const CO_CAN_ZYNQMP_RATE* Rate;  // null: off the bus
  uint32_t Overflows;              // of the receive FIFO; written by the interrupt
  uint8_t IsBusOff;                // written by the interrupt
  uint8_t Told;                    // state that the node knows: an error state of the controller, or bus-off
  uint8_t IsSending;               // a frame is in the transmit FIFO
  uint8_t FilterNum;               // 0: everything is received
  uint32_t SendingWord;            // its identifier, as the controller has it; 0: nothing may overtake it
  uint32_t ToldLost;
  uint32_t FilterMask[4];
  uint32_t FilterId[4];
  /// \endcond
} CO_CAN_ZYNQMP;

/// The driver; its context is a CO_CAN_ZYNQMP.
extern const CO_IF_CAN_DRV_EX ZynqmpCanDriver;

/// To be called in the interrupt of the controller.
void COCanZynqmpInterrupt(CO_CAN_ZYNQMP* can);

/// Lets the controller sleep when the bus is idle, as it does until something is sent or received; wakes the CPU then
/// by the interrupt. The frame that wakes a controller may be lost to it.
void COCanZynqmpSleep(CO_CAN_ZYNQMP* can);

/// Received frames that were lost since Enable or a reset: the queue was full, or, each burst counted once, the receive
/// FIFO.
uint32_t COCanZynqmpLost(const CO_CAN_ZYNQMP* can);

#ifdef __cplusplus
}
#endif

#endif
