// SPDX-License-Identifier: Apache-2.0
/// \file co_if_timer.h
/// What a timer driver has to supply.
#ifndef CO_IF_TIMER_H_
#define CO_IF_TIMER_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A timer driver without context. Cyclic: a periodic interrupt calls COTmrService(); Reload stores a count-down,
/// Update decrements it and returns 1 at its end. Tickless ("delta"): Reload programs a compare match, whose interrupt
/// calls COTmrService(); Update returns 1.
/// COTmrService() belongs into the interrupt: a driver without a clock cannot tell how late it comes. Reload and Stop
/// discard an expiry that is pending.
/// A Reload that follows an Update of 1 should count from the moment that has just elapsed, so that cyclic timers do
/// not drift; any other Reload counts from now.
/// All but Update run in the loop context with COTmrLock() held, or in COTmrService().
typedef struct CO_IF_TIMER_DRV_T {
  void (*Init)(uint32_t freq);  ///< ticks per second; called once
  /// Elapse \a ticks from now: 1 … UINT32_MAX, which a narrower counter counts in parts. UINT32_MAX is programmed while
  /// the loop has yet to run an elapsed cyclic timer: Delay() then tells how late the loop is.
  void (*Reload)(uint32_t ticks);
  uint32_t (*Delay)(void);  ///< ticks left, 0: elapsed
  void (*Stop)(void);       ///< nothing to wait for
  void (*Start)(void);      ///< after a Stop, directly after Reload
  uint8_t (*Update)(void);  ///< called by COTmrService(): 1 if the time has elapsed
} CO_IF_TIMER_DRV;

/// A timer driver with a context and a free running clock (CO_NODE_EXT): no drift, no early expiry, whatever the
/// delays.
typedef struct CO_IF_TIMER_DRV_EX_T {
  void (*Init)(void* ctx, uint32_t freq);  ///< ticks per second; called once
  uint32_t (*Now)(void* ctx);              ///< the clock in ticks, starting anywhere, wrapping at 2^32
  /// May be null where the loop asks CONodeNextDeadline(). Let COTmrService() be called \a ticks after now, 0: never.
  /// Replaces the alarm set before.
  void (*Alarm)(void* ctx, uint32_t ticks);
} CO_IF_TIMER_DRV_EX;

#ifdef __cplusplus
}
#endif

#endif
