// SPDX-License-Identifier: Apache-2.0
/// \file measure.hpp
/// Counts the instructions of an operation, which is a class:
///
///     void set_up();          called once, before all operations
///     void arrange(unsigned); called before each operation; not counted
///     void run();             the operation: calls and returns are counted, drivers included
///     bool is_done(unsigned); called after each operation: returns true if it had its effect; not counted
///     void end();             called once, after all operations
///
/// The first half of the operations is checked but not counted, so that set-up costs are excluded; the second half is
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

/// Number of counted operations; as many run before, uncounted.
constexpr unsigned usual_number = 512;

/// Returns the ticks of \a number operations and as many readings of the clock.
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

/// Prints the number of instructions of an operation.
template <class What>
void measure(const char* name, What what, unsigned number = usual_number) {
  report(name, ticks_of(name, what, number), number, number);
}

/// Prints the number of instructions per byte of an operation that transfers \a size bytes.
template <class What>
void measure_byte(const char* name, What what, unsigned number, unsigned size) {
  report(name, ticks_of(name, what, number), number, number * size);
}

}  // namespace bench
