// SPDX-License-Identifier: Apache-2.0
/// \file heap_watch.hpp
/// Counts the memory requests that are made while the stack runs. It must make none.
#pragma once

#include <cstdint>

namespace test {

/// While one of these lives, requests of this thread count.
class InsideStack {
 public:
  InsideStack();
  ~InsideStack();
  InsideStack(const InsideStack&) = delete;
  InsideStack& operator=(const InsideStack&) = delete;
};

/// While one of these lives, they do not: the stack has called a driver or a callback of the test.
class OutsideStack {
 public:
  OutsideStack();
  ~OutsideStack();
  OutsideStack(const OutsideStack&) = delete;
  OutsideStack& operator=(const OutsideStack&) = delete;

 private:
  int depth_;
};

/// Requests counted in this thread.
std::uint64_t heap_requests();

}  // namespace test
