// SPDX-License-Identifier: Apache-2.0
#include "service/heartbeat/heartbeat.hpp"

#include "base/events.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/types/integer.hpp"
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

// 1017h, producer heartbeat time. [301:7.5.2.20] The basic type stores the value.

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (size != sizeof(uint16_t)) {
    return CO_ERR_BAD_ARG;
  }
  const uint16_t ms = integer::get_u16(buffer);
  const uint32_t ticks = period(*node, ms);
  if (ms != 0 && ticks == 0) {
    return CO_ERR_OBJ_RANGE;
  }
  const CO_ERR err = integer::Number<2>::write(obj, node, buffer, size);
  if (err == CO_ERR_NONE && is_allowed(*node)) {
    restart(*node, ticks);
  }
  return err;
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

extern "C" const CO_OBJ_TYPE COTNmtHbProd = {co::integer::Number<2>::size,
                                             co::dict::checked_by<co::rules::heartbeat_producer>,
                                             co::integer::Number<2>::read, co::heartbeat::write, nullptr};
