// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_software.h
/// Timer driver without hardware: counts the calls of a periodic interrupt (or loop) that the application already has.
/// The simplest timer on a microcontroller; C and C++, bare metal.
///
///     CO_IF_DRV drivers = { &MyCanDriver, &SoftwareTimerDriver, &MyNvmDriver };
///     spec.TmrFreq = 1000;                                   // the interrupt occurs 1000 times per second
///     void SysTick_Handler(void) { COTmrService(&node.Tmr); }
///
/// Each call of COTmrService() is one tick, so CO_NODE_SPEC.TmrFreq must be the frequency of these calls; Init ignores
/// it. Cyclic timers do not drift: a new count-down begins on the tick on which the last one has ended.
///
/// Contexts: Update in the interrupt (through COTmrService()); the other functions in the loop with COTmrLock() held,
/// which must disable this interrupt.
/// Owner: the driver has one global state, for one node. For several nodes use CO_IF_TIMER_DRV_EX.
#ifndef CO_TIMER_SOFTWARE_H_
#define CO_TIMER_SOFTWARE_H_

#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The driver, for CO_IF_DRV.Timer.
extern const CO_IF_TIMER_DRV SoftwareTimerDriver;

#ifdef __cplusplus
}
#endif

#endif
