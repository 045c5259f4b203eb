// SPDX-License-Identifier: Apache-2.0
// Queue of EMCY messages that wait for the end of the API call, the inhibit time or the transmit queue. [301:7.2.7.1]
#include "service/emcy/emcy.hpp"

#include "base/error.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "wire/cob_id.hpp"
#include "wire/emcy.hpp"

#if USE_EMCY && CO_EMCY_QUEUE_N > 0

namespace co::emcy {
namespace {

void remove_first(CO_EMCY& emcy) {
  --emcy.Waiting;
  for (unsigned n = 0; n < emcy.Waiting; ++n) {
    emcy.Queue[n] = emcy.Queue[n + 1];
  }
}

// Returns the inhibit time in units of 100 µs; 0: none.
unsigned inhibit_time(CO_NODE& node) { return dict::read_number(node, node.Emcy.InhibitEntry, sizeof(uint16_t), 0); }

void on_time(void* node_pointer);

// Sends queued messages until the inhibit time starts; if the transmit queue is full, tries again later.
void send_until_inhibited(CO_NODE& node, uint32_t identifier) {
  constexpr unsigned next_attempt = 10;  // x 100 µs
  CO_EMCY& emcy = node.Emcy;
  while (emcy.Waiting != 0) {
    unsigned pause = next_attempt;
    if (!transmit::is_waiting(node) || !transmit::is_full(node)) {
      const CO_IF_FRM frame = wire::emcy(identifier, emcy.Queue[0].Low, emcy.Queue[0].High);
      remove_first(emcy);
      transmit::send(node, frame);
      pause = inhibit_time(node);
    }
    if (pause != 0) {
      const uint32_t ticks = tmr::ticks(node, pause, CO_TMR_UNIT_100US);  // 0: beyond the timer's range
      tmr::start(node, emcy.Tmr, ticks != 0 ? ticks : UINT32_MAX, 0, on_time, &node);
      return;
    }
  }
}

// Ends the inhibit time.
void on_time(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  const uint32_t id = identifier(node);
  if (id == wire::no_frame) {
    withdraw(node, id);
  } else {
    send_until_inhibited(node, id);
  }
}

}  // namespace

// In a full queue the message replaces the newest one, so that the last message always reports the present state.
void send_message(CO_NODE& node, uint32_t low, uint32_t high) {
  CO_EMCY& emcy = node.Emcy;
  if (tmr::is_running(emcy.Tmr) && identifier(node) == wire::no_frame) {
    return;
  }
  if (emcy.Waiting == CO_EMCY_QUEUE_N) {
    send_waiting(node);
  }
  if (emcy.Waiting == CO_EMCY_QUEUE_N) {
    count(node.Count.Dropped);
    --emcy.Waiting;
  }
  emcy.Queue[emcy.Waiting++] = {low, high};
  event::defer(node, event::send_emcy);
}

// Messages that were queued while there is no identifier are forgotten, not dropped. A callback of another service may
// report an error in a state that forbids messages, before on_mode() has dropped those of the last state.
void send_waiting(CO_NODE& node) {
  const bool is_allowed = event::is_allowed(node, CO_EMCY_ALLOWED);
  if (node.Emcy.Waiting == 0 || tmr::is_running(node.Emcy.Tmr) || !is_allowed) {
    return;
  }
  const uint32_t id = identifier(node);
  if (id == wire::no_frame) {
    node.Emcy.Waiting = 0;
  } else {
    send_until_inhibited(node, id);
  }
}

void stop_inhibit_time(CO_NODE& node) { tmr::stop(node, node.Emcy.Tmr); }

void withdraw(CO_NODE& node, uint32_t identifier) {
  for (; node.Emcy.Waiting != 0; --node.Emcy.Waiting) {
    count(node.Count.Dropped);
  }
  transmit::withdraw(node, identifier);
}

}  // namespace co::emcy

#endif
