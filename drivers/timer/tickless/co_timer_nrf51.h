// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_nrf51.h
/// Timer driver for TIMER0 of the nRF51 (or a 32-bit TIMER of the nRF52), whose SysTick is missing or stops while the
/// CPU sleeps: a free-running clock with a compare register. C and C++, bare metal.
///
///     static CO_NRF51_TIMER timer = {(CO_NRF51_TIMER_REGS*)0x40008000};
///     spec.TmrFreq = 1000000;                                   // 16 MHz divided by a power of two, 31250 Hz at least
///     ext.Timer = &Nrf51TimerDriver;  ext.TimerCtx = &timer;    // CO_NODE_EXT
///     void TIMER0_IRQHandler(void) { COTmrService(&node.Tmr); }
///
/// Uses the compare registers 0 and 1. An alarm is never early; one that becomes due while it is being set is some
/// ticks late. Contexts: the loop, and COTmrService() in the interrupt. Owner: the caller; must outlive the node.
#ifndef CO_TIMER_NRF51_H_
#define CO_TIMER_NRF51_H_

#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Registers of a TIMER that the driver uses. Writing 1 to a task register starts the task.
typedef struct CO_NRF51_TIMER_REGS_T {
  volatile uint32_t Start;          ///< 000h, task: starts the timer
  volatile uint32_t Stop;           ///< 004h, task: stops the timer
  uint32_t Reserved1;               ///< 008h
  volatile uint32_t Clear;          ///< 00Ch, task: sets the timer to 0
  uint32_t Reserved2[12];           ///< 010h
  volatile uint32_t Capture[4];     ///< 040h, tasks: copy the timer to Compare
  uint32_t Reserved3[60];           ///< 050h
  volatile uint32_t Compared[4];    ///< 140h, events: the timer has reached Compare; cleared by writing 0
  uint32_t Reserved4[109];          ///< 150h
  volatile uint32_t InterruptsOn;   ///< 304h, INTENSET: enables interrupts
  volatile uint32_t InterruptsOff;  ///< 308h, INTENCLR: disables interrupts
  uint32_t Reserved5[126];          ///< 30Ch
  volatile uint32_t Mode;           ///< 504h; 0: timer
  volatile uint32_t BitMode;        ///< 508h; 3: 32 bits
  uint32_t Reserved6;               ///< 50Ch
  volatile uint32_t Prescaler;      ///< 510h: the frequency is 16 MHz / 2^Prescaler, 0…9
  uint32_t Reserved7[11];           ///< 514h
  volatile uint32_t Compare[4];     ///< 540h, CC: compare values, or captured times
} CO_NRF51_TIMER_REGS;

/// State of the timer: the context of Nrf51TimerDriver.
typedef struct CO_NRF51_TIMER_T {
  CO_NRF51_TIMER_REGS* Regs;  ///< address of the TIMER, set by the caller: 40008000h for TIMER0
} CO_NRF51_TIMER;

/// The driver; its context is a CO_NRF51_TIMER.
extern const CO_IF_TIMER_DRV_EX Nrf51TimerDriver;

#ifdef __cplusplus
}
#endif

#endif
