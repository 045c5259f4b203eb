// SPDX-License-Identifier: Apache-2.0
#include "plain_drivers.hpp"

#include <cstring>

namespace test {

PlainTimer& plain_timer() {
  static PlainTimer timer;
  return timer;
}

namespace {

void init(std::uint32_t) { ++plain_timer().inits; }
void reload(std::uint32_t ticks) { plain_timer().left = ticks; }
std::uint32_t delay() { return static_cast<std::uint32_t>(plain_timer().left); }
void stop() {
  plain_timer().running = false;
  plain_timer().left = 0;
}
void start() { plain_timer().running = true; }
std::uint8_t update() {
  PlainTimer& timer = plain_timer();
  if (timer.update_always || !timer.cyclic) {
    return 1;
  }
  if (!timer.running || timer.left == 0) {
    return 0;
  }
  --timer.left;
  return timer.left == 0 ? 1U : 0U;
}

void nothing() {}
void nothing_with_baud(std::uint32_t) {}
std::int16_t no_frame(CO_IF_FRM*) { return 0; }
std::int16_t taken(CO_IF_FRM*) { return sizeof(CO_IF_FRM); }

const CO_IF_CAN_DRV can_table = {nothing, nothing_with_baud, no_frame, taken, nothing, nothing};
const CO_IF_TIMER_DRV timer_table = {init, reload, delay, stop, start, update};

}  // namespace

PlainNode::PlainNode(bool cyclic, CO_OBJ entry)
    : dictionary{entry, CO_OBJ CO_OBJ_DICT_ENDMARK}, drivers{&can_table, &timer_table, nullptr} {
  plain_timer() = PlainTimer{};
  plain_timer().cyclic = cyclic;
  std::memset(static_cast<void*>(&node), 0xA5, sizeof node);
  const CO_NODE_SPEC spec = {1, 250000, dictionary, 2, nullptr, memory, 8, 1000, &drivers, nullptr};
  CONodeInit(&node, &spec);
  CONodeStart(&node);
  CONodeGetErr(&node);
}

void PlainNode::tick(bool loop) {
  PlainTimer& timer = plain_timer();
  ++timer.now;
  if (timer.cyclic) {
    COTmrService(&node.Tmr);
  } else if (timer.running && timer.left > 0 && --timer.left == 0) {
    COTmrService(&node.Tmr);
  }
  if (loop) {
    COTmrProcess(&node.Tmr);
  }
}

void PlainNode::ticks(unsigned number, bool loop) {
  for (unsigned i = 0; i < number; ++i) tick(loop);
}

}  // namespace test
