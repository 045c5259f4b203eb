// SPDX-License-Identifier: Apache-2.0
/// \file loop.hpp
/// The nodes of a program in one thread: while the program waits for something, all of them run.
#pragma once

#include <functional>
#include <vector>

#include "host/host.hpp"
#include "host/node.hpp"

namespace demo {

class Loop {
 public:
  /// The host and the nodes must outlive the loop.
  Loop(Host& host, std::vector<Node*> nodes);

  /// Lets the nodes run until \a done answers true, which is asked whenever something may have changed. Returns false
  /// if it did not within \a timeout, or the program was interrupted.
  bool run_until(const std::function<bool()>& done, Micros timeout);

  /// Lets the nodes run for some time, unless the program is interrupted.
  void run_for(Micros time);

  /// Lets the nodes finish what they have begun (also if the program was interrupted), at most for \a timeout.
  void flush(Micros timeout);

  Micros now() { return host_.now(); }
  bool interrupted() { return host_.interrupted(); }

 private:
  bool process();
  Micros due_in();

  Host& host_;
  std::vector<Node*> nodes_;
};

}  // namespace demo
