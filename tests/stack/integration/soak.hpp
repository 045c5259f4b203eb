// SPDX-License-Identifier: Apache-2.0
/// \file soak.hpp
/// Functions shared by the soak tests: duration of a test, duration of a frame.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "co_core.h"

namespace test {

/// Returns the duration of a test: a minute, or LEXICAN_SOAK_MINUTES (environment). The 32-bit counters do not wrap
/// within three days of a saturated bus.
inline std::chrono::minutes soak_time() {
  const char* const minutes = std::getenv("LEXICAN_SOAK_MINUTES");
  const long number = minutes == nullptr ? 1 : std::strtol(minutes, nullptr, 10);
  REQUIRE_MESSAGE((number >= 1 && number <= 1440), "LEXICAN_SOAK_MINUTES: 1...1440");
  return std::chrono::minutes(number);
}

/// Returns the duration of a frame at 1 Mbit/s without stuff bits, from SOF to interframe space. [ISO 11898-1]
inline std::chrono::microseconds time_on_bus(const CO_IF_FRM& frame) {
  const unsigned bytes = (frame.Identifier & CO_IF_FRM_RTR) != 0 ? 0 : std::min<unsigned>(frame.DLC, 8);
  const bool extended = (frame.Identifier & CO_IF_FRM_EXT) != 0;
  return std::chrono::microseconds(47 + (extended ? 20 : 0) + 8 * bytes);
}

}  // namespace test
