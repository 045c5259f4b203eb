// SPDX-License-Identifier: Apache-2.0
/// \file example_main.h
/// Main loop of a node without an operating system: the CPU sleeps while the node is idle.
#ifndef EXAMPLE_MAIN_H_
#define EXAMPLE_MAIN_H_

#include "example_board.h"

#ifdef __cplusplus
extern "C" {
#endif

extern CO_NODE Node;

/// Initialises and starts the node. Returns false if CONodeGetErr() is set; the node then sends nothing.
bool NodeStart(CO_NODE_SPEC* spec);
/// Executes one iteration of the main loop. Call it in an endless loop.
void NodeRunOnce(void);

void CAN_IRQHandler(void);
void TIMER_IRQHandler(void);

#ifdef __cplusplus
}
#endif

#endif
