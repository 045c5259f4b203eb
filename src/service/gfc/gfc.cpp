// SPDX-License-Identifier: Apache-2.0
#include "service/gfc/gfc.hpp"

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/integer.hpp"
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
  const bool is_queued = transmit::is_waiting(node) && transmit::find_waiting(node, identifier) != nullptr;
  const bool sent = is_queued || transmit::send(node, wire::empty_frame(identifier, 0));
  return sent ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND;
}

uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) { return integer::Number<1>::size(obj, node, width); }

CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return integer::Number<1>::read(obj, node, buffer, size);
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (is_operational(*node)) {
    return CO_ERR_OBJ_STATE;
  }
  if (size != 1 || *static_cast<const uint8_t*>(buffer) > 1) {
    return size != 1 ? CO_ERR_BAD_ARG : CO_ERR_OBJ_RANGE;
  }
  const CO_ERR err = integer::Number<1>::write(obj, node, buffer, size);
  if (err == CO_ERR_NONE && node->Nmt.Mode != CO_INVALID) {
    init(*node);
    routes::publish(*node);
  }
  return err;
}

}  // namespace

void init(CO_NODE& node) { routes::change(node, is_used(node) ? identifier : wire::no_frame, routes::Service::gfc, 0); }

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, [[maybe_unused]] uint16_t number) {
  CO_ASSERT(number == 0);
  if (frame.DLC != 0) {
    return false;
  }
  callback::receive_gfc(node);
  return true;
}

}  // namespace co::gfc

using namespace co;

extern "C" {

// Default callbacks.
WEAK void COGfcReceived(CO_NODE*) {}

const CO_OBJ_TYPE COTGfc = {gfc::size, dict::checked_by<rules::global_fail_safe>, gfc::read, gfc::write, nullptr};

CO_ERR COGfcSend(CO_NODE* node) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  return gfc::send(*node);
}

}  // extern "C"

#endif
