// SPDX-License-Identifier: Apache-2.0
#include "service/heartbeat/heartbeat.hpp"

#include "base/events.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/parameter.hpp"
#include "wire/nmt.hpp"

namespace co::heartbeat {
namespace {

bool is_allowed(const CO_NODE& node) { return event::is_allowed(node, CO_NMT_ALLOWED); }

void send(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  transmit::send_latest(node, wire::error_control(node.NodeId, node.Nmt.Mode));
}

uint32_t period(const CO_NODE& node, uint32_t ms) { return tmr::ticks(node, ms, CO_TMR_UNIT_1MS); }

void restart(CO_NODE& node, uint32_t ticks) {
  if (ticks == 0) {
    tmr::stop(node, node.HbProdTmr);
  } else {
    tmr::start(node, node.HbProdTmr, 0, ticks, send, &node);
  }
}

// 1017h, producer heartbeat time. [301:7.5.2.20]
void apply(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t) {
  if (is_allowed(node)) {
    restart(node, period(node, value));
  }
}

}  // namespace

// Starts the producer at the boot-up message, which counts as the first heartbeat; it runs in all NMT states.
void on_mode(CO_NODE& node) {
  if (!is_allowed(node)) {
    tmr::stop(node, node.HbProdTmr);
    return;
  }
  if (!tmr::is_running(node.HbProdTmr)) {
    restart(node, period(node, dict::read_number(node, CO_DEV(0x1017, 0), sizeof(uint16_t), 0)));
  }
}

}  // namespace co::heartbeat

extern "C" const CO_OBJ_TYPE COTNmtHbProd =
    co::parameter<2, co::rules::heartbeat_producer, co::fits_timer<CO_TMR_UNIT_1MS>, co::heartbeat::apply>;
