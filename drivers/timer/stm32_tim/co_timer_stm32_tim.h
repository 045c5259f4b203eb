// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_stm32_tim.h
/// Timer driver for the general-purpose timers of STM32 (TIM2 to TIM5, and others with their registers), 16 or 32 bits:
/// interrupts only when a timer is due (docs/drivers/stm32_tim.md). C and C++, bare metal. Tested on a register model,
/// not on silicon.
///
///     static CO_STM32_TIM timer = {.Regs = CO_STM32_TIM2, .Hz = 84000000, .Bits = 32};  // clock of the timer
///     spec.TmrFreq = 1000000;                                                           // Hz is a multiple of it
///     ext.Timer = &Stm32TimDriver;  ext.TimerCtx = &timer;                              // CO_NODE_EXT
///     void TIM2_IRQHandler(void) { COStm32TimInterrupt(&timer); COTmrService(&node.Tmr); }
///
/// The application enables the clock of the timer (RCC) before CONodeInitEx() and its interrupt (NVIC) after it. The
/// driver uses the counter and compare channel 1, and no pin. The application may use the other channels, with the
/// prescaler and the range of the counter that the driver has set.
///
/// An alarm is never early, and late only by the latency of the interrupt: the counter runs freely, and no time is
/// lost. A counter of 16 bits also interrupts each time it wraps. If an alarm is farther away than half of the range,
/// the timer interrupts after each half of the range. Interrupts must not be disabled for as long as the range: 65 ms
/// for 16 bits at 1 MHz.
///
/// Contexts: COStm32TimInterrupt() in the interrupt of the timer, which no other interrupt that uses the node may
/// preempt; the other functions in the loop and in COTmrService(). Owner: the caller; must outlive the node.
#ifndef CO_TIMER_STM32_TIM_H_
#define CO_TIMER_STM32_TIM_H_

#include "../tickless/co_cycle_clock.h"
#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Registers of a timer that the driver uses. Source: RM0390 (STM32F446), 17.4; RM0402 (STM32F412), 17.4; equal in
/// RM0008 (F1), RM0440 (G4), RM0399 (H7).
typedef struct CO_STM32_TIM_REGS_T {
  volatile uint32_t Cr1;    ///< 00h, control
  uint32_t Reserved1[2];    ///< 04h, CR2, SMCR
  volatile uint32_t Dier;   ///< 0Ch, interrupts
  volatile uint32_t Sr;     ///< 10h, status; a bit is cleared by writing 0
  volatile uint32_t Egr;    ///< 14h, events
  volatile uint32_t Ccmr1;  ///< 18h, modes of channels 1 and 2
  uint32_t Reserved2[2];    ///< 1Ch, CCMR2, CCER
  volatile uint32_t Cnt;    ///< 24h, counter
  volatile uint32_t Psc;    ///< 28h, prescaler - 1
  volatile uint32_t Arr;    ///< 2Ch, last value of the counter
  uint32_t Reserved3;       ///< 30h
  volatile uint32_t Ccr1;   ///< 34h, compare value of channel 1
} CO_STM32_TIM_REGS;

#define CO_STM32_TIM2 ((CO_STM32_TIM_REGS*)0x40000000u)  ///< 32 bits (STM32F1: 16 bits)
#define CO_STM32_TIM3 ((CO_STM32_TIM_REGS*)0x40000400u)  ///< 16 bits
#define CO_STM32_TIM4 ((CO_STM32_TIM_REGS*)0x40000800u)  ///< 16 bits
#define CO_STM32_TIM5 ((CO_STM32_TIM_REGS*)0x40000C00u)  ///< 32 bits (STM32F1: 16 bits)

/// State of the timer. The caller sets the first three members; the driver owns the others.
typedef struct CO_STM32_TIM_T {
  CO_STM32_TIM_REGS* Regs;  ///< CO_STM32_TIM2, or the address of another timer
  uint32_t Hz;              ///< frequency of the timer's input clock, a multiple of CO_NODE_SPEC.TmrFreq
  uint32_t Bits;            ///< 16 or 32
  CO_CYCLE_CLOCK Clock;     ///< clock in ticks, updated whenever an alarm is set
  uint32_t Begin;           ///< count at the last wrap of the counter, modulo 2^32
  uint32_t Changes;         ///< number of changes of Clock and Begin, by which a reader detects a change
} CO_STM32_TIM;

/// Updates the clock and clears the flags of the timer. Call it in the interrupt of the timer, before COTmrService().
void COStm32TimInterrupt(CO_STM32_TIM* timer);

/// The driver; its context is a CO_STM32_TIM.
extern const CO_IF_TIMER_DRV_EX Stm32TimDriver;

#ifdef __cplusplus
}
#endif

#endif
