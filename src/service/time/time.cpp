// SPDX-License-Identifier: Apache-2.0
#include "service/time/time.hpp"

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/cob_id.hpp"
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

using namespace co;

extern "C" {

// Default callbacks.
WEAK void COTimeUpdate(CO_NODE*, const CO_TIME_OF_DAY*) {}

CO_ERR COTimeSend(CO_NODE* node) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return time::send(*node);
}

CO_ERR COTimeProduce(CO_NODE* node, uint32_t ms) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  const uint32_t ticks = tmr::ticks(*node, ms, CO_TMR_UNIT_1MS);
  if (ms != 0 && ticks == 0) {
    return CO_ERR_BAD_ARG;
  }
  tmr::stop(*node, node->Time.SendTmr);
  node->Time.Period = ticks;
  time::run_producer(*node);
  return CO_ERR_NONE;
}

}  // extern "C"

#endif
