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

/// Registers of a TIMER that the driver uses.
typedef struct CO_NRF51_TIMER_REGS_T {
  volatile uint32_t Start;  ///< 000h
  volatile uint32_t Stop;
  uint32_t Reserved1;
  volatile uint32_t Clear;
  uint32_t Reserved2[12];
  volatile uint32_t Capture[4];  ///< 040h
  uint32_t Reserved3[60];
  volatile uint32_t Compared[4];  ///< 140h
  uint32_t Reserved4[109];
  volatile uint32_t InterruptsOn;  ///< 304h
  volatile uint32_t InterruptsOff;
  uint32_t Reserved5[126];
  volatile uint32_t Mode;  ///< 504h
  volatile uint32_t BitMode;
  uint32_t Reserved6;
  volatile uint32_t Prescaler;  ///< 510h
  uint32_t Reserved7[11];
  volatile uint32_t Compare[4];  ///< 540h
} CO_NRF51_TIMER_REGS;

typedef struct CO_NRF51_TIMER_T {
  CO_NRF51_TIMER_REGS* Regs;
} CO_NRF51_TIMER;

/// The driver; its context is a CO_NRF51_TIMER.
extern const CO_IF_TIMER_DRV_EX Nrf51TimerDriver;

#ifdef __cplusplus
}
#endif

#endif
