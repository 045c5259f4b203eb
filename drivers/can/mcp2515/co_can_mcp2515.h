// SPDX-License-Identifier: Apache-2.0
/// \file co_can_mcp2515.h
/// Driver for the CAN controllers MCP2515 and MCP25625 behind SPI (docs/drivers/mcp2515.md). What it has in common with
/// other drivers is in co_can_controller.h. Tested on a register model, not on silicon.
///
///     static const CO_CAN_MCP2515_RATE rates[] = {CO_CAN_MCP2515_RATE_OF(16000000, 500000, 16)};
///     static CO_IF_FRM frames[32];
///     static const CO_CAN_SPI spi = {BoardSelect, BoardTransfer, BoardHasInterrupt};
///     static CO_CAN_MCP2515 can = {.Spi = &spi, .Rates = rates, .RateNum = 1, .Frames = frames, .FrameNum = 32};
///     ext.Can = &Mcp2515CanDriver;  ext.CanCtx = &can;               // CO_NODE_EXT
///     void EXTI0_IRQHandler(void) { ...  COCanMcp2515Interrupt(&can); }  // falling edge of INT
///
/// The board must initialise SPI (mode 0,0, at most 10 MHz) and the pins before CONodeInit(). If the controller does
/// not answer, Send returns -1.
///
/// SPI. The loop and the interrupt use SPI without a lock: while a function of the driver uses it, the interrupt only
/// leaves a note, and that function does the work of the interrupt at its end. Controllers on one SPI bus share a
/// CO_CAN_SPI_BUS. An application that has other devices on the bus calls COCanMcp2515Hold() before and
/// COCanMcp2515Release() after it uses SPI. The interrupt is optional: without it, Read does its work.
///
/// The driver computes the two masks and six filters from the identifiers that the node receives. Six identifiers pass
/// exactly; for more of them some more frames pass, which the node ignores. Filters can be written in Configuration
/// mode only: if a change on the bus adds an identifier that does not pass yet, the driver leaves the bus for a moment.
/// A frame of another node in this moment may be lost, and the error counters become 0.
///
/// In bus-off with recovery by application, the controller waits for 11 recessive bits only: let 128 times 11 bits pass
/// before the reset.
///
/// Context: the loop, and interrupts on the same CPU that call COCanMcp2515Interrupt(); they may interrupt each other.
/// All controllers on one SPI bus are used in the same loop. Owner: the bus is the caller's, too.
#ifndef CO_CAN_MCP2515_H_
#define CO_CAN_MCP2515_H_

#include "../co_can_controller.h"
#include "../co_can_spi.h"
#include "co_if_can.h"
#include "co_ring.h"
#include "mcp2515_registers.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit rate and the values of the registers for it.
typedef struct CO_CAN_MCP2515_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< bits 0…7: CNF3, 8…15: CNF2, 16…23: CNF1
} CO_CAN_MCP2515_RATE;

/// \cond internal
#define CO_CAN_MCP2515_SEGMENT2(quanta) ((quanta) < 20u ? 2u : ((quanta) + 4u) / 8u)
// Segment 1 is divided into the propagation segment and phase segment 1, which is not the longer one.
#define CO_CAN_MCP2515_TIMING(prescaler, segment1, segment2, jump)                                  \
  (((uint32_t)(segment2)-1u) |                                                                      \
   ((CO_MCP2515_CNF2_BTLMODE | (((uint32_t)(segment1) / 2u - 1u) << CO_MCP2515_CNF2_PHSEG1_SHIFT) | \
     ((uint32_t)(segment1) - (uint32_t)(segment1) / 2u - 1u))                                       \
    << 8) |                                                                                         \
   ((((uint32_t)(prescaler)-1u) | (((uint32_t)(jump)-1u) << CO_MCP2515_CNF1_SJW_SHIFT)) << 16))
/// \endcond

/// \name Bit timing in C: \a clock of the crystal in Hz, \a baud in bit/s, and the number of quanta in a bit: 14…20,
/// from 800 kbit/s on 8…20
/// \{

/// Initialises a CO_CAN_MCP2515_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_MCP2515_RATE_OF(clock, baud, quanta)                                                              \
  {                                                                                                              \
    (baud) * CO_REQUIRED(CO_CAN_MCP2515_RATE_FITS(clock, baud, quanta)),                                         \
        CO_CAN_MCP2515_TIMING((clock) / (2u * (baud) * (quanta)), (quanta)-1u - CO_CAN_MCP2515_SEGMENT2(quanta), \
                              CO_CAN_MCP2515_SEGMENT2(quanta), CO_CAN_MCP2515_SEGMENT2(quanta) - 1u)             \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_MCP2515_RATE_FITS(clock, baud, quanta)                                               \
  ((quanta) >= ((baud) >= 800000 ? 8 : 14) && (quanta) <= 20 && (clock) >= 2 * (baud) * (quanta) && \
   (clock) % (2 * (baud) * (quanta)) == 0 && (clock) / (2 * (baud) * (quanta)) <= 64)
/// \}

/// \cond internal
// Frames that wait for transmission, for transmit.hpp. An abort concerns all three buffers: more frames than those of
// CO_CAN_TRANSMIT can be displaced at once.
typedef struct CO_MCP2515_TRANSMIT_T {
  CO_IF_FRM Frame[CO_CAN_MAILBOXES];                         // copies of the frames in the buffers
  CO_IF_FRM Displaced[CO_CAN_DISPLACED + CO_CAN_MAILBOXES];  // frames that were taken from the buffers
  uint8_t DisplacedNum;
  uint8_t Used;
  uint8_t Dropped;
  uint8_t Aborting;
} CO_MCP2515_TRANSMIT;

// Masks and filters of the controller: Mask[0] is that of Word[0…1], Mask[1] that of Word[2…5].
typedef struct CO_MCP2515_ACCEPTANCE_T {
  uint32_t Mask[2];
  uint32_t Word[6];
} CO_MCP2515_ACCEPTANCE;
/// \endcond

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_MCP2515_T {
  const CO_CAN_SPI* Spi;             ///< access to the controller
  void* SpiCtx;                      ///< its context
  CO_CAN_SPI_BUS* Bus;               ///< null: no other device is on the SPI bus
  const CO_CAN_MCP2515_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                   ///< length of that array
  uint8_t ClockOutput;               ///< CLKOUT: 0: off; 4…7: crystal divided by 1, 2, 4, 8
  CO_IF_FRM* Frames;  ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;  ///< length of that array, 1…32767
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  bool Loopback;             ///< self-test: the controller receives its own frames, and no others; it is off the bus

  /// \cond internal
  CO_RING Received;
  const CO_CAN_MCP2515_RATE* Rate;  // null: off the bus
  CO_MCP2515_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  CO_CAN_SPI_USER User;
  CO_MCP2515_ACCEPTANCE Filters;
  uint8_t Priority[CO_CAN_MAILBOXES];  // TXBnCTRL.TXP
  uint8_t Flags;                       // last value of EFLG, without overflows
  uint8_t IsUnfinished;                // Read has to do more work
  uint8_t IsBusOff;                    // the controller stays in Configuration mode until Reset or Enable
  uint8_t IsAborting;                  // CANCTRL.ABAT is set
  uint8_t Enabled;                     // CANINTE
  uint8_t NeedsFilters;                // the filters are written after the recovery from bus-off
  /// \endcond
} CO_CAN_MCP2515;

/// The driver; its context is a CO_CAN_MCP2515.
extern const CO_IF_CAN_DRV_EX Mcp2515CanDriver;

/// Moves received frames into the queue, stores events and refills transmit buffers; while SPI is in use, leaves a note
/// to the function that uses it. Call it in an interrupt at the falling edge of INT.
void COCanMcp2515Interrupt(CO_CAN_MCP2515* can);

/// Reserves SPI for the application: COCanMcp2515Interrupt() of all controllers on \a bus does not use it until
/// COCanMcp2515Release(). Calls may be nested. The driver must not be called meanwhile. Context: the loop.
void COCanMcp2515Hold(CO_CAN_SPI_BUS* bus);

/// Ends COCanMcp2515Hold(), and does what the interrupts would have done meanwhile. Context: the loop.
void COCanMcp2515Release(CO_CAN_SPI_BUS* bus);

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanMcp2515HasFrames(const CO_CAN_MCP2515* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because a receive
/// buffer was full (each overflow that the controller reports counts as one).
uint32_t COCanMcp2515Lost(const CO_CAN_MCP2515* can);

/// Returns the error counters of the controller. Context: the loop.
CO_CAN_ERROR_COUNTERS COCanMcp2515Errors(CO_CAN_MCP2515* can);

#ifdef __cplusplus
}
#endif

#endif
