// SPDX-License-Identifier: Apache-2.0
/// \file co_can_template.h
/// Template of a CAN driver: copy both files, rename everything called "template", fill in what the comments ask for.
/// As it is, it compiles, sends nothing and receives nothing. docs/porting.md goes through it step by step, and
/// tests/driver_check checks what has become of it.
///
///     CO_IF_DRV drivers = { &TemplateCanDriver, &TemplateTimerDriver, &TemplateNvmDriver };
///     spec.Drv = &drivers;
///     void CAN_IRQHandler(void) { TemplateCanInterrupt(); }
///     for (;;) { CONodeProcess(&node); COTmrProcess(&node.Tmr); TemplateCanReport(&node); }
///
/// One table serves one controller. For two controllers, or a second node, write the functions with a first parameter
/// void *ctx and fill a CO_IF_CAN_DRV_EX instead; that table also has Filter, which tells the identifiers that the node
/// wants to receive: set the acceptance filters of the controller there, and the CPU never sees foreign frames.
#ifndef CO_CAN_TEMPLATE_H_
#define CO_CAN_TEMPLATE_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_IF_CAN_DRV TemplateCanDriver;

/// To be called in the interrupt of the controller.
void TemplateCanInterrupt(void);

/// To be called in the loop: reports to the node what the interrupt has seen (CONodeCanEvent()).
void TemplateCanReport(CO_NODE* node);

/// For a loop that wants to sleep: is there something to read or to report? Any context.
bool TemplateCanHasWork(void);

#ifdef __cplusplus
}
#endif

#endif
