// SPDX-License-Identifier: Apache-2.0
/// \file co_if_timer.h
/// The functions that a timer driver has to provide.
#ifndef CO_IF_TIMER_H_
#define CO_IF_TIMER_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A timer driver with context argument and a free-running clock (CO_NODE_EXT.Timer). Timers neither drift nor expire
/// early, however late the driver is called.
typedef struct CO_IF_TIMER_DRV_EX_T {
  void (*Init)(void* ctx, uint32_t freq);  ///< \a freq: ticks per second; called once
  uint32_t (*Now)(void* ctx);              ///< returns the clock in ticks: any start value, wraps at 2^32
  /// Requests a call of COTmrService() \a ticks after now; 0: none. Replaces the previous request. May be null where
  /// the loop polls CONodeNextDeadline().
  void (*Alarm)(void* ctx, uint32_t ticks);
} CO_IF_TIMER_DRV_EX;

/// \name As in CANopen-Stack
/// \{

/// A classic timer driver (without context). It is one of two kinds:
/// - cyclic: a periodic interrupt calls COTmrService(); Reload stores a count-down, Update decrements it and returns 1
///   at its end;
/// - tickless ("delta"): Reload programs a compare match, whose interrupt calls COTmrService(); Update returns 1
///   once for each expiry, otherwise 0.
///
/// COTmrService() has to be called in the interrupt, because a driver without a clock cannot report how late the call
/// is. Reload and Stop discard a pending expiry. A Reload that follows an Update that returned 1 should count from the
/// moment of that expiry, so that cyclic timers do not drift; any other Reload counts from the moment of the call. All
/// functions but Update are called in the loop context with COTmrLock() held, or in COTmrService().
typedef struct CO_IF_TIMER_DRV_T {
  void (*Init)(uint32_t freq);  ///< \a freq: ticks per second; called once
  /// Sets the expiry \a ticks after now: 1…UINT32_MAX; a narrower counter counts them in several parts. The stack
  /// programs UINT32_MAX while the loop has missed an expiry of a cyclic timer: Delay() then shows how late it is.
  void (*Reload)(uint32_t ticks);
  uint32_t (*Delay)(void);  ///< returns the ticks left; 0: elapsed
  void (*Stop)(void);       ///< stops the timer: no expiry is needed
  void (*Start)(void);      ///< starts the timer after a Stop; called directly after Reload
  uint8_t (*Update)(void);  ///< called by COTmrService(): returns 1 if the time has elapsed
} CO_IF_TIMER_DRV;
/// \}

#ifdef __cplusplus
}
#endif

#endif
