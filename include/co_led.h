// SPDX-License-Identifier: Apache-2.0
/// \file co_led.h
/// The status LEDs of CiA 303-3: RUN (green) and ERR (red), as two bits. Exists with USE_LED.
///
/// The node shows its NMT state, the LSS state configuration, that it waits for a node-ID, what the CAN controller
/// reports, missing heartbeats and life guarding, SYNC messages of a wrong length and RPDOs that come too late. The
/// application adds what only it can know (COLedSet()).
///
/// Context: the loop.
#ifndef CO_LED_H_
#define CO_LED_H_

#include "co_needs.h"
#include "co_nmt.h"
#include "co_tmr.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name The LEDs
/// Of a bicoloured LED, ERR is shown before RUN.
/// \{
#define CO_LED_RUN 0x01u  ///< green
#define CO_LED_ERR 0x02u  ///< red
/// \}

/// \name What there is to be shown besides the NMT state
/// \{
#define CO_LED_BUS_OFF 0x01u   ///< ERR on
#define CO_LED_LSS 0x02u       ///< LSS, or the bit rate is being detected: both flicker
#define CO_LED_PDO 0x04u       ///< an RPDO is late: ERR quadruple flash
#define CO_LED_SYNC 0x08u      ///< SYNC error: ERR triple flash
#define CO_LED_CONTROL 0x10u   ///< error control, a guard or heartbeat event: ERR double flash
#define CO_LED_WARNING 0x20u   ///< the warning limit of the CAN controller: ERR single flash
#define CO_LED_CONFIG 0x40u    ///< wrong configuration: ERR blinks
#define CO_LED_DOWNLOAD 0x80u  ///< a program is being downloaded: RUN triple flash
/// \}

struct CO_NODE_T;

/// All that the LEDs depend on.
typedef struct CO_LED_STATE_T {
  CO_MODE Mode;
  uint8_t What;  ///< CO_LED_BUS_OFF … CO_LED_DOWNLOAD
} CO_LED_STATE;

/// The application touches nothing of it.
typedef struct CO_LED_T {
  CO_TMR_MEM Tmr;
  uint16_t Control;  ///< nodes that are missing
  uint16_t Pdo;      ///< RPDOs that are late
  uint16_t Sync;     ///< faults of SYNC
  uint16_t Phase;    ///< ms
  uint8_t Can;       ///< of the controller: CO_LED_BUS_OFF, CO_LED_WARNING
  uint8_t Set;       ///< by the application
  uint8_t Shown;     ///< LEDs that are lit
  uint8_t On;        ///< COLedStart() was called
} CO_LED;

/// The LEDs at a moment: CO_LED_RUN and CO_LED_ERR where they are lit. 0 if \a state is null.
/// \a ms: time since any moment that stays the same. Blinking: 200 ms on, 200 ms off; flickering: 50 ms each; n
/// flashes: n times 200 ms on with 200 ms between them, then 1000 ms off. Red lags behind green by a phase: where both
/// blink, they are never lit together. Of several things the one shown is the first in this order:
///   - RUN: LSS, download; then the NMT state: Stopped single flash, Pre-operational blinking, Operational on, else
///   off.
///   - ERR: bus-off, LSS, RPDO, SYNC, error control, warning limit, configuration; else off.
uint8_t COLedPattern(const CO_LED_STATE* state, uint32_t ms) CO_NEEDS(USE_LED);

/// Lets the node run its LEDs from now on until CONodeStop(), which switches them off: COLedChange() is called at once
/// and with every change. Needs a timer of the stack (every 50 ms) while an LED blinks or flashes, none while both are
/// steady. In CO_INVALID nothing happens.
void COLedStart(struct CO_NODE_T* node) CO_NEEDS(USE_LED);

/// The application says that \a what (one or several of CO_LED_BUS_OFF … CO_LED_DOWNLOAD) is the case, or no more.
/// It holds through NMT resets, and beside what the node finds out by itself.
void COLedSet(struct CO_NODE_T* node, uint8_t what, bool on) CO_NEEDS(USE_LED);

/// \name Callback of the application (see co_nmt.h)
/// \{

/// An LED goes on or off. \a leds: CO_LED_RUN and CO_LED_ERR, those that are lit from now on.
void COLedChange(struct CO_NODE_T* node, uint8_t leds);
/// \}

#ifdef __cplusplus
}
#endif

#endif
