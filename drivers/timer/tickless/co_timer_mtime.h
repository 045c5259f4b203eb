// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_mtime.h
/// Timer driver for the machine timer of RISC-V (mtime and mtimecmp): interrupts only when a timer is due. C and C++,
/// bare metal, 32 and 64 bits.
///
///     static CO_MTIME timer = {(volatile uint32_t*)0x0200BFF8, (volatile uint32_t*)0x02004000, 10000000};   // Hz
///     spec.TmrFreq = 1000000;                                                           // Hz is a multiple of it
///     ext.Timer = &MtimeDriver;  ext.TimerCtx = &timer;                                 // CO_NODE_EXT
///     machine timer interrupt: COTmrService(&node.Tmr);
///
/// An alarm further away than 2^31 cycles is reached in steps of 2^31 cycles, each an interrupt; without an alarm the
/// steps continue, because the tick count is updated in them.
///
/// An alarm is never early. Contexts: the loop, and COTmrService() in the machine timer interrupt. Owner: the caller;
/// must outlive the node.
#ifndef CO_TIMER_MTIME_H_
#define CO_TIMER_MTIME_H_

#include "co_cycle_clock.h"
#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// State of the timer. The caller sets the first three members; the driver owns the others.
typedef struct CO_MTIME_T {
  volatile uint32_t* Time;     ///< mtime: two words, the low one first
  volatile uint32_t* Compare;  ///< mtimecmp of the hart: two words, the low one first
  uint32_t Hz;                 ///< frequency of mtime
  CO_CYCLE_CLOCK Clock;        ///< ticks, updated whenever an alarm is set
  uint32_t Changes;            ///< number of changes of Clock, by which a reader detects one during its reading
} CO_MTIME;

/// The driver; its context is a CO_MTIME.
extern const CO_IF_TIMER_DRV_EX MtimeDriver;

#ifdef __cplusplus
}
#endif

#endif
