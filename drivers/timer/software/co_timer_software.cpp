// SPDX-License-Identifier: Apache-2.0
#include "co_timer_software.h"

#include <cstdint>

namespace {

// Ticks until the end, 0: stopped or elapsed. Written by the interrupt and, with the interrupt disabled, by the loop.
volatile std::uint32_t ticks_left = 0;

void init(std::uint32_t /*freq*/) { ticks_left = 0; }
void reload(std::uint32_t ticks) { ticks_left = ticks; }
std::uint32_t delay() { return ticks_left; }
void stop() { ticks_left = 0; }
void start() {}  // reload() has started the count-down

std::uint8_t update() {
  const std::uint32_t left = ticks_left;
  if (left == 0) {
    return 0;
  }
  ticks_left = left - 1;
  return (left == 1) ? 1 : 0;
}

}  // namespace

const CO_IF_TIMER_DRV SoftwareTimerDriver = {init, reload, delay, stop, start, update};
