// SPDX-License-Identifier: Apache-2.0
#include "linux_node/clock.hpp"

#include <utility>

#include "linux_node/dictionary.hpp"

namespace demo {
namespace {

void advance(TimeOfDay& now) {
  if (++now.second < 60) {
    return;
  }
  now.second = 0;
  if (++now.minute < 60) {
    return;
  }
  now.minute = 0;
  now.hour = static_cast<std::uint8_t>((now.hour + 1) % 24);
}

// TPDO1 is sent where the NMT state and its transmission type allow it.
void tick(void* node) {
  advance(clock_time);
  COTPdoRequest(static_cast<CO_NODE*>(node), 0);
}

}  // namespace

Clock::Clock(std::uint8_t node_id, Can can, Timer timer, Node::Observer observer, Memory memory)
    : setup_{node_id, can, timer, clock_dictionary(), std::move(observer), false, clock_errors(), memory} {
  lose_power();
}

void Clock::lose_power() {
  node_.reset();
  forget_variables();
  node_.emplace(setup_);
}

bool Clock::start() {
  CO_NODE& node = node_->stack();
  if (CONmtGetMode(&node.Nmt) != CO_INIT) {
    return false;
  }
  clock_time = {};
  if (COTmrCreate(&node.Tmr, Node::ticks_per_second, Node::ticks_per_second, tick, &node) < 0) {
    return false;
  }
  CONodeStart(&node);
  return true;
}

TimeOfDay Clock::time() { return clock_time; }

}  // namespace demo
