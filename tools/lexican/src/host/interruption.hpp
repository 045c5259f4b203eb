// SPDX-License-Identifier: Apache-2.0
/// \file interruption.hpp
/// Ctrl-C and the request to end, for programs that wait in ppoll().
#pragma once

#include <signal.h>

namespace lexican {

/// Stores SIGINT and SIGTERM during its lifetime, instead of ending the program. The signals are unblocked only while
/// the program waits, so that none is missed between happened() and the wait. One instance at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  static bool happened();
  /// Returns the signal mask for the wait.
  const sigset_t& while_waiting() const { return before_; }

 private:
  sigset_t before_{};
};

}  // namespace lexican
