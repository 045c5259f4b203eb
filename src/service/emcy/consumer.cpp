// SPDX-License-Identifier: Apache-2.0
// EMCY consumer: the sub-index of 1028h is the node-ID, its value the COB-ID. [301:7.5.2.30]
#include "service/emcy/emcy.hpp"

#if CO_EMCY_CONS_N > 0

#include "base/callbacks.hpp"
#include "base/routes.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "wire/cob_id.hpp"
#include "wire/emcy.hpp"

namespace co::emcy {
namespace {

constexpr uint32_t key(uint8_t node_id) { return CO_DEV(0x1028, node_id); }

// Adds or changes the route of a producer to the COB-ID in 1028h; removes it if that is not valid.
void update_route(CO_NODE& node, uint8_t node_id) {
  const uint32_t cob_id = dict::read_number(node, key(node_id), sizeof cob_id, wire::cob_invalid);
  routes::change(node, cob_id::identifier(cob_id), routes::owner<PartId::emcy_consumer>(node_id - 1U));
}

CO_ERR may_replace_producer(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  return cob_id::may_replace(before, value) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

void apply_producer(CO_NODE& node, CO_OBJ& obj, uint32_t, uint32_t) {
  const uint8_t node_id = CO_GET_SUB(obj.Key);
  if (node.Nmt.Mode != CO_INVALID && dict::is_number(node_id - 1U, CO_EMCY_CONS_N)) {
    update_route(node, node_id);
    routes::publish(node);
  }
}

}  // namespace

void init_consumer(CO_NODE& node) {
  for (uint8_t node_id = 1; node_id <= CO_EMCY_CONS_N; ++node_id) {
    update_route(node, node_id);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  if (frame.DLC != wire::emcy_dlc) {
    return false;
  }
  callback::receive_emcy(node, static_cast<uint8_t>(number + 1), wire::emcy_code(frame), wire::emcy_register(frame),
                         wire::emcy_bytes(frame));
  return true;
}

}  // namespace co::emcy

extern "C" const CO_OBJ_TYPE COTEmcyCons = co::parameter<co::integer::cob_id, co::rules::emcy_consumer,
                                                         co::emcy::may_replace_producer, co::emcy::apply_producer>;

#endif
