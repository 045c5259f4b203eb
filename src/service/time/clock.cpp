// SPDX-License-Identifier: Apache-2.0
// The clock: a past time (CO_TIME.Past) and the timer's ticks at that time (Tick). Both advance by whole seconds, which
// are a whole number of ticks, so that no rounding error adds up.
#include "base/timer.hpp"
#include "service/time/time.hpp"
#include "wire/time.hpp"

#if USE_TIME

namespace co::time {
namespace {

CO_TIME_OF_DAY later(const CO_TIME_OF_DAY& time, uint32_t days, uint32_t ms) {
  CO_TIME_OF_DAY sum = {time.Ms + ms, static_cast<uint16_t>(time.Days + days)};
  if (sum.Ms >= wire::ms_per_day) {
    sum.Ms -= wire::ms_per_day;
    ++sum.Days;
  }
  return sum;
}

// Advances the clock by the whole seconds that have elapsed. Returns the remaining ticks.
uint32_t advance_clock(CO_NODE& node) {
  constexpr uint32_t seconds_per_day = wire::ms_per_day / 1000;
  uint32_t seconds = 0;
  const uint32_t ticks = take_seconds(node, node.Time.Tick, seconds);
  node.Time.Past = later(node.Time.Past, seconds / seconds_per_day, seconds % seconds_per_day * 1000);
  return ticks;
}

void advance_clock(void* node_pointer) { advance_clock(*static_cast<CO_NODE*>(node_pointer)); }

}  // namespace

uint32_t take_seconds(CO_NODE& node, uint32_t& tick, uint32_t& seconds) {
  const uint32_t passed = tmr::now(node) - tick;
  seconds = passed / node.Tmr.Freq;
  const uint32_t ticks = seconds * node.Tmr.Freq;
  tick += ticks;
  return passed - ticks;
}

// Digit by digit, because the ticks times 10^digits may exceed 32 bits.
uint32_t fraction_of_second(uint32_t ticks, uint32_t freq, unsigned digits) {
  uint32_t fraction = 0;
  for (; digits != 0; --digits) {
    ticks *= 10;
    fraction = fraction * 10 + ticks / freq;
    ticks %= freq;
  }
  return fraction;
}

bool is_set(const CO_NODE& node) { return tmr::is_running(node.Time.Tmr); }

CO_TIME_OF_DAY read_clock(CO_NODE& node) {
  if (!is_set(node)) {
    return {0, 0};
  }
  const uint32_t ticks = advance_clock(node);
  return later(node.Time.Past, 0, fraction_of_second(ticks, node.Tmr.Freq, 3));
}

CO_ERR set_clock(CO_NODE& node, const CO_TIME_OF_DAY& time) {
  const uint32_t second = node.Tmr.Freq;
  if (!wire::is_time_of_day(time)) {
    return CO_ERR_BAD_ARG;
  }
  if (node.Nmt.Mode == CO_INVALID) {
    return CO_ERR_NMT_MODE;
  }
  if (second == 0) {
    return CO_ERR_TMR_CREATE;
  }
  tmr::start(node, node.Time.Tmr, 0, second, advance_clock, &node);
  node.Time.Past = time;
  node.Time.Tick = tmr::now(node);
  return CO_ERR_NONE;
}

void stop_clock(CO_NODE& node) { tmr::stop(node, node.Time.Tmr); }

}  // namespace co::time

extern "C" {

CO_ERR COTimeSet(CO_NODE* node, const CO_TIME_OF_DAY* time) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(time, CO_ERR_BAD_ARG);
  return co::time::set_clock(*node, *time);
}

CO_ERR COTimeGet(CO_NODE* node, CO_TIME_OF_DAY* time) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(time, CO_ERR_BAD_ARG);
  *time = co::time::read_clock(*node);
  return co::time::is_set(*node) ? CO_ERR_NONE : CO_ERR_OBJ_NO_DATA;
}

}  // extern "C"

#endif
