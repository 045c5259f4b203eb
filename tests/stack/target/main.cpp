// SPDX-License-Identifier: Apache-2.0
// Runs the test cases on a board, with doctest.
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_NO_POSIX_SIGNALS
#define DOCTEST_CONFIG_NO_MULTITHREADING
#define DOCTEST_CONFIG_NO_MULTI_LANE_ATOMICS
#include <doctest/doctest.h>

#include <cstdio>

#include "arguments.hpp"

int main() {
  const Arguments arguments;
  const int status = doctest::Context(arguments.number(), arguments.words()).run();
  std::fflush(stdout);
  return status;
}
