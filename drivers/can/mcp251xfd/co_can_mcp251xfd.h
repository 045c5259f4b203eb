// SPDX-License-Identifier: Apache-2.0
/// \file co_can_mcp251xfd.h
/// Driver for the CAN FD controllers MCP2517FD and MCP2518FD behind SPI (docs/drivers/mcp251xfd.md). What it has in
/// common with other drivers is in co_can_controller.h. Tested on a register model, not on silicon.
///
///     static const CO_CAN_MCP251XFD_RATE rates[] = {CO_CAN_MCP251XFD_RATE_OF(40000000, 500000, 80)};
///     static CO_IF_FRM frames[32];
///     static const CO_CAN_SPI spi = {BoardSelect, BoardTransfer, BoardHasInterrupt};
///     static CO_CAN_MCP251XFD can = {.Spi = &spi, .Rates = rates, .RateNum = 1, .Frames = frames, .FrameNum = 32};
///     ext.Can = &Mcp251xfdCanDriver;  ext.CanCtx = &can;               // CO_NODE_EXT
///     void EXTI0_IRQHandler(void) { ...  COCanMcp251xfdInterrupt(&can); }  // falling edge of INT
///
/// The board must initialise SPI (mode 0,0, at most 0.85 * SYSCLK / 2; with CO_CAN_MCP251XFD_PLL at most 1.7 MHz) and
/// the pins before CONodeInit(). If the controller does not answer, Send returns -1.
///
/// SPI. The loop and the interrupt use SPI without a lock: while a function of the driver uses it, the interrupt only
/// leaves a note, and that function does the work of the interrupt at its end. Controllers on one SPI bus, also
/// MCP2515, share a CO_CAN_SPI_BUS. An application that has other devices on the bus calls COCanMcp251xfdHold() before
/// and COCanMcp251xfdRelease() after it uses SPI. The interrupt is optional: without it, Read does its work.
///
/// 31 filters pass the identifiers that the node receives, or some more frames, which the node ignores. They change on
/// the bus without a loss.
///
/// CAN FD. The driver sends classic frames only. CAN FD frames of other nodes are received and discarded, so that they
/// are not destroyed by error frames: without bit rate switching always, with it if DataTiming is set.
///
/// Context: the loop, and interrupts on the same CPU that call COCanMcp251xfdInterrupt(); they may interrupt each
/// other. All controllers on one SPI bus are used in the same loop. Owner: the bus is the caller's, too.
#ifndef CO_CAN_MCP251XFD_H_
#define CO_CAN_MCP251XFD_H_

#include "../co_can_controller.h"
#include "../co_can_spi.h"
#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A bit rate and the value of the register C1NBTCFG for it.
typedef struct CO_CAN_MCP251XFD_RATE_T {
  uint32_t Baud;    ///< bit/s
  uint32_t Timing;  ///< prescaler and segments, as in the register
} CO_CAN_MCP251XFD_RATE;

/// Value of the registers C1NBTCFG and C1DBTCFG; lengths in quanta.
#define CO_CAN_MCP251XFD_TIMING(prescaler, segment1, segment2, jump)                                           \
  ((((uint32_t)(prescaler)-1u) << 24) | (((uint32_t)(segment1)-1u) << 16) | (((uint32_t)(segment2)-1u) << 8) | \
   ((uint32_t)(jump)-1u))

/// \name Bit timing in C: \a clock SYSCLK in Hz, \a baud in bit/s, and the number of quanta in a bit: 14…256, from 800
/// kbit/s on also 8…10
/// \{

/// Initialises a CO_CAN_MCP251XFD_RATE; the sample point is as near to 87.5 % as these quanta allow.
/// Does not compile if the macro …_FITS() for the same values is false, or no constant.
#define CO_CAN_MCP251XFD_RATE_OF(clock, baud, quanta)                                                            \
  {                                                                                                              \
    (baud) * CO_REQUIRED(CO_CAN_MCP251XFD_RATE_FITS(clock, baud, quanta)),                                       \
        CO_CAN_MCP251XFD_TIMING((clock) / ((baud) * (quanta)), CO_CAN_SEGMENT1(quanta), CO_CAN_SEGMENT2(quanta), \
                                CO_CAN_SEGMENT2(quanta))                                                         \
  }
/// True if this timing is exact, its sample point is allowed by CiA 301, and the controller supports it.
#define CO_CAN_MCP251XFD_RATE_FITS(clock, baud, quanta) \
  (CO_CAN_QUANTA_FIT(quanta, 256) && CO_CAN_IS_EXACT(clock, baud, quanta, 256))
/// \}

/// \name CO_CAN_MCP251XFD.Clock; 0: SYSCLK is the crystal, CLKO has its frequency
/// \{
#define CO_CAN_MCP251XFD_PLL 0x01u             ///< SYSCLK is ten times the crystal of 4 MHz
#define CO_CAN_MCP251XFD_HALF 0x10u            ///< SYSCLK is half of that
#define CO_CAN_MCP251XFD_OUTPUT(n) ((n) << 5)  ///< CLKO: 0…3: SYSCLK divided by 1, 2, 4, 10
/// \}

/// \cond internal
#define CO_MCP251XFD_QUEUE 6

// Frames in the transmit queue, for transmit.hpp. Those that the controller has discarded in bus-off are displaced.
typedef struct CO_MCP251XFD_TRANSMIT_T {
  CO_IF_FRM Frame[CO_MCP251XFD_QUEUE];
  CO_IF_FRM Displaced[CO_MCP251XFD_QUEUE];
  uint8_t DisplacedNum;
  uint8_t Used;
  uint8_t Dropped;
  uint8_t Aborting;
} CO_MCP251XFD_TRANSMIT;
/// \endcond

/// A controller. Initialise it with zero, then set the members up to Loopback; the driver owns the others.
typedef struct CO_CAN_MCP251XFD_T {
  const CO_CAN_SPI* Spi;               ///< access to the controller
  void* SpiCtx;                        ///< its context
  CO_CAN_SPI_BUS* Bus;                 ///< null: no other device is on the SPI bus
  const CO_CAN_MCP251XFD_RATE* Rates;  ///< must live as long as the node
  uint8_t RateNum;                     ///< length of that array
  uint8_t Clock;                       ///< lowest byte of the register OSC
  CO_IF_FRM* Frames;    ///< queue between interrupt and loop: enough for the frames that arrive while the loop is busy
  uint16_t FrameNum;    ///< length of that array, 1…32767
  uint32_t DataTiming;  ///< value of the register C1DBTCFG for CAN FD frames of other nodes; 0: unknown
  CO_CAN_RECOVERY Recovery;  ///< reaction to bus-off
  bool Loopback;             ///< self-test: the controller receives its own frames, and no others; it is off the bus

  /// \cond internal
  CO_RING Received;
  const CO_CAN_MCP251XFD_RATE* Rate;  // null: off the bus
  CO_MCP251XFD_TRANSMIT Transmit;
  CO_CAN_REPORT Report;
  CO_CAN_SPI_USER User;
  uint8_t Errors;        // last error state of C1TREC: passive and bus-off
  uint8_t IsUnfinished;  // Read has to do more work
  uint8_t IsBusOff;      // the controller stays in Configuration mode until Reset or Enable
  uint8_t IsJoining;     // the controller has not been seen on the bus yet
  uint8_t IsDelayed;     // the frame in the queue has lost the arbitration
  /// \endcond
} CO_CAN_MCP251XFD;

/// The driver; its context is a CO_CAN_MCP251XFD.
extern const CO_IF_CAN_DRV_EX Mcp251xfdCanDriver;

/// Moves received frames into the queue and stores events; while SPI is in use, leaves a note to the function that uses
/// it. Call it in an interrupt at the falling edge of INT.
void COCanMcp251xfdInterrupt(CO_CAN_MCP251XFD* can);

/// Reserves SPI for the application: the interrupt functions of all controllers on \a bus do not use it until
/// COCanMcp251xfdRelease(). Calls may be nested. The driver must not be called meanwhile. Context: the loop.
void COCanMcp251xfdHold(CO_CAN_SPI_BUS* bus);

/// Ends COCanMcp251xfdHold(), and does what the interrupts would have done meanwhile. Context: the loop.
void COCanMcp251xfdRelease(CO_CAN_SPI_BUS* bus);

/// Returns true if received frames wait until they are read; a loop checks it before it sleeps.
bool COCanMcp251xfdHasFrames(const CO_CAN_MCP251XFD* can);

/// Returns the number of received frames lost since Enable or a reset: because the queue was full, or because the
/// receive FIFO of 32 frames was full (each overflow that the controller reports counts as one).
uint32_t COCanMcp251xfdLost(const CO_CAN_MCP251XFD* can);

/// Returns the error counters of the controller. Context: the loop.
CO_CAN_ERROR_COUNTERS COCanMcp251xfdErrors(CO_CAN_MCP251XFD* can);

#ifdef __cplusplus
}
#endif

#endif
