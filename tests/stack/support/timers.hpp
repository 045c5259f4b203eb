// SPDX-License-Identifier: Apache-2.0
/// \file timers.hpp
/// A node for tests of its timers only.
#pragma once

#include "fixture.hpp"

namespace test {

/// Log of timer actions, in order. The parameter of a timer is a number.
using Runs = std::vector<std::uintptr_t>;
Runs& runs();

/// Timer action that logs its parameter.
void note(void* para);

inline void* number(std::uintptr_t n) { return reinterpret_cast<void*>(n); }

/// A node for tests of timers. A tick is 1 ms unless the setup has another frequency.
class Timers : public Fixture {
 public:
  explicit Timers(const Setup& setup = Setup());
  std::int16_t create(std::uint32_t start, std::uint32_t cycle, std::uintptr_t n);
  std::int16_t remove(std::int16_t id);
};

}  // namespace test
