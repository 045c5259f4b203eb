// SPDX-License-Identifier: Apache-2.0
// Commands of an NMT master. [301:7.2.8.2.1]
#include "co_nmt.h"

#include "base/events.hpp"
#include "base/transmit.hpp"
#include "wire/nmt.hpp"

#if USE_NMT_MASTER

namespace co::nmt {
namespace {

constexpr uint8_t all_nodes = 0;

void execute(CO_NMT& nmt, CO_NMT_COMMAND command) {
  switch (command) {
    case CO_NMT_COMMAND_START: CONmtSetMode(&nmt, CO_OPERATIONAL); break;
    case CO_NMT_COMMAND_STOP: CONmtSetMode(&nmt, CO_STOP); break;
    case CO_NMT_COMMAND_PREOP: CONmtSetMode(&nmt, CO_PREOP); break;
    case CO_NMT_COMMAND_RESET_NODE: CONmtReset(&nmt, CO_RESET_NODE); break;
    case CO_NMT_COMMAND_RESET_COM: CONmtReset(&nmt, CO_RESET_COM); break;
  }
}

CO_ERR command(CO_NODE& node, CO_NMT_COMMAND command, uint8_t node_id) {
  const bool own = node_id == node.NodeId;
  if (!event::is_allowed(node, CO_NMT_ALLOWED)) {
    return CO_ERR_NMT_MODE;
  }
  if (!own && !transmit::send_for_application(node, wire::nmt_command(static_cast<uint8_t>(command), node_id))) {
    return CO_ERR_IF_CAN_SEND;
  }
  if (own || node_id == all_nodes) {
    execute(node.Nmt, command);
  }
  return CO_ERR_NONE;
}

bool is_command(CO_NMT_COMMAND command) {
  switch (command) {
    case CO_NMT_COMMAND_START:
    case CO_NMT_COMMAND_STOP:
    case CO_NMT_COMMAND_PREOP:
    case CO_NMT_COMMAND_RESET_NODE:
    case CO_NMT_COMMAND_RESET_COM: return true;
  }
  return false;
}

}  // namespace
}  // namespace co::nmt

extern "C" CO_ERR CONmtCommand(CO_NMT* nmt, CO_NMT_COMMAND command, uint8_t nodeId) {
  ASSERT_PTR_ERR(nmt, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(nmt->Node, CO_ERR_BAD_ARG);
  if (!co::nmt::is_command(command) || nodeId > 127) {
    return CO_ERR_BAD_ARG;
  }
  return co::nmt::command(*nmt->Node, command, nodeId);
}

#endif
