// SPDX-License-Identifier: Apache-2.0
#include "linux_node/heartbeat_watch.hpp"

#include <algorithm>

namespace lexican::demo {
namespace {

constexpr std::uint8_t boot_up = 0;

// Accepts every node-ID, because the node may get one during the measurement.
bool is_error_control(const CO_IF_FRM& frame) {
  return frame.Identifier > 0x700 && frame.Identifier <= 0x77F && frame.DLC == 1;
}

}  // namespace

// Answers to node guarding have the same form, but are sent only while there is no heartbeat.
void HeartbeatWatch::on_sent(const CO_IF_FRM& frame, std::uint32_t tick, std::uint32_t period) {
  if (!is_error_control(frame)) {
    return;
  }
  if (frame.Data[0] == boot_up || period != period_ || period == 0) {
    period_ = period;
    due_ = tick + period;
    return;
  }
  const auto late = static_cast<std::int32_t>(tick - due_);
  greatest_lateness_ = std::max(greatest_lateness_, static_cast<std::uint32_t>(std::max(late, 0)));
  due_ += period;
  ++number_;
}

}  // namespace lexican::demo
