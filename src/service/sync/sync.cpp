// SPDX-License-Identifier: Apache-2.0
#include "service/sync/sync.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

#if USE_SYNC

namespace co::sync {
namespace {

using event::Fault;

constexpr uint32_t microseconds = 1000000;
constexpr uint16_t id_index = 0x1005;
constexpr uint16_t cycle_index = 0x1006;
constexpr uint16_t window_index = 0x1007;
constexpr uint8_t lowest_overflow = 2;
constexpr uint8_t highest_overflow = 240;
constexpr uint32_t producer = CO_SYNC_COBID_ON;

uint32_t read(CO_NODE& node, uint16_t index) { return dict::read_number(node, CO_DEV(index, 0), sizeof(uint32_t), 0); }

uint32_t ticks(const CO_NODE& node, uint32_t time) { return tmr::ticks(node, time, microseconds); }

void end_window(void* node_pointer) { event::end_sync_window(*static_cast<CO_NODE*>(node_pointer)); }

// Allows synchronous PDOs again before the next SYNC: the window has changed, or SYNC is not allowed any more.
void open_window(CO_NODE& node) {
  tmr::stop(node, node.Sync.WindowTmr);
  node.WindowOver = 0;
}

void set_window(CO_NODE& node, uint32_t time) {
  node.Sync.Window = ticks(node, time);
  open_window(node);
}

void process(CO_NODE& node, uint8_t counter) {
  if (node.Sync.Window != 0 && event::is_allowed(node, CO_SYNC_ALLOWED)) {
    tmr::start(node, node.Sync.WindowTmr, node.Sync.Window, 0, end_window, &node);
  }
  event::sync(node, counter);
}

// Sends a SYNC and processes it.
void produce(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  CO_SYNC& sync = node.Sync;
  const bool counted = sync.Overflow != 0;
  sync.Counter = static_cast<uint8_t>(!counted || sync.Counter >= sync.Overflow ? 0 : sync.Counter);
  sync.Counter = static_cast<uint8_t>(sync.Counter + (counted ? 1 : 0));
  CO_IF_FRM frame = wire::empty_frame(sync.Identifier, counted ? 1 : 0);
  frame.Data[0] = sync.Counter;
  transmit::send_latest(node, frame);
  process(node, sync.Counter);
}

// Returns whether a period is below the limit; 0 means that no SYNC is produced.
bool is_too_short(uint32_t period) { return period != 0 && period < CO_SYNC_PERIOD_MIN; }

// Starts or stops the producer. The first SYNC is sent after one period. The counter continues if only the period has
// changed.
void run_producer(CO_NODE& node) {
  CO_SYNC& sync = node.Sync;
  const uint32_t time = read(node, cycle_index);
  const uint32_t period = is_too_short(time) ? 0 : ticks(node, time);
  if (sync.Produces == 0 || period == 0 || !event::is_allowed(node, CO_SYNC_ALLOWED)) {
    tmr::stop(node, sync.Tmr);
    return;
  }
  tmr::start(node, sync.Tmr, 0, period, produce, &node);
}

// Raises or resolves the fault sync_length, which remains until a SYNC has the right length.
void check_length(CO_NODE& node, bool right) {
  CO_SYNC& sync = node.Sync;
  if (!right && sync.Wrong == 0) {
    sync.Wrong = 1;
    event::raise(node, Fault::sync_length, 0);
  } else if (right && sync.Wrong != 0) {
    sync.Wrong = 0;
    event::resolve(node, Fault::sync_length, 0);
  }
}

// Reads 1005h and applies it. Bit 31 of 1005h has no meaning. [301:7.5.2.5]
void configure(CO_NODE& node) {
  CO_SYNC& sync = node.Sync;
  const uint32_t cob_id = read(node, id_index) & ~wire::cob_invalid;
  sync.Identifier = cob_id::identifier(cob_id);
  sync.Produces = sync.Identifier != wire::no_frame && (cob_id & producer) != 0 ? 1 : 0;
  routes::change(node, sync.Identifier, routes::owner<PartId::sync>(0));
  run_producer(node);
}

// Objects ------------------------------------------------------------------------------------------------------------

// Checks a COB-ID. A producer cannot change its CAN-ID, but may become a consumer.
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  constexpr uint32_t own_bits = ~(producer | wire::cob_invalid);
  const bool same = ((before ^ value) & own_bits) == 0;
  return same || ((before & producer) == 0 && cob_id::is_free(value)) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

void apply_id(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t before) {
  if (value != before) {
    configure(node);
    routes::publish(node);
  }
}

bool is_window(const CO_OBJ& obj) { return (obj.Key & CO_DEV(cycle_index ^ window_index, 0)) != 0; }

// Check and apply 1006h (communication cycle period) or 1007h (synchronous window length), in µs.

CO_ERR fits_cycle(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before) {
  return !is_window(obj) && is_too_short(value) ? CO_ERR_OBJ_RANGE_LOW
                                                : fits_timer<microseconds>(node, obj, value, before);
}

void apply_cycle(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t) {
  if (is_window(obj)) {
    set_window(node, value);
  } else {
    run_producer(node);
  }
}

// Check and apply 1019h. Its value can change only while the cycle period is 0. [301:7.5.2.22]

CO_ERR may_count(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t) {
  if (value != 0 && (value < lowest_overflow || value > highest_overflow)) {
    return CO_ERR_OBJ_RANGE;
  }
  return value != node.Sync.Overflow && read(node, cycle_index) != 0 ? CO_ERR_OBJ_STATE : CO_ERR_NONE;
}

void apply_counter(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t) {
  if (value != node.Sync.Overflow) {
    node.Sync.Overflow = static_cast<uint8_t>(value);
    node.Sync.Counter = 0;
  }
}

}  // namespace

void init(CO_NODE& node) {
  CO_SYNC& sync = node.Sync;
  sync.Counter = 0;
  sync.Wrong = 0;
  sync.Overflow = static_cast<uint8_t>(dict::read_number(node, CO_DEV(0x1019, 0), sizeof sync.Overflow, 0));
  set_window(node, read(node, window_index));
  configure(node);
  if (sync.Produces != 0 && is_too_short(read(node, cycle_index))) {
    error::report(node, CO_ERR_OBJ_RANGE_LOW, CO_DEV(cycle_index, 0));
  }
}

void take_over(CO_NODE& node, const CO_NODE_SPEC&) {
  tmr::assign_to_real_time(node.Sync.Tmr);
  tmr::assign_to_real_time(node.Sync.WindowTmr);
}

void on_mode(CO_NODE& node) {
  if (!event::is_allowed(node, CO_SYNC_ALLOWED)) {
    tmr::stop(node, node.Sync.Tmr);
    open_window(node);
    transmit::withdraw(node, node.Sync.Identifier);
    node.Sync.Counter = 0;
  } else if (!tmr::is_running(node.Sync.Tmr)) {
    run_producer(node);
  }
}

// A producer ignores SYNC messages of other nodes. [301:7.2.5.1]
bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t) {
  if (node.Sync.Produces != 0) {
    return false;
  }
  const bool right = frame.DLC == (node.Sync.Overflow != 0 ? 1 : 0);
  check_length(node, right);
  process(node, right ? frame.Data[0] : static_cast<uint8_t>(0));
  return right;
}

}  // namespace co::sync

extern "C" {

const CO_OBJ_TYPE COTSyncId =
    co::parameter<co::integer::cob_id, co::rules::sync_cob_id, co::sync::may_replace, co::sync::apply_id>;
const CO_OBJ_TYPE COTSyncCycle = co::parameter<4, co::rules::sync_cycle, co::sync::fits_cycle, co::sync::apply_cycle>;
const CO_OBJ_TYPE COTSyncCount =
    co::parameter<1, co::rules::sync_counter, co::sync::may_count, co::sync::apply_counter>;

}  // extern "C"

#endif
