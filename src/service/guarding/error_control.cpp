// SPDX-License-Identifier: Apache-2.0
// Receives frames with the identifier of the node's own error control messages (700h + node-ID).
#include "base/error.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "service/guarding/guarding.hpp"
#include "wire/cob_id.hpp"

namespace co::guarding {

void init(CO_NODE& node) {
  routes::add(node, wire::CobId::error_control + node.NodeId, routes::owner<PartId::error_control>(0));
  if constexpr (USE_GUARDING != 0) {
    reset(node);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM&, uint16_t) {
  if (node.Error == CO_ERR_NONE) {  // the bus does not replace an error that was not read yet
    error::report(node, CO_ERR_NODE_ID_TWICE);
  }
  event::raise(node, event::Fault::collision, node.NodeId);
  return false;
}

}  // namespace co::guarding
