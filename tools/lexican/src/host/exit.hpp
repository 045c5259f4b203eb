// SPDX-License-Identifier: Apache-2.0
/// \file exit.hpp
/// Exit codes of the demo programs; --help describes their meaning for each program.
#pragma once

namespace lexican {

enum Exit : int {
  exit_ok = 0,
  exit_failed = 1,
  exit_usage = 2,  // also: the bus or a file cannot be used
  exit_interrupted = 130,
};

}  // namespace lexican
