// SPDX-License-Identifier: Apache-2.0
#include "board.hpp"
#include "co_timer_nrf51.h"
#include "parts.hpp"

namespace lexican::demo {
namespace {

CO_NRF51_TIMER timer = {reinterpret_cast<CO_NRF51_TIMER_REGS*>(board::timer_base)};

}  // namespace

BoardTimer board_timer() {
  board::enable_timer_interrupt();
  return {&Nrf51TimerDriver, &timer};
}

// COTmrService(), which the interrupt handler calls next, sets the next alarm: that clears the event of the timer.
void timer_interrupt() {}

}  // namespace lexican::demo
