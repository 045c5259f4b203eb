// SPDX-License-Identifier: Apache-2.0
/// \file co_can_fdcan.h
/// Drivers for M_CAN by Bosch, the CAN FD controller of STM32 and others (docs/drivers/fdcan.md), used for classic CAN
/// frames. What they have in common with other drivers is in co_can_controller.h. Tested on a register model, not on
/// silicon.
///
/// | driver, interrupt function | message memory | controllers |
/// |---|---|---|
/// | FdcanCanDriver, COCanFdcanInterrupt() | fixed | STM32 G0, G4, H5, L5, U5 |
/// | McanCanDriver, COCanMcanInterrupt() | configurable | STM32H7, and M_CAN of other makers |
///
///     static const CO_CAN_FDCAN_RATE rates[] = {CO_CAN_FDCAN_RATE_OF(170000000, 500000, 20)};
///     static CO_IF_FRM frames[32];
///     static CO_CAN_FDCAN can1 = {.Registers = CO_CAN_FDCAN_1, .Ram = CO_CAN_FDCAN_RAM(0), .Rates = rates,
///                                 .RateNum = 1, .Frames = frames, .FrameNum = 32};
///     ext.Can = &FdcanCanDriver;  ext.CanCtx = &can1;                     // CO_NODE_EXT
///     void FDCAN1_IT0_IRQHandler(void) { COCanFdcanInterrupt(&can1); }
///
/// The board must enable the bus clock and the kernel clock of the controller, its pins and interrupt line 0 before
/// CONodeInit().
///
/// The receive FIFO of the fixed memory has three frames, 141 us at 1 Mbit/s: no other interrupt, and no section with
/// disabled interrupts, may be longer. That of the configurable memory has 1 to 64.
///
/// The filters, which change without interrupting reception, are 27 ranges of 11-bit identifiers and 7 of 29-bit ones.
/// If these do not suffice, the ranges with the smallest gap are merged, and some more frames pass, which the node
/// ignores. Remote frames pass like data frames.
///
/// CAN FD. The driver sends classic frames only. CAN FD frames of other nodes are received and discarded, so that they
/// are not destroyed by error frames: without bit rate switching always, with it if CO_CAN_FDCAN.DataTiming is set.
#ifndef CO_CAN_FDCAN_H_
#define CO_CAN_FDCAN_H_

#include "../co_can_controller.h"
#include "co_if_can.h"
#include "co_ring.h"
#include "fdcan_registers.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Addresses of controllers in the STM32G4, for CO_CAN_FDCAN.Registers and CO_CAN_FDCAN.Ram; \a n: 0…2
/// Other families: docs/drivers/fdcan.md.
/// \{
#define CO_CAN_FDCAN_1 ((void*)0x40006400u)  ///< registers of FDCAN1
#define CO_CAN_FDCAN_2 ((void*)0x40006800u)  ///< registers of FDCAN2
#define CO_CAN_FDCAN_3 ((void*)0x40006C00u)  ///< registers of FDCAN3
/// Message memory of a controller.
#define CO_CAN_FDCAN_RAM(n) ((volatile uint32_t*)(0x4000A400u + 4u * CO_FDCAN_RAM_WORDS * (n)))
/// \}

/// \name Addresses of controllers in the STM32H7
/// \{
#define CO_CAN_MCAN_1 ((void*)0x4000A000u)                 ///< registers of FDCAN1
#define CO_CAN_MCAN_2 ((void*)0x4000A400u)                 ///< registers of FDCAN2
#define CO_CAN_MCAN_RAM ((volatile uint32_t*)0x4000AC00u)  ///< 2560 words, shared by the controllers
/// \}

/// Words of the configurable message memory that a controller needs, for \a frames places in its receive FIFO.
#define CO_CAN_MCAN_RAM_WORDS(frames) (CO_FDCAN_RAM_RECEIVE + 4u * (frames) + 4u * CO_CAN_MAILBOXES)

/// A bit rate and the value of the register NBTP for it.
typedef struct CO_CAN_FDCAN_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< prescaler and segments, as in the register
} CO_CAN_FDCAN_RATE;

/// \name Bit timing in C: \a clock in Hz, \a baud in bit/s, and the number of quanta in a bit, 14…256
/// \{

/// Initialises a CO_CAN_FDCAN_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_FDCAN_RATE_OF(clock, baud, quanta)                                                           \
  {                                                                                                         \
    (baud) * CO_REQUIRED(CO_CAN_FDCAN_RATE_FITS(clock, baud, quanta)),                                      \
        ((CO_CAN_SEGMENT2(quanta) - 1u) << 25) | (((uint32_t)((clock) / ((baud) * (quanta))) - 1u) << 16) | \
            ((CO_CAN_SEGMENT1(quanta) - 1u) << 8) | (CO_CAN_SEGMENT2(quanta) - 1u)                          \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_FDCAN_RATE_FITS(clock, baud, quanta) \
  ((quanta) >= 14 && (quanta) <= 256 && CO_CAN_IS_EXACT(clock, baud, quanta, 512))
/// \}

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_FDCAN_T {
  void* Registers;                 ///< CO_FDCAN_REGISTERS or CO_MCAN_REGISTERS
  volatile uint32_t* Ram;          ///< fixed: message memory of this controller; configurable: of all controllers
  uint16_t RamOffset;              ///< configurable: first word of this controller in the memory; fixed: 0
  uint8_t FifoNum;                 ///< configurable: places in the receive FIFO, 1…64; fixed: unused
  const CO_CAN_FDCAN_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                 ///< length of that array
  CO_IF_FRM* Frames;    ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;    ///< length of that array, 1…32767
  uint32_t DataTiming;  ///< value of the register DBTP for CAN FD frames of other nodes; 0: unknown
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  /// Accepts a first frame only while no frame of another node is received: for controllers with the erratum "message
  /// transmitted with wrong arbitration and control fields" of M_CAN (docs/drivers/fdcan.md).
  bool WaitForIdle;
  bool Loopback;  ///< self-test: the controller receives its own frames, and no others; it is off the bus

  /// \cond internal
  CO_RING Received;
  const CO_CAN_FDCAN_RATE* Rate;  // null: off the bus
  CO_CAN_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  /// \endcond
} CO_CAN_FDCAN;

/// \name Drivers; their context is a CO_CAN_FDCAN
/// \{
extern const CO_IF_CAN_DRV_EX FdcanCanDriver;  ///< fixed message memory
extern const CO_IF_CAN_DRV_EX McanCanDriver;   ///< configurable message memory
/// \}

/// \name Move received frames into the queue, store events and refill buffers. Call them in the interrupt of line 0.
/// \{
void COCanFdcanInterrupt(CO_CAN_FDCAN* can);  ///< fixed message memory
void COCanMcanInterrupt(CO_CAN_FDCAN* can);   ///< configurable message memory
/// \}

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanFdcanHasFrames(const CO_CAN_FDCAN* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO was full (each interrupt for lost frames counts as one).
uint32_t COCanFdcanLost(const CO_CAN_FDCAN* can);

/// Returns the error counters of the controller.
CO_CAN_ERROR_COUNTERS COCanFdcanErrors(const CO_CAN_FDCAN* can);

#ifdef __cplusplus
}
#endif

#endif
