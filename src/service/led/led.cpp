// SPDX-License-Identifier: Apache-2.0
#include "service/led/led.hpp"

#include "base/callbacks.hpp"
#include "base/timer.hpp"
#include "co_assert.h"

#if USE_LED

namespace co::led {
namespace {

constexpr uint32_t step = 50;         // ms, the shortest phase
constexpr uint32_t all_over = 24000;  // ms, a multiple of all periods

// A number of flashes at the begin of a period; each lasts one phase and is followed by a dark phase.
struct Pattern {
  uint8_t phase;    // ms
  uint8_t flashes;  // in a period
  uint8_t period;   // phases
};

constexpr Pattern off = {200, 0, 1};
constexpr Pattern on = {200, 1, 1};
constexpr Pattern blinking = {200, 1, 2};
constexpr Pattern flickering = {50, 1, 2};
constexpr Pattern flashing(uint8_t flashes) { return {200, flashes, static_cast<uint8_t>(2 * flashes + 4)}; }

constexpr bool is_steady(const Pattern& pattern) { return pattern.period == 1; }

// Returns whether the LED is lit. late: phases by which the pattern is delayed
bool is_lit(const Pattern& pattern, uint32_t ms, uint8_t late) {
  CO_ASSERT(late < pattern.period || is_steady(pattern));
  const uint32_t phase = (ms / pattern.phase + pattern.period - late) % pattern.period;
  return phase % 2 == 0 && phase < 2U * pattern.flashes;
}

// Patterns of conditions; the first matching row is used.
struct Row {
  uint8_t what;
  Pattern pattern;
};

constexpr Row run_rows[] = {{CO_LED_LSS, flickering}, {CO_LED_DOWNLOAD, flashing(3)}};
constexpr Row error_rows[] = {
    {CO_LED_BUS_OFF, on},          {CO_LED_LSS, flickering},      {CO_LED_PDO, flashing(4)}, {CO_LED_SYNC, flashing(3)},
    {CO_LED_CONTROL, flashing(2)}, {CO_LED_WARNING, flashing(1)}, {CO_LED_CONFIG, blinking},
};
constexpr Pattern by_mode[CO_MODE_NUM] = {off, off, blinking, on, flashing(1)};

template <size_t rows>
Pattern find(const Row (&table)[rows], uint8_t what, const Pattern& otherwise) {
  for (const Row& row : table) {
    if ((row.what & what) != 0) {
      return row.pattern;
    }
  }
  return otherwise;
}

Pattern run_of(const CO_LED_STATE& state) {
  return find(run_rows, state.What, state.Mode < CO_MODE_NUM ? by_mode[state.Mode] : off);
}

Pattern error_of(const CO_LED_STATE& state) { return find(error_rows, state.What, off); }

uint8_t leds_at(const CO_LED_STATE& state, uint32_t ms) {
  const bool green = is_lit(run_of(state), ms, 0);
  const bool red = is_lit(error_of(state), ms, 1);
  return static_cast<uint8_t>((green ? CO_LED_RUN : 0) | (red ? CO_LED_ERR : 0));
}

// Returns the LSS condition: configuration, or waiting for a node-ID.
unsigned lss_of([[maybe_unused]] const CO_NODE& node) {
#if USE_LSS
  const bool waits = node.Nmt.Mode == CO_INIT && node.Lss.Started != 0;
  return waits || node.Lss.Mode == CO_LSS_CONF ? CO_LED_LSS : 0;
#else
  return 0;
#endif
}

CO_LED_STATE state_of(const CO_NODE& node) {
  const CO_LED& led = node.Led;
  const unsigned faults =
      (led.Control != 0 ? CO_LED_CONTROL : 0) | (led.Pdo != 0 ? CO_LED_PDO : 0) | (led.Sync != 0 ? CO_LED_SYNC : 0);
  return {node.Nmt.Mode, static_cast<uint8_t>(faults | lss_of(node) | led.Can | led.Set)};
}

void show(CO_NODE& node, uint8_t leds) {
  if (node.Led.Shown != leds) {
    node.Led.Shown = leds;
    callback::change_leds(node, leds);
  }
}

void tick(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  CO_LED& led = node.Led;
  led.Phase = static_cast<uint16_t>((led.Phase + step) % all_over);
  show(node, leds_at(state_of(node), led.Phase));
}

// Starts or stops the timer, which runs while an LED blinks or flashes.
void run_timer(CO_NODE& node, bool runs) {
  CO_LED& led = node.Led;
  const uint32_t ticks = tmr::ticks(node, step, CO_TMR_UNIT_1MS);
  if (!runs || ticks == 0) {
    tmr::stop(node, led.Tmr);
  } else if (!tmr::is_running(led.Tmr)) {
    led.Phase = 0;
    tmr::start(node, led.Tmr, 0, ticks, tick, &node);
  }
}

void stop(CO_NODE& node) {
  run_timer(node, false);
  if (node.Led.On != 0) {
    node.Led.On = 0;
    show(node, 0);
  }
}

// Condition that each fault sets, or 0.
constexpr uint8_t conditions[] = {
#define CO_CONDITION(fault, code, led) led,
    CO_FAULTS(CO_CONDITION)
#undef CO_CONDITION
};

uint16_t* counter_of(CO_LED& led, event::Fault fault) {
  switch (conditions[static_cast<uint8_t>(fault)]) {
    case CO_LED_CONTROL: return &led.Control;
    case CO_LED_SYNC: return &led.Sync;
    case CO_LED_PDO: return &led.Pdo;
    default: return nullptr;
  }
}

}  // namespace

void update(CO_NODE& node) {
  if (node.Led.On == 0) {
    return;
  }
  const CO_LED_STATE state = state_of(node);
  run_timer(node, !is_steady(run_of(state)) || !is_steady(error_of(state)));
  show(node, leds_at(state, node.Led.Phase));
}

void init(CO_NODE& node) {
  CO_LED& led = node.Led;
  led.Control = led.Pdo = led.Sync = 0;
  led.Can = 0;
  update(node);
}

void on_mode(CO_NODE& node) { node.Nmt.Mode == CO_INVALID ? stop(node) : update(node); }

void report_can(CO_NODE& node, CO_CAN_EVENT what) {
  switch (what) {
    case CO_CAN_PASSIVE: node.Led.Can |= CO_LED_WARNING; break;
    case CO_CAN_BUS_OFF: node.Led.Can |= CO_LED_BUS_OFF; break;
    case CO_CAN_RECOVERED: node.Led.Can = 0; break;
    default: return;
  }
  update(node);
}

void change_fault(CO_NODE& node, event::Fault fault, event::Change change, uint32_t) {
  uint16_t* const counter = counter_of(node.Led, fault);
  const bool come = change == event::Change::occurred;
  if (counter != nullptr && (come || *counter != 0)) {
    *counter = static_cast<uint16_t>(*counter + (come ? 1 : -1));
    update(node);
  }
}

}  // namespace co::led

extern "C" {

// Default callbacks.
WEAK void COLedChange(CO_NODE*, uint8_t) {}

uint8_t COLedPattern(const CO_LED_STATE* state, uint32_t ms) {
  ASSERT_PTR_ERR(state, 0);
  return co::led::leds_at(*state, ms);
}

void COLedStart(CO_NODE* node) {
  constexpr uint8_t never = 0xFF;
  ASSERT_PTR_FATAL(node);
  if (node->Nmt.Mode == CO_INVALID || node->Led.On != 0) {
    return;
  }
  node->Led.On = 1;
  node->Led.Shown = never;
  co::led::update(*node);
}

void COLedSet(CO_NODE* node, uint8_t what, bool on) {
  ASSERT_PTR_FATAL(node);
  CO_LED& led = node->Led;
  led.Set = static_cast<uint8_t>(on ? led.Set | what : led.Set & ~what);
  co::led::update(*node);
}

}  // extern "C"

#endif
