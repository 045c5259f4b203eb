// SPDX-License-Identifier: Apache-2.0
#include "board.hpp"
#include "co_timer_systick.h"
#include "parts.hpp"

namespace lexican::demo {
namespace {

CO_SYSTICK timer = {CO_SYSTICK_REGISTERS, CO_SYSTICK_CONTROL, board::core_hz, {}, 0, 0, 0, 0};

}  // namespace

BoardTimer board_timer() { return {&SysTickDriver, &timer}; }

void timer_interrupt() { COSysTickInterrupt(&timer); }

}  // namespace lexican::demo
