// SPDX-License-Identifier: Apache-2.0
/// \file reference.hpp
/// Second clock of a board, to check the clock of the timer driver.
#pragma once

#include <cstdint>

namespace test {

constexpr std::uint32_t drift_allowed = 100;  // ticks

void start_reference();
/// Accumulates the counter's progress. To be called at least once a second.
void look_at_reference();
/// Returns the microseconds since start_reference().
std::uint32_t reference_ticks();

}  // namespace test
