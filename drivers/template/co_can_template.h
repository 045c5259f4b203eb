// SPDX-License-Identifier: Apache-2.0
/// \file co_can_template.h
/// Template of a CAN driver: copy both files, rename everything called "template", and implement the parts marked with
/// "Here". Unchanged, it compiles, but sends and receives no frames. docs/porting.md describes each step, and
/// tests/drivers/driver_check tests the finished driver.
///
///     CO_IF_DRV drivers = { &TemplateCanDriver, &TemplateTimerDriver, &TemplateNvmDriver };
///     spec.Drv = &drivers;
///     void CAN_IRQHandler(void) { TemplateCanInterrupt(); }
///     for (;;) { CONodeProcess(&node); COTmrProcess(&node.Tmr); TemplateCanReport(&node); }
///
/// One table serves one controller. For two controllers, or a second node, write the functions with a first parameter
/// void *ctx and fill a CO_IF_CAN_DRV_EX instead. That table also has Filter, whose argument lists the identifiers that
/// the node receives: set the acceptance filters of the controller there, and the CPU does not process unrelated
/// frames.
#ifndef CO_CAN_TEMPLATE_H_
#define CO_CAN_TEMPLATE_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The driver, for CO_IF_DRV.Can.
extern const CO_IF_CAN_DRV TemplateCanDriver;

/// Moves received frames into the queue. Call it in the interrupt of the controller.
void TemplateCanInterrupt(void);

/// Reports the events noted by the interrupt to the node (CONodeCanEvent()). Call it in the loop.
void TemplateCanReport(CO_NODE* node);

/// Returns true if there is a frame to read or an event to report; a loop checks it before it sleeps. Any context.
bool TemplateCanHasWork(void);

#ifdef __cplusplus
}
#endif

#endif
