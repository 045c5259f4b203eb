// SPDX-License-Identifier: Apache-2.0
/// \file reference.hpp
/// Another clock of the board, to hold the one of the driver against.
#pragma once

#include <cstdint>

namespace test {

constexpr std::uint32_t drift_allowed = 100;  // ticks

void start_reference();
/// To be called at least once in a second.
void look_at_reference();
/// Microseconds since its start.
std::uint32_t reference_ticks();

}  // namespace test
