// SPDX-License-Identifier: Apache-2.0
#include "linux_node/clock.hpp"

#include <algorithm>
#include <utility>

namespace lexican::demo {
namespace {

std::uint8_t picture[picture_size];
constexpr std::uint8_t hardware[] = "host";

/// Sets all variables to their initial values. CONodeInit() loads the stored ones.
void reset_variables() {
  clock_set_defaults();
  std::fill(std::begin(picture), std::end(picture), std::uint8_t{0});
}

std::vector<CO_OBJ> dictionary_with(std::uint32_t serial) {
  const Table table = clock_dictionary();
  std::vector<CO_OBJ> entries(table.first, table.first + table.length);
  for (CO_OBJ& entry : entries) {
    if (CO_GET_DEV(entry.Key) == CLOCK_1018_4) {
      entry = {CO_KEY(0x1018, 4, CO_OBJ_D___R_), CO_TUNSIGNED32, serial};
    }
  }
  return entries;
}

}  // namespace
}  // namespace lexican::demo

CO_OBJ_STR clock_1009_0 = {0, lexican::demo::hardware};
CO_OBJ_DOM clock_2200_0 = {0, lexican::demo::picture_size, lexican::demo::picture};

namespace lexican::demo {

std::uint32_t serial_number_from(const std::string& text) {
  std::uint32_t hash = 0x811C9DC5;  // FNV-1a
  for (const char c : text) {
    hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x01000193;
  }
  return hash != 0 ? hash : 1;
}

Clock::Clock(std::uint8_t node_id, Can can, Timer timer, Node::Observer observer, Memory memory, std::uint32_t serial)
    : dictionary_(dictionary_with(serial)),
      setup_{node_id,
             can,
             timer,
             {dictionary_.data(), static_cast<std::uint16_t>(dictionary_.size())},
             std::move(observer),
             false,
             clock_errors(),
             memory} {
  lose_power();
}

void Clock::lose_power() {
  node_.reset();
  reset_variables();
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

}  // namespace lexican::demo
