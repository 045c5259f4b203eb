// SPDX-License-Identifier: Apache-2.0
/// \file heartbeat_watch.hpp
/// Measures how late the heartbeats of a node are, in ticks of the node's clock.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace lexican::demo {

/// Measures the lateness of heartbeats. The n-th heartbeat is due n heartbeat times after the boot-up message, which
/// counts as the first [301:7.2.8.2.2.1]; a late one does not shift the others.
class HeartbeatWatch {
 public:
  /// Evaluates a frame that the node has sent at \a tick. \a period: its current heartbeat time in ticks, 0: none.
  void on_sent(const CO_IF_FRM& frame, std::uint32_t tick, std::uint32_t period);

  std::uint32_t number() const { return number_; }
  /// Returns the largest lateness of a heartbeat, in ticks.
  std::uint32_t greatest_lateness() const { return greatest_lateness_; }

 private:
  std::uint32_t period_ = 0;  // ticks, 0: no previous heartbeat to count from
  std::uint32_t due_ = 0;     // tick of the next heartbeat
  std::uint32_t number_ = 0;
  std::uint32_t greatest_lateness_ = 0;
};

}  // namespace lexican::demo
