// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_systick.h
/// Timer driver for SysTick, the timer of every Cortex-M3, M4, M7 and M33 and most M0 and M0+: interrupts only when a
/// timer is due. C and C++, bare metal.
///
///     static CO_SYSTICK timer = {CO_SYSTICK_REGISTERS, CO_SYSTICK_CONTROL, 48000000};   // Hz
///     spec.TmrFreq = 1000000;                                                           // Hz is a multiple of it
///     ext.Timer = &SysTickDriver;  ext.TimerCtx = &timer;                               // CO_NODE_EXT
///     void SysTick_Handler(void) { COSysTickInterrupt(&timer); COTmrService(&node.Tmr); }
///
/// SysTick counts down 24 bits of the CPU's clock and has no compare register, so each alarm restarts it. Init measures
/// the duration of a restart, and the driver adds it to the clock. The remaining error is a cycle or two for each
/// alarm. If that is too much over the years, or if SysTick stops while the CPU sleeps, use a timer of the chip. An
/// alarm beyond the range of SysTick is reached in steps of 2^24 cycles, each an interrupt; without an alarm the steps
/// continue, because the clock must not stop. Interrupts may be disabled for at most half of a step.
///
/// An alarm is never early; it is late by the CPU cycles needed to set it.
/// Contexts: COSysTickInterrupt() in SysTick's interrupt, which no other interrupt that uses the node may interrupt;
/// the other functions in the loop and in COTmrService(). Owner: the caller; must outlive the node.
#ifndef CO_TIMER_SYSTICK_H_
#define CO_TIMER_SYSTICK_H_

#include "co_cycle_clock.h"
#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// SysTick's registers.
typedef struct CO_SYSTICK_REGS_T {
  volatile uint32_t Control;  ///< SYST_CSR
  volatile uint32_t Reload;   ///< SYST_RVR
  volatile uint32_t Value;    ///< SYST_CVR
} CO_SYSTICK_REGS;

#define CO_SYSTICK_REGISTERS ((CO_SYSTICK_REGS*)0xE000E010u)  ///< SYST_CSR and the registers behind it
#define CO_SYSTICK_CONTROL ((volatile uint32_t*)0xE000ED04u)  ///< ICSR: has the flag of a pending SysTick interrupt

/// State of the timer. The caller sets the first three members; the driver owns the others.
typedef struct CO_SYSTICK_T {
  CO_SYSTICK_REGS* Regs;    ///< CO_SYSTICK_REGISTERS; a test may use a model
  volatile uint32_t* Icsr;  ///< CO_SYSTICK_CONTROL
  uint32_t Hz;              ///< frequency of the CPU's clock
  CO_CYCLE_CLOCK Clock;     ///< ticks, updated whenever an alarm is set
  uint32_t Begin;           ///< cycle at which the current count-down has begun
  uint32_t Slice;           ///< length of the current count-down, cycles; the next one has 2^24
  uint32_t Start;           ///< cycles that pass while SysTick is restarted
  uint32_t Changes;         ///< number of changes of the members above, by which a reader detects one
} CO_SYSTICK;

/// Adds the count-down that has ended to the clock. Call it in the interrupt of SysTick, before COTmrService().
void COSysTickInterrupt(CO_SYSTICK* timer);

/// The driver; its context is a CO_SYSTICK.
extern const CO_IF_TIMER_DRV_EX SysTickDriver;

#ifdef __cplusplus
}
#endif

#endif
