// SPDX-License-Identifier: Apache-2.0
#include "clock/time_of_day.hpp"

#include "co_core.h"

namespace demo {

TimeOfDay clock_time{};

namespace {

void advance(TimeOfDay& now) {
  if (++now.second < 60) {
    return;
  }
  now.second = 0;
  if (++now.minute < 60) {
    return;
  }
  now.minute = 0;
  now.hour = static_cast<std::uint8_t>((now.hour + 1) % 24);
}

}  // namespace

void clock_tick(void* node) {
  advance(clock_time);
  COTPdoRequest(static_cast<CO_NODE*>(node), 0);
}

}  // namespace demo
