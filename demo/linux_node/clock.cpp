// SPDX-License-Identifier: Apache-2.0
#include "linux_node/clock.hpp"

#include <utility>

namespace demo {
namespace {

std::uint8_t picture[picture_size];

}  // namespace

const std::uint8_t clock_hardware[] = "host";
CO_OBJ_DOM clock_picture = {0, picture_size, picture};

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
  if (COTmrCreate(&node.Tmr, Node::ticks_per_second, Node::ticks_per_second, clock_tick, &node) < 0) {
    return false;
  }
  CONodeStart(&node);
  return true;
}

}  // namespace demo
