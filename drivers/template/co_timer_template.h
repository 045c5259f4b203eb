// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_template.h
/// Template of a timer driver: copy both files, rename everything called "template", and implement the parts marked
/// with "Here". Unchanged, it compiles, but its time does not advance. docs/porting.md describes each step, and
/// tests/drivers/driver_check tests the finished driver.
///
/// A timer driver works in one of two modes; this template uses the first one:
/// - Delta mode: a hardware counter runs at CO_NODE_SPEC.TmrFreq (say 1 MHz), and its compare match interrupts exactly
///   when something is due. The CPU can sleep until then.
/// - Cyclic mode: a periodic interrupt that the application already has (say 1 kHz) is counted. It needs no timer
///   hardware: use co_timer_software.h unchanged.
///
///     void TIMER_IRQHandler(void) { TemplateTimerInterrupt(); COTmrService(&node.Tmr); }
///
/// The application must define COTmrLock() and COTmrUnlock(), which disable and enable this interrupt.
/// If the counter is free running with 32 bits, CO_IF_TIMER_DRV_EX (Now and Alarm) is simpler, and supports several
/// nodes.
#ifndef CO_TIMER_TEMPLATE_H_
#define CO_TIMER_TEMPLATE_H_

#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The driver, for CO_IF_DRV.Timer.
extern const CO_IF_TIMER_DRV TemplateTimerDriver;

/// Processes a compare match. Call it in the compare interrupt, before COTmrService().
void TemplateTimerInterrupt(void);

#ifdef __cplusplus
}
#endif

#endif
