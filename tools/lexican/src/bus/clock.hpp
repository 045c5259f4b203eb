// SPDX-License-Identifier: Apache-2.0
/// \file clock.hpp
/// Time of the computer.
#pragma once

#include <time.h>

#include "bus/log.hpp"

namespace lexican::host_bus {

/// \a clock: CLOCK_REALTIME or CLOCK_MONOTONIC.
inline Micros clock_now(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<Micros>(now.tv_sec) * 1'000'000 + static_cast<Micros>(now.tv_nsec) / 1000;
}

}  // namespace lexican::host_bus
