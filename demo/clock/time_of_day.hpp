// SPDX-License-Identifier: Apache-2.0
/// \file time_of_day.hpp
/// What the clock shows, and how it runs.
#pragma once

#include <cstdint>

namespace demo {

/// What the network sees under 2100h.
struct TimeOfDay {
  std::uint8_t hour;    // 0…23
  std::uint8_t minute;  // 0…59
  std::uint8_t second;  // 0…59
};

/// A dictionary names its variables by address, so a program has one clock.
TimeOfDay clock_time();
void set_clock_time(TimeOfDay time);

/// The action of a timer, to be run each second: a second is over. TPDO1 is sent where the NMT state and its
/// transmission type allow it. \a node: the CO_NODE.
void clock_tick(void* node);

}  // namespace demo
