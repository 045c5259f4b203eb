// SPDX-License-Identifier: Apache-2.0
/// \file soak.hpp
/// What the soak tests share: how long they last, and how long a frame does.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "co_core.h"

namespace test {

/// A minute, or LEXICAN_SOAK_MINUTES (environment). Counters of 32 bits last for more than three days of a full bus.
inline std::chrono::minutes soak_time() {
  const char* const minutes = std::getenv("LEXICAN_SOAK_MINUTES");
  const long number = minutes == nullptr ? 1 : std::strtol(minutes, nullptr, 10);
  REQUIRE_MESSAGE((number >= 1 && number <= 1440), "LEXICAN_SOAK_MINUTES: 1...1440");
  return std::chrono::minutes(number);
}

/// At 1 Mbit/s, without stuff bits: SOF to interframe space. [ISO 11898-1]
inline std::chrono::microseconds time_on_bus(const CO_IF_FRM& frame) {
  const unsigned bytes = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? 0 : std::min<unsigned>(frame.DLC, 8);
  const bool extended = (frame.Identifier & CO_IF_FRM_EXT) != 0;
  return std::chrono::microseconds(47 + (extended ? 20 : 0) + 8 * bytes);
}

}  // namespace test
