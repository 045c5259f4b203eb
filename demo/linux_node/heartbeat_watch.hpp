// SPDX-License-Identifier: Apache-2.0
/// \file heartbeat_watch.hpp
/// How punctual the heartbeats of a node are, in ticks of its own clock.
#pragma once

#include <cstdint>

#include "co_core.h"

namespace demo {

/// The n-th heartbeat is due n heartbeat times after the boot-up message, which counts as the first [301:7.2.8.2.2.1];
/// whatever delays one does not move the others.
class HeartbeatWatch {
 public:
  /// What the node has sent at \a tick. \a period: its present heartbeat time in ticks, 0: it sends none.
  void sent(const CO_IF_FRM& frame, std::uint32_t tick, std::uint32_t period);

  std::uint32_t number() const { return number_; }
  /// The most that one of them was late, in ticks.
  std::uint32_t latest() const { return latest_; }

 private:
  std::uint32_t period_ = 0;  // ticks, 0: there is no heartbeat from which the next can be told
  std::uint32_t due_ = 0;     // the next one
  std::uint32_t number_ = 0;
  std::uint32_t latest_ = 0;
};

}  // namespace demo
