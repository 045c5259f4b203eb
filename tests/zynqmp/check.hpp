// SPDX-License-Identifier: Apache-2.0
/// \file check.hpp
/// A test runner for a machine without a library: cases in tables, checks, and a report in the Test Anything Protocol.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace zynqmp {

struct Case {
  const char* name;
  void (*run)();
};

/// A file's cases.
struct Cases {
  const Case* first;
  unsigned number;
};
template <unsigned number>
constexpr Cases all_of(const Case (&cases)[number]) {
  return {cases, number};
}

/// Runs them all and prints "1..N", and "ok" or "not ok" for each. Returns how many have failed.
unsigned run_all(const Cases* groups, unsigned number);

/// Returns true after a failure of the running case; then it skips its actions on the bus to end soon.
bool has_failed();
/// Three texts in a row, of which any may be null.
void fail(const char* file, int line, const char* what, const char* more = nullptr, const char* still_more = nullptr);
/// Prints a number with a failure, so that one sees what it was.
void expect(const char* file, int line, const char* what, std::uint64_t value, std::uint64_t expected);

}  // namespace zynqmp

#define CHECK(condition) ((condition) ? static_cast<void>(0) : zynqmp::fail(__FILE__, __LINE__, #condition))
#define CHECK_EQUAL(value, expected) \
  zynqmp::expect(__FILE__, __LINE__, #value, static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(expected))
