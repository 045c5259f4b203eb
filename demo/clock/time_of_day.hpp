// SPDX-License-Identifier: Apache-2.0
/// \file time_of_day.hpp
/// Time of day of the clock, and the timer action that advances it.
#pragma once

#include <cstdint>

namespace lexican::demo {

/// Time of day, object 2100h.
struct TimeOfDay {
  std::uint8_t hour;    // 0…23
  std::uint8_t minute;  // 0…59
  std::uint8_t second;  // 0…59
};

/// Get and set the time. The dictionary refers to variables by address, so a program has one clock.
TimeOfDay clock_time();
void set_clock_time(TimeOfDay time);

/// Advances the clock by a second and sends TPDO1 if the NMT state and its transmission type allow it. To be used as
/// action of a cyclic timer of 1 s. \a node: the CO_NODE.
void clock_tick(void* node);

}  // namespace lexican::demo
