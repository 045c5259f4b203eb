// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_template.h
/// Template of a timer driver: copy both files, rename everything called "template", fill in what the comments ask for.
/// As it is, it compiles, and no time ever passes. docs/porting.md goes through it step by step, and tests/driver_check
/// checks what has become of it.
///
/// There are two ways to drive the timers of a node; this template is of the first kind:
/// - Delta mode: a hardware counter runs at CO_NODE_SPEC.TmrFreq (say 1 MHz), and its compare match interrupts exactly
///   when something is due. The CPU can sleep until then.
/// - Cyclic mode: a periodic interrupt that exists anyway (say 1 kHz) is counted. No hardware to program at all: take
///   co_timer_software.h as it is.
///
///     void TIMER_IRQHandler(void) { TemplateTimerInterrupt(); COTmrService(&node.Tmr); }
///
/// The application must supply COTmrLock() and COTmrUnlock(), which keep this interrupt away and let it in again.
/// If the counter is free running with 32 bits, CO_IF_TIMER_DRV_EX (Now and Alarm) is simpler still, and serves several
/// nodes.
#ifndef CO_TIMER_TEMPLATE_H_
#define CO_TIMER_TEMPLATE_H_

#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_IF_TIMER_DRV TemplateTimerDriver;

/// To be called in the compare interrupt, before COTmrService().
void TemplateTimerInterrupt(void);

#ifdef __cplusplus
}
#endif

#endif
