// SPDX-License-Identifier: Apache-2.0
// Drivers that store frames and times in memory. Their instructions are counted, too. With BENCH_CLASSIC_DRIVERS they
// are classic drivers (CO_IF_DRV), otherwise drivers with context argument.
#include "drivers.hpp"

#include <algorithm>

#include "device.hpp"
#include "machine.hpp"

namespace bench {
namespace {

constexpr std::size_t places = 256;  // enough for a block and its response

CO_IF_FRM received_frames[places];
std::size_t received_num = 0;
std::size_t received_next = 0;

CO_IF_FRM sent_frames[places];
std::size_t sent_num = 0;

std::int16_t read(CO_IF_FRM* to) {
  if (received_next == received_num) {
    return 0;
  }
  *to = received_frames[received_next++];
  return sizeof *to;
}

std::int16_t send(const CO_IF_FRM* from) {
  sent_frames[sent_num++ % places] = *from;
  return sizeof *from;
}

#ifdef BENCH_CLASSIC_DRIVERS

// A timer that counts down.
std::uint32_t ticks_left = 0;  // 0: stopped or elapsed
std::uint8_t is_elapsed = 0;   // 1: Update() has not reported the expiry yet

void nothing() {}
void set_rate(std::uint32_t) {}

void reload(std::uint32_t ticks) {
  ticks_left = ticks;
  is_elapsed = 0;
}
std::uint32_t delay() { return ticks_left; }
void stop() { reload(0); }
std::uint8_t update() {
  const std::uint8_t elapsed = is_elapsed;
  is_elapsed = 0;
  return elapsed;
}

void pass(std::uint32_t ticks) {
  if (ticks_left != 0) {
    ticks_left -= std::min(ticks_left, ticks);
    is_elapsed = ticks_left == 0 ? 1 : 0;
  }
}

const CO_IF_CAN_DRV can = {nothing, set_rate, read, [](CO_IF_FRM* from) { return send(from); }, nothing, nothing};
const CO_IF_TIMER_DRV timer = {set_rate, reload, delay, stop, nothing, update};
CO_IF_DRV drivers = {&can, &timer, nullptr};

#else

// A timer with a clock, which is polled.
std::uint32_t clock_ticks = 0;

void nothing(void*) {}
void set_rate(void*, std::uint32_t) {}

void pass(std::uint32_t ticks) { clock_ticks += ticks; }

const CO_IF_CAN_DRV_EX can = {nothing,
                              set_rate,
                              [](void*, CO_IF_FRM* to) { return read(to); },
                              [](void*, const CO_IF_FRM* from) { return send(from); },
                              nothing,
                              nothing,
                              nullptr,
                              nullptr};
const CO_IF_TIMER_DRV_EX timer = {set_rate, [](void*) { return clock_ticks; }, nullptr};

#endif

}  // namespace

void init_node(CO_NODE_SPEC& spec) {
#ifdef BENCH_CLASSIC_DRIVERS
  spec.Drv = &drivers;
  CONodeInit(&node, &spec);
#else
  static CO_NODE_EXT settings;  // must live as long as the node
  settings.Size = sizeof settings;
  settings.Can = &can;
  settings.Timer = &timer;
  CONodeInitCtx(&node, &spec, &settings);
#endif
}

CO_IF_FRM frame(std::uint32_t identifier, std::initializer_list<std::uint8_t> data) {
  CO_IF_FRM made = {identifier, {}, 0};
  for (const std::uint8_t byte : data) {
    made.Data[made.DLC++] = byte;
  }
  return made;
}

void receive(const CO_IF_FRM& frame) {
  if (received_next == received_num) {
    received_next = 0;
    received_num = 0;
  }
  if (received_num == places) {
    fail("bus", "too many frames wait");
  }
  received_frames[received_num++] = frame;
}

std::size_t sent() { return sent_num; }
const CO_IF_FRM& sent(std::size_t place) { return sent_frames[place]; }
void forget_sent() { sent_num = 0; }

bool is_same(const CO_IF_FRM& a, const CO_IF_FRM& b) {
  bool same = a.Identifier == b.Identifier && a.DLC == b.DLC;
  for (std::size_t n = 0; n < a.DLC && same; ++n) {
    same = a.Data[n] == b.Data[n];
  }
  return same;
}

bool has_sent(const CO_IF_FRM& frame) { return sent_num == 1 && is_same(sent_frames[0], frame); }

void elapse() { pass(CONodeNextDeadline(&node)); }

void advance(std::uint32_t ticks) {
  for (std::uint32_t wait = CONodeNextDeadline(&node); wait <= ticks; wait = CONodeNextDeadline(&node)) {
    ticks -= wait;
    pass(wait);
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
  }
  pass(ticks);
}

}  // namespace bench
