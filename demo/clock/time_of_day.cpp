// SPDX-License-Identifier: Apache-2.0
#include "clock/time_of_day.hpp"

#include "clock/generated/clock_od.h"

namespace lexican::demo {

namespace {

TimeOfDay after(TimeOfDay time) {
  if (++time.second < 60) {
    return time;
  }
  time.second = 0;
  if (++time.minute < 60) {
    return time;
  }
  time.minute = 0;
  time.hour = static_cast<std::uint8_t>((time.hour + 1) % 24);
  return time;
}

}  // namespace

TimeOfDay clock_time() { return {clock_ram.time_hour, clock_ram.time_minute, clock_ram.time_second}; }

void set_clock_time(TimeOfDay time) {
  clock_ram.time_hour = time.hour;
  clock_ram.time_minute = time.minute;
  clock_ram.time_second = time.second;
}

void clock_tick(void* node) {
  set_clock_time(after(clock_time()));
  COTPdoRequest(static_cast<CO_NODE*>(node), 0);
}

}  // namespace lexican::demo
