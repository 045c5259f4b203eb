// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_systick.h
/// The timer that every Cortex-M3, M4, M7 and M33 and most M0 and M0+ have, SysTick, as a clock that interrupts only
/// when something is due. C and C++, bare metal.
///
///     static CO_SYSTICK timer = {CO_SYSTICK_REGISTERS, CO_SYSTICK_CONTROL, 48000000};   // Hz
///     spec.TmrFreq = 1000000;                                                           // Hz is a multiple of it
///     ext.Timer = &SysTickDriver;  ext.TimerCtx = &timer;                               // CO_NODE_EXT
///     void SysTick_Handler(void) { COSysTickInterrupt(&timer); COTmrService(&node.Tmr); }
///
/// SysTick counts 24 bits of the CPU's clock down and has no compare register, so each alarm starts it anew; what the
/// start itself takes is measured at Init and put on the clock. What remains is a cycle or two for each alarm. Where
/// that is too much over the years, or where SysTick stands still while the CPU sleeps, take a timer of the chip.
/// An alarm that is further away than SysTick counts is reached in steps of 2^24 cycles, each an interrupt; so is the
/// time in which no alarm is set, as the clock must not stop. Interrupts may be kept away for half of that.
///
/// An alarm is never early, and late by the CPU cycles that setting it has taken.
/// Contexts: COSysTickInterrupt() in SysTick's interrupt, which no other one that uses the node may interrupt; the rest
/// in the loop and in COTmrService(). Owner: the caller; must outlive the node.
#ifndef CO_TIMER_SYSTICK_H_
#define CO_TIMER_SYSTICK_H_

#include "co_cycle_clock.h"
#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// SysTick's registers.
typedef struct CO_SYSTICK_REGS_T {
  volatile uint32_t Control;
  volatile uint32_t Reload;
  volatile uint32_t Value;
} CO_SYSTICK_REGS;

#define CO_SYSTICK_REGISTERS ((CO_SYSTICK_REGS*)0xE000E010u)
#define CO_SYSTICK_CONTROL ((volatile uint32_t*)0xE000ED04u)  ///< ICSR, which tells whether its interrupt is pending

/// The first three members are the caller's, the others the driver's.
typedef struct CO_SYSTICK_T {
  CO_SYSTICK_REGS* Regs;
  volatile uint32_t* Icsr;
  uint32_t Hz;  ///< of the CPU's clock
  CO_CYCLE_CLOCK Clock;
  uint32_t Begin;  // of the present slice, in cycles
  uint32_t Slice;  // its cycles; the next one has 2^24
  uint32_t Start;  // cycles that pass while SysTick is started anew
  uint32_t Turn;   // changes with the members above
} CO_SYSTICK;

/// SysTick has come to the end of a slice. To be called in its interrupt, before COTmrService().
void COSysTickInterrupt(CO_SYSTICK* timer);

/// The driver; its context is a CO_SYSTICK.
extern const CO_IF_TIMER_DRV_EX SysTickDriver;

#ifdef __cplusplus
}
#endif

#endif
