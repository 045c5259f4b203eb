// SPDX-License-Identifier: Apache-2.0
/// \file measure.hpp
/// Counts the instructions of an operation, which is a class:
///
///     void set_up();          what it needs, once
///     void arrange(unsigned); before each; not counted, no more than what follows
///     void run();             what is counted: calls and their returns, drivers included
///     bool is_done(unsigned); has the operation had its effect?
///     void end();             after the last
///
/// The first half of the operations is only checked, so that nothing of the set-up is in the count; the second half is
/// checked and counted.
#pragma once

#include <cstdint>

#include "machine.hpp"

namespace bench {

struct Operation {
  void set_up() {}
  void arrange(unsigned) {}
  void run() {}
  bool is_done(unsigned) { return true; }
  void end() {}
};

/// Half of the operations.
constexpr unsigned usual_number = 512;

/// Ticks of \a number operations, and of reading the clock so often.
template <class What>
std::uint64_t ticks_of(const char* name, What& what, unsigned number) {
  std::uint64_t ticks = 0;
  what.set_up();
  for (unsigned n = 0; n < 2 * number; ++n) {
    if (n == number) {
      forget_count();
    }
    what.arrange(n);
    const std::uint32_t before = clock_of_machine();
    what.run();
    const std::uint32_t after = clock_of_machine();
    if (!what.is_done(n)) {
      fail(name, "it has not done what it should");
    }
    ticks += n < number ? 0 : ticks_between(before, after);
  }
  what.end();
  return ticks;
}

/// Tells how many instructions an operation takes.
template <class What>
void measure(const char* name, What what, unsigned number = usual_number) {
  report(name, ticks_of(name, what, number), number, number);
}

/// Measures like measure(), per byte of an operation that transfers several bytes.
template <class What>
void measure_byte(const char* name, What what, unsigned number, unsigned size) {
  report(name, ticks_of(name, what, number), number, number * size);
}

}  // namespace bench
