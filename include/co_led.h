// SPDX-License-Identifier: Apache-2.0
/// \file co_led.h
/// The status LEDs of CiA 303-3: RUN (green) and ERR (red), as two bits (USE_LED).
///
/// The node shows its NMT state, the LSS state configuration, a missing node-ID, events of the CAN controller, missing
/// heartbeats and life guarding, SYNC messages with wrong length and late RPDOs. The application adds further
/// conditions (COLedSet()).
///
/// Context: the loop.
#ifndef CO_LED_H_
#define CO_LED_H_

#include "co_nmt.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name The LEDs
/// A bicoloured LED shows ERR with priority over RUN.
/// \{
#define CO_LED_RUN 0x01u  ///< green
#define CO_LED_ERR 0x02u  ///< red
/// \}

/// \name Conditions shown in addition to the NMT state
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

/// Conditions that determine the LEDs.
typedef struct CO_LED_STATE_T {
  CO_MODE Mode;  ///< NMT state of the node
  uint8_t What;  ///< bits CO_LED_BUS_OFF … CO_LED_DOWNLOAD
} CO_LED_STATE;

/// LEDs of a node. The application must not access the members.
typedef struct CO_LED_T {
  CO_TMR_MEM Tmr;    ///< advances Phase; active while an LED blinks or flashes
  uint16_t Control;  ///< number of missing nodes
  uint16_t Pdo;      ///< number of late RPDOs
  uint16_t Sync;     ///< number of faults of SYNC
  uint16_t Phase;    ///< phase of the pattern in ms
  uint8_t Can;       ///< state of the controller: CO_LED_BUS_OFF, CO_LED_WARNING
  uint8_t Set;       ///< conditions set by the application
  uint8_t Shown;     ///< lit LEDs
  uint8_t On;        ///< COLedStart() was called
} CO_LED;

/// Returns the LEDs that are lit at a moment, CO_LED_RUN and CO_LED_ERR; 0 if \a state is null. \a ms: time in ms since
/// a fixed moment. Blinking: 200 ms on, 200 ms off; flickering: 50 ms each; n flashes: n times 200 ms on with 200 ms
/// between them, then 1000 ms off. Red is delayed by one phase: if both LEDs blink, they are never lit together. If
/// several conditions apply, the first in this order is shown:
///   - RUN: LSS, download; then the NMT state: Stopped single flash, Pre-operational blinking, Operational on, else
///   off.
///   - ERR: bus-off, LSS, RPDO, SYNC, error control, warning limit, configuration; else off.
uint8_t COLedPattern(const CO_LED_STATE* state, uint32_t ms) CO_NEEDS(USE_LED);

/// Starts the LEDs, until CONodeStop() switches them off: COLedChange() is called at once and with every change. Uses a
/// timer of the stack (every 50 ms) while an LED blinks or flashes. Has no effect in CO_INVALID.
void COLedStart(struct CO_NODE_T* node) CO_NEEDS(USE_LED);

/// Sets (\a on true) or clears conditions of the application. \a what: one or several of CO_LED_BUS_OFF …
/// CO_LED_DOWNLOAD. They remain through NMT resets and are combined with the conditions that the node detects.
void COLedSet(struct CO_NODE_T* node, uint8_t what, bool on) CO_NEEDS(USE_LED);

/// \name Callback of the application (see co_nmt.h)
/// \{

/// Called when an LED is switched on or off. \a leds: the LEDs that are lit, CO_LED_RUN and CO_LED_ERR.
void COLedChange(struct CO_NODE_T* node, uint8_t leds);
/// \}

#ifdef __cplusplus
}
#endif

#endif
