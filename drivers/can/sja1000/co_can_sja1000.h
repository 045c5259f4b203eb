// SPDX-License-Identifier: Apache-2.0
/// \file co_can_sja1000.h
/// Driver for the CAN controller SJA1000 in PeliCAN mode, and for cards and cores with its registers
/// (docs/drivers/sja1000.md). What it has in common with other drivers is in co_can_controller.h. Tested on QEMU's PCI
/// cards and on a register model, not on silicon. For the TWAI of ESP32 see co_can_twai.h.
///
///     static const CO_CAN_SJA1000_RATE rates[] = {CO_CAN_SJA1000_RATE_OF(16000000, 500000, 16)};
///     static CO_IF_FRM frames[32];
///     static CO_SJA1000_MEMORY memory = {(volatile uint8_t*)0x60000000, 1};
///     static CO_CAN_SJA1000 can1 = {.Access = &Sja1000Memory, .AccessCtx = &memory, .Rates = rates, .RateNum = 1,
///                                   .Frames = frames, .FrameNum = 32};
///     ext.Can = &Sja1000CanDriver;  ext.CanCtx = &can1;                  // CO_NODE_EXT
///     void CAN_IRQHandler(void) { COCanSja1000Interrupt(&can1); }
///
/// Registers are accessed by a pair of functions: Sja1000Memory for registers in memory, own functions for I/O ports,
/// PCI cards with further registers, or a multiplexed bus.
///
/// The receive FIFO has 64 bytes: 21 frames without data, 5 with 8 bytes.
///
/// The driver computes the two acceptance filters from the identifiers that the node receives. They compare 11 bits of
/// each identifier and pass further frames, which the node ignores. Filters can be written in reset mode only: if a
/// change on the bus adds an identifier that does not pass yet, the driver leaves the bus for a moment, when it is
/// idle. A frame of another node that begins then is lost.
///
/// There is one transmit buffer. While another node delays the frame in it, a frame of higher priority replaces it, and
/// the replaced one is kept in memory and sent later.
///
/// COCanSja1000Interrupt() must not interrupt the access functions while they select a register with several accesses.
#ifndef CO_CAN_SJA1000_H_
#define CO_CAN_SJA1000_H_

#include "../co_can_controller.h"
#include "co_if_can.h"
#include "co_ring.h"
#include "sja1000_registers.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit rate and the values of the registers for it. Use CO_CAN_SJA1000_RATE_OF() and the like, or sja1000_rates.hpp.
typedef struct CO_CAN_SJA1000_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< bits 0…15: BTR0, 16…23: BTR1
} CO_CAN_SJA1000_RATE;

/// \cond internal
#define CO_CAN_SJA1000_TIMING(clock, baud, quanta, shift)                                                \
  (((uint32_t)((clock) / (2u * (baud) * (quanta))) - 1u) | ((CO_CAN_SEGMENT2(quanta) - 1u) << (shift)) | \
   (((CO_CAN_SEGMENT1(quanta) - 1u) | ((CO_CAN_SEGMENT2(quanta) - 1u) << 4)) << 16))
#define CO_CAN_SJA1000_FITS(clock, baud, quanta, prescaler) \
  (CO_CAN_QUANTA_FIT(quanta, 19) && CO_CAN_IS_EXACT(clock, 2 * (baud), quanta, prescaler))

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
  uint16_t FilterWord[2];  // 11 bits
  uint16_t FilterMask[2];
  uint8_t IsHeld;        // the loop uses the transmit buffer: the interrupt does not
  uint8_t IsMissed;      // the interrupt has occurred meanwhile
  uint8_t BusOff;        // co::sja1000::BusOff
  uint8_t IsAborted;     // the frame was aborted before it was on the wire
  uint8_t NeedsRestart;  // ESP32: the controller needs a reset, because of an erratum
} CO_SJA1000_STATE;
/// \endcond

/// Functions that access a register by its CAN address, 0…31.
typedef struct CO_SJA1000_ACCESS_T {
  uint8_t (*Read)(void* ctx, uint8_t address);               ///< returns the register
  void (*Write)(void* ctx, uint8_t address, uint8_t value);  ///< sets the register
} CO_SJA1000_ACCESS;

/// Registers in memory; context of Sja1000Memory.
typedef struct CO_SJA1000_MEMORY_T {
  volatile uint8_t* Base;  ///< register 0
  uint8_t Distance;        ///< bytes from one register to the next: 1, 2, 4…
} CO_SJA1000_MEMORY;

/// Access to registers in memory, by single bytes; its context is a CO_SJA1000_MEMORY.
extern const CO_SJA1000_ACCESS Sja1000Memory;

/// \name Bit timing in C: \a clock of the crystal in Hz, \a baud in bit/s, and the number of quanta in a bit, 8…10 or
/// 14…19
/// \{

/// Initialises a CO_CAN_SJA1000_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_SJA1000_RATE_OF(clock, baud, quanta)                           \
  {                                                                           \
    (baud) * CO_REQUIRED(CO_CAN_SJA1000_RATE_FITS(clock, baud, quanta)),      \
        CO_CAN_SJA1000_TIMING(clock, baud, quanta, CO_SJA1000_BTR0_SJW_SHIFT) \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_SJA1000_RATE_FITS(clock, baud, quanta) CO_CAN_SJA1000_FITS(clock, baud, quanta, 64)
/// \}

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_SJA1000_T {
  const CO_SJA1000_ACCESS* Access;   ///< access to the registers
  void* AccessCtx;                   ///< its context
  const CO_CAN_SJA1000_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                   ///< length of that array
  uint8_t OutputControl;             ///< value of OCR; 0: 1Ah: TX0 drives both levels, TX1 floats
  uint8_t ClockDivider;              ///< value of CDR; 0: C8h: PeliCAN mode, input RX0 only, CLKOUT off
  CO_IF_FRM* Frames;  ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;  ///< length of that array, 1…32767
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  /// Self-test: the controller receives its own frames, which need no acknowledgement. It stays connected to the bus
  /// and needs the transceiver, or a connection from TX0 to RX0.
  bool Loopback;

  /// \cond internal
  CO_RING Received;
  const CO_CAN_SJA1000_RATE* Rate;  // null: off the bus
  CO_SJA1000_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  CO_SJA1000_STATE State;
  /// \endcond
} CO_CAN_SJA1000;

/// The driver; its context is a CO_CAN_SJA1000.
extern const CO_IF_CAN_DRV_EX Sja1000CanDriver;

/// Moves received frames into the queue, stores events and refills the transmit buffer. Call it in the interrupt of the
/// controller, which may be triggered by level or edge, and may be shared.
void COCanSja1000Interrupt(CO_CAN_SJA1000* can);

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanSja1000HasFrames(const CO_CAN_SJA1000* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO was full (each overrun of the FIFO counts as one).
uint32_t COCanSja1000Lost(const CO_CAN_SJA1000* can);

/// Returns the error counters of the controller. In bus-off the transmit error counter counts down from 127 during the
/// recovery.
CO_CAN_ERROR_COUNTERS COCanSja1000Errors(const CO_CAN_SJA1000* can);

#ifdef __cplusplus
}
#endif

#endif
