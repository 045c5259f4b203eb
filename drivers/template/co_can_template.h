// SPDX-License-Identifier: Apache-2.0
/// \file co_can_template.h
/// Template of a CAN driver: copy both files, rename everything called "template", fill in what the comments ask for.
/// As it is, it compiles, sends nothing and receives nothing.
///
///     CO_IF_DRV drivers = { &TemplateCanDriver, &TemplateTimerDriver, &TemplateNvmDriver };
///     spec.Drv = &drivers;
///     void CAN_RX_IRQHandler(void) { TemplateCanReceiveInterrupt(); }
///
/// One table serves one controller. For two controllers, or a second node, write the functions with a first parameter
/// void *ctx and fill a CO_IF_CAN_DRV_EX instead; that table also has Filter, which tells the identifiers that the node
/// wants to receive: set the acceptance filters of the controller there, and the CPU never sees foreign frames.
#ifndef CO_CAN_TEMPLATE_H_
#define CO_CAN_TEMPLATE_H_

#include "co_if_can.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_IF_CAN_DRV TemplateCanDriver;

/// To be called in the receive interrupt of the controller. Delete it if Read polls the controller.
void TemplateCanReceiveInterrupt(void);

#ifdef __cplusplus
}
#endif

#endif
