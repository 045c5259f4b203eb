// SPDX-License-Identifier: Apache-2.0
#include "service/gfc/gfc.hpp"

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/parameter.hpp"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"

#if USE_GFC

namespace co::gfc {
namespace {

constexpr uint32_t identifier = static_cast<uint32_t>(wire::CobId::gfc);

bool is_used(CO_NODE& node) { return dict::read_number(node, CO_DEV(0x1300, 0), sizeof(uint8_t), 0) == 1; }

bool is_operational(const CO_NODE& node) { return event::is_allowed(node, CO_PDO_ALLOWED); }

CO_ERR send(CO_NODE& node) {
  if (!is_operational(node)) {
    return CO_ERR_NMT_MODE;
  }
  if (!is_used(node)) {
    return CO_ERR_OBJ_STATE;
  }
  return transmit::send_latest(node, wire::empty_frame(identifier, 0)) ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND;
}

CO_ERR may_use(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before) {
  return is_operational(node) ? CO_ERR_OBJ_STATE : at_most<1>(node, obj, value, before);
}

void apply(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) {
  if (node.Nmt.Mode != CO_INVALID) {
    init(node);
    routes::publish(node);
  }
}

}  // namespace

void init(CO_NODE& node) {
  routes::change(node, is_used(node) ? identifier : wire::no_frame, routes::owner<PartId::gfc>(0));
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, [[maybe_unused]] uint16_t number) {
  CO_ASSERT(number == 0);
  if (frame.DLC != 0) {
    return false;
  }
  callback::receive_gfc(node);
  return true;
}

}  // namespace co::gfc

extern "C" {

// Default callbacks.
WEAK void COGfcReceived(CO_NODE*) {}

const CO_OBJ_TYPE COTGfc = co::parameter<1, co::rules::global_fail_safe, co::gfc::may_use, co::gfc::apply>;

CO_ERR COGfcSend(CO_NODE* node) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return co::gfc::send(*node);
}

}  // extern "C"

#endif
