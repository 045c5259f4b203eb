// SPDX-License-Identifier: Apache-2.0
/// \file check.hpp
/// A test runner for a machine without C library: tables of cases, checks, and a report in the Test Anything Protocol.
#pragma once

#include <cstdint>
#include <initializer_list>

namespace zynqmp {

struct Case {
  const char* name;
  void (*run)();
};

/// The cases of one source file.
struct Cases {
  const Case* first;
  unsigned number;
};
template <unsigned number>
constexpr Cases all_of(const Case (&cases)[number]) {
  return {cases, number};
}

/// Runs all cases and prints "1..N", and "ok" or "not ok" for each. Returns the number of failed cases.
unsigned run_all(const Cases* groups, unsigned number);

/// Returns true if the running case has failed; it then skips the rest of its actions on the bus.
bool has_failed();
/// Reports a failure with a text of up to three parts, each of which may be null.
void fail(const char* file, int line, const char* what, const char* more = nullptr, const char* still_more = nullptr);
/// Reports a failure with both numbers unless they are equal.
void expect(const char* file, int line, const char* what, std::uint64_t value, std::uint64_t expected);

}  // namespace zynqmp

#define CHECK(condition) ((condition) ? static_cast<void>(0) : zynqmp::fail(__FILE__, __LINE__, #condition))
#define CHECK_EQUAL(value, expected) \
  zynqmp::expect(__FILE__, __LINE__, #value, static_cast<std::uint64_t>(value), static_cast<std::uint64_t>(expected))
