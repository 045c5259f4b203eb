// SPDX-License-Identifier: Apache-2.0
/// \file heap_watch.hpp
/// Counts heap allocations that are made while the stack runs. The stack must make none.
#pragma once

#include <cstdint>

namespace test {

/// Enables counting for this thread as long as the object exists.
class InsideStack {
 public:
  InsideStack();
  ~InsideStack();
  InsideStack(const InsideStack&) = delete;
  InsideStack& operator=(const InsideStack&) = delete;
};

/// Suspends counting for this thread as long as the object exists: for drivers and callbacks of the test, which the
/// stack calls.
class OutsideStack {
 public:
  OutsideStack();
  ~OutsideStack();
  OutsideStack(const OutsideStack&) = delete;
  OutsideStack& operator=(const OutsideStack&) = delete;

 private:
  int depth_;
};

/// Returns the number of allocations counted in this thread.
std::uint64_t heap_requests();

}  // namespace test
