// SPDX-License-Identifier: Apache-2.0
/// \file loop.hpp
/// Runs the nodes of a program in one thread while the program waits for a condition.
#pragma once

#include <functional>
#include <vector>

#include "host/host.hpp"
#include "host/node.hpp"

namespace lexican {

/// Limit of the time in which frames that are still queued, such as an abort, are transmitted before the program ends.
constexpr Micros flush_time = 100 * millisecond;

class Loop {
 public:
  /// The host and the nodes must outlive the loop.
  Loop(Host& host, std::vector<Node*> nodes);

  /// Runs the nodes until \a done returns true; it is called after each change. Returns false after \a timeout, or if
  /// the program was interrupted.
  bool run_until(const std::function<bool()>& done, Micros timeout);

  /// Runs the nodes for some time, unless the program is interrupted.
  void run_for(Micros time);

  /// Runs the nodes until they are idle (even if the program was interrupted), at most for \a timeout.
  void flush(Micros timeout);

  Micros now() { return host_.now(); }
  bool interrupted() { return host_.interrupted(); }

 private:
  bool process();
  Micros due_in();

  Host& host_;
  std::vector<Node*> nodes_;
};

}  // namespace lexican
