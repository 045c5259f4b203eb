// SPDX-License-Identifier: Apache-2.0
#include "board.hpp"
#include "co_timer_mtime.h"
#include "parts.hpp"

namespace lexican::demo {
namespace {

volatile std::uint32_t* registers(std::uintptr_t offset) {
  return reinterpret_cast<volatile std::uint32_t*>(board::timer_base + offset);
}

// mtime, mtimecmp and the frequency of mtime.
CO_MTIME timer = {registers(0xBFF8), registers(0x4000), board::timer_hz, {}, 0};

}  // namespace

BoardTimer board_timer() {
  board::enable_timer_interrupt();
  return {&MtimeDriver, &timer};
}

// COTmrService(), which the interrupt handler calls next, sets the next alarm: that ends the request of the interrupt.
void timer_interrupt() {}

}  // namespace lexican::demo
