// SPDX-License-Identifier: Apache-2.0
#include "service/time/time.hpp"

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"
#include "wire/time.hpp"

#if USE_TIME

namespace co::time {
namespace {

bool produces(const CO_NODE& node) { return node.Time.Identifier != wire::no_frame; }
bool is_allowed(const CO_NODE& node) { return event::is_allowed(node, CO_TIME_ALLOWED); }

CO_ERR send(CO_NODE& node) {
  if (!produces(node)) {
    return CO_ERR_OBJ_STATE;
  }
  if (!is_allowed(node)) {
    return CO_ERR_NMT_MODE;
  }
  if (!is_set(node)) {
    return CO_ERR_OBJ_NO_DATA;
  }
  CO_IF_FRM frame = wire::empty_frame(node.Time.Identifier, wire::time_bytes);
  wire::put_time(frame.Data, read_clock(node));
  return transmit::send_process_data(node, frame) ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND;
}

void send(void* node_pointer) { static_cast<void>(send(*static_cast<CO_NODE*>(node_pointer))); }

// Starts or stops the producer: its period runs while TIME may be sent.
void run_producer(CO_NODE& node) {
  CO_TIME& time = node.Time;
  const bool runs = time.Period != 0 && produces(node) && is_allowed(node);
  if (!runs) {
    tmr::stop(node, time.SendTmr);
  } else if (!tmr::is_running(time.SendTmr)) {
    tmr::start(node, time.SendTmr, 0, time.Period, send, &node);
  }
}

}  // namespace

// Bit 31 of 1012h selects the consumer (CO_TIME_COBID_CONSUME); it does not mean that the COB-ID is not valid.
void init(CO_NODE& node) {
  const uint32_t cob_id = dict::read_number(node, CO_DEV(0x1012, 0), sizeof cob_id, 0);
  const uint32_t identifier = cob_id::identifier(cob_id & ~CO_TIME_COBID_CONSUME);
  const bool consumes = (cob_id & CO_TIME_COBID_CONSUME) != 0;
  flush(node);
  node.Time.Identifier = (cob_id & CO_TIME_COBID_PRODUCE) != 0 ? identifier : wire::no_frame;
  routes::change(node, consumes ? identifier : wire::no_frame, routes::owner<PartId::time>(0));
  run_producer(node);
}

void on_mode(CO_NODE& node) {
  if (!is_allowed(node)) {
    flush(node);
    stop_high_res(node);
  }
  run_producer(node);
  if (node.Nmt.Mode == CO_INVALID) {
    stop_clock(node);
  }
}

void flush(CO_NODE& node) { transmit::withdraw(node, node.Time.Identifier); }

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t) {
  const CO_TIME_OF_DAY time = wire::get_time(frame.Data);
  if (frame.DLC != wire::time_bytes || set_clock(node, time) != CO_ERR_NONE) {
    return false;
  }
  callback::update_time(node, time);
  return true;
}

}  // namespace co::time

extern "C" {

// Default callbacks.
WEAK void COTimeUpdate(CO_NODE*, const CO_TIME_OF_DAY*) {}

CO_ERR COTimeSend(CO_NODE* node) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return co::time::send(*node);
}

CO_ERR COTimeProduce(CO_NODE* node, uint32_t ms) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  const uint32_t ticks = co::tmr::ticks(*node, ms, CO_TMR_UNIT_1MS);
  if (ms != 0 && ticks == 0) {
    return CO_ERR_BAD_ARG;
  }
  co::tmr::stop(*node, node->Time.SendTmr);
  node->Time.Period = ticks;
  co::time::run_producer(*node);
  return CO_ERR_NONE;
}

}  // extern "C"

// 1012h, and the clock as an object.

namespace co::time {
namespace {

// COB-ID TIME. [301:7.5.2.15]

// Checks a COB-ID. A consumer or producer cannot change its CAN-ID.
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  constexpr uint32_t exists = CO_TIME_COBID_CONSUME | CO_TIME_COBID_PRODUCE;
  const bool same = ((before ^ value) & ~exists) == 0;
  const bool is_new = (before & exists) == 0 && (value == before || cob_id::is_free(value));
  return is_new || ((before & exists) != 0 && same) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

void apply(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) {
  if (node.Nmt.Mode != CO_INVALID) {
    time::init(node);
    routes::publish(node);
  }
}

// The clock has no variable: the bytes that are read and written are those of a TIME message.

uint32_t size(CO_OBJ*, CO_NODE*, uint32_t) { return wire::time_bytes; }

CO_ERR read(CO_OBJ*, CO_NODE* node, void* buffer, uint32_t size) {
  if (size != wire::time_bytes) {
    return CO_ERR_BAD_ARG;
  }
  auto* const to = static_cast<uint8_t*>(buffer);
  wire::put_time(to, time::read_clock(*node));
  wire::swap_host(to, wire::time_bytes);
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ*, CO_NODE* node, void* buffer, uint32_t size) {
  if (size != wire::time_bytes) {
    return CO_ERR_BAD_ARG;
  }
  uint8_t from[wire::time_bytes];
  __builtin_memcpy(from, buffer, sizeof from);
  wire::swap_host(from, sizeof from);
  const CO_TIME_OF_DAY time = wire::get_time(from);
  return wire::is_time_of_day(time) ? time::set_clock(*node, time) : CO_ERR_OBJ_RANGE;
}

}  // namespace
}  // namespace co::time

extern "C" {

const CO_OBJ_TYPE COTTimeId =
    co::parameter<co::integer::cob_id, co::rules::time_cob_id, co::time::may_replace, co::time::apply>;
const CO_OBJ_TYPE COTTimeClock = {co::time::size, nullptr, co::time::read, co::time::write, nullptr};

}  // extern "C"

#endif
