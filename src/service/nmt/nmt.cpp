// SPDX-License-Identifier: Apache-2.0
#include "service/nmt/nmt.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "base/gate.hpp"
#include "base/routes.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "wire/nmt.hpp"

namespace co::nmt {
namespace {

// Services that are allowed in each mode. [301:7.3.2.2.4] CO_NMT_ALLOWED includes error control: heartbeat and
// guarding.
constexpr uint8_t error_control = CO_NMT_ALLOWED | CO_LSS_ALLOWED;
constexpr uint8_t configured = error_control | CO_SDO_ALLOWED | CO_SYNC_ALLOWED | CO_TIME_ALLOWED | CO_EMCY_ALLOWED;
constexpr uint8_t permissions[CO_MODE_NUM] = {
    0,                                 // CO_INVALID
    CO_BOOT_ALLOWED | CO_LSS_ALLOWED,  // CO_INIT
    configured,                        // CO_PREOP
    configured | CO_PDO_ALLOWED,       // CO_OPERATIONAL
    error_control,                     // CO_STOP
};

struct Command {
  wire::NmtCommand specifier;
  uint8_t reset;  // event::Pending; 0: none
  CO_MODE mode;
};

// Commands of the NMT master. [301:7.3.2.1 figure 46] A command for the present state has no effect.
constexpr Command commands[] = {
    {wire::NmtCommand::start, 0, CO_OPERATIONAL},
    {wire::NmtCommand::stop, 0, CO_STOP},
    {wire::NmtCommand::enter_pre_operational, 0, CO_PREOP},
    {wire::NmtCommand::reset_node, event::reset_node, CO_INIT},
    {wire::NmtCommand::reset_communication, event::reset_communication, CO_INIT},
};

// Asks the access hook of the application, if there is one.
bool is_permitted([[maybe_unused]] CO_NODE& node, [[maybe_unused]] const CO_IF_FRM& frame) {
#if USE_ACCESS_HOOK
  const CO_ACCESS_NMT access = {frame.Data[0], frame.Data[1]};
  return gate::ask(node, &CO_CALLBACKS::AccessNmt, access) == 0;
#else
  return true;
#endif
}

// Executes a command; a reset takes effect after the frame was processed. Unknown commands are ignored.
void obey(CO_NODE& node, const CO_IF_FRM& frame) {
  for (const Command& command : commands) {
    if (static_cast<uint8_t>(command.specifier) != frame.Data[0] || !is_permitted(node, frame)) {
      continue;
    }
    if (command.reset != 0) {
      event::defer(node, command.reset | event::commanded);
    } else {
      event::request_mode(node, command.mode);
    }
  }
}

}  // namespace

uint8_t allowed_in(CO_MODE mode) {
  CO_ASSERT(mode < CO_MODE_NUM);
  return permissions[mode];
}

void init(CO_NODE& node) { routes::add(node, static_cast<uint32_t>(wire::CobId::nmt), routes::owner<PartId::nmt>(0)); }

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t) {
  if (frame.DLC != wire::nmt_dlc) {
    return false;
  }
  if (wire::addresses(frame, node.NodeId)) {
    obey(node, frame);
  }
  return true;
}

void boot(CO_NODE& node) {
  transmit::send_ahead(node, wire::boot_up(node.NodeId));
  event::request_mode(node, CO_PREOP);
}

}  // namespace co::nmt

using namespace co;

extern "C" {

void CONmtReset(CO_NMT* nmt, CO_NMT_RESET type) {
  ASSERT_PTR_FATAL(nmt);
  ASSERT_PTR_FATAL(nmt->Node);
  if (type == CO_RESET_NODE) {
    event::defer(*nmt->Node, event::reset_node);
  } else if (type == CO_RESET_COM) {
    event::defer(*nmt->Node, event::reset_communication);
  }
  event::run_deferred(*nmt->Node);
}

void CONmtSetMode(CO_NMT* nmt, CO_MODE mode) {
  ASSERT_PTR_FATAL(nmt);
  ASSERT_PTR_FATAL(nmt->Node);
  CO_NODE& node = *nmt->Node;
  const bool initialising = nmt->Next == CO_INIT && event::is_serving(node);
  const bool unconfigured = !wire::is_node_id(node.NodeId);
  const bool stopped = nmt->Mode == CO_INVALID || nmt->Next == CO_INVALID;
  if (stopped || initialising || unconfigured || mode < CO_PREOP || mode >= CO_MODE_NUM) {
    error::report(node, CO_ERR_NMT_MODE);
    return;
  }
  if (nmt->Mode == CO_INIT && nmt->Next == CO_INIT) {
    nmt::boot(node);
    event::run_deferred(node);
  }
  event::request_mode(node, mode);
  event::run_deferred(node);
}

CO_MODE CONmtGetMode(CO_NMT* nmt) {
  ASSERT_PTR_FATAL_ERR(nmt, CO_INVALID);
  const bool is_requested = nmt->Node != nullptr && (nmt->Node->Pending & event::mode) != 0;
  return is_requested ? nmt->Next : nmt->Mode;
}

void CONmtSetNodeId(CO_NMT* nmt, uint8_t nodeId) {
  ASSERT_PTR_FATAL(nmt);
  ASSERT_PTR_FATAL(nmt->Node);
  if (nmt->Mode != CO_INIT) {
    error::report(*nmt->Node, CO_ERR_NMT_MODE);
  } else if (nodeId < 1 || nodeId > 127) {
    error::report(*nmt->Node, CO_ERR_BAD_ARG);
  } else {
    event::change_node_id(*nmt->Node, nodeId);
  }
}

uint8_t CONmtGetNodeId(CO_NMT* nmt) {
  ASSERT_PTR_FATAL_ERR(nmt, 0);
  ASSERT_PTR_FATAL_ERR(nmt->Node, 0);
  return nmt->Node->NodeId;
}

CO_MODE CONmtModeDecode(uint8_t code) {
  for (unsigned mode = CO_INIT; mode < CO_MODE_NUM; ++mode) {
    if (wire::heartbeat_states[mode] == code) {
      return static_cast<CO_MODE>(mode);
    }
  }
  return CO_INVALID;
}

uint8_t CONmtModeEncode(CO_MODE mode) { return wire::heartbeat_state(mode); }

}  // extern "C"
