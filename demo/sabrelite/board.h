// SPDX-License-Identifier: Apache-2.0
/// \file board.h
/// SABRE Lite (i.MX 6Quad) without operating system: two FlexCAN controllers, interrupts, a clock and a console.
#ifndef BOARD_H_
#define BOARD_H_

#include "co_can_flexcan.h"
#include "co_if_timer.h"

extern CO_CAN_FLEXCAN BoardCan[2];  ///< FLEXCAN1 and FLEXCAN2

/// Sets up the clock and the interrupts of the controllers. Called first in main().
void BoardStart(void);

/// Returns the microseconds since the start.
uint32_t BoardMicroseconds(void);

/// Tickless timer driver without interrupt: 1 tick is 1 us. Its context argument is unused.
extern const CO_IF_TIMER_DRV_EX BoardTimer;
#define BOARD_TICKS 1000000u  ///< ticks per second

void BoardPrint(const char* text);
void BoardPrintNumber(uint32_t number);

#endif
