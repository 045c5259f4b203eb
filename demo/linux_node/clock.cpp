// SPDX-License-Identifier: Apache-2.0
#include "linux_node/clock.hpp"

#include <algorithm>
#include <utility>

namespace demo {
namespace {

std::uint8_t picture[picture_size];
constexpr std::uint8_t hardware[] = "host";

/// Gives all variables the values that they have when the program begins. CONodeInit() loads those that are stored.
void forget_variables() {
  clock_set_defaults();
  std::fill(std::begin(picture), std::end(picture), std::uint8_t{0});
}

}  // namespace
}  // namespace demo

CO_OBJ_STR clock_1009_0 = {0, demo::hardware};
CO_OBJ_DOM clock_2200_0 = {0, demo::picture_size, demo::picture};

namespace demo {

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
  set_clock_time({});
  if (COTmrCreate(&node.Tmr, Node::ticks_per_second, Node::ticks_per_second, clock_tick, &node) < 0) {
    return false;
  }
  CONodeStart(&node);
  return true;
}

}  // namespace demo
