// SPDX-License-Identifier: Apache-2.0
// The NMT state machine: commands of the NMT master, requests of the application, changes of the state, boot-up,
// self-start and resets. [301:7.2.8, 7.3.2]
#include "node/mode.hpp"

#include "base/access_hook.hpp"
#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/routes.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/parameter.hpp"
#include "hal/port.hpp"
#include "node/node.hpp"
#include "node/parts.hpp"
#include "wire/nmt.hpp"

namespace co::nmt {
namespace {

// Services that are allowed in each state. [301:7.3.2.2.4] CO_NMT_ALLOWED includes error control: heartbeat and
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
  return access_hook::ask(node, &CO_CALLBACKS::AccessNmt, access) == 0;
#else
  return true;
#endif
}

// Executes a command; a reset takes effect after the frame was processed. Unknown commands are ignored.
void execute_command(CO_NODE& node, const CO_IF_FRM& frame) {
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

// Returns whether 1F80h exists and requests the self-start.
bool starts_itself(CO_NODE& node) {
  return (dict::read_number(node, CO_DEV(0x1F80, 0), sizeof(uint32_t), CO_NMT_STARTUP_STAY) & CO_NMT_STARTUP_STAY) == 0;
}

// Enters an NMT state: sets the permissions, then informs every part.
void enter(CO_NODE& node, CO_MODE mode) {
  CO_ASSERT(mode < CO_MODE_NUM);
  node.Nmt.Mode = mode;
  node.State = static_cast<uint8_t>(mode == CO_INVALID ? node.State & ~event::running : node.State | event::running);
  node.Nmt.Allowed = permissions[mode];
  parts::run<&Part::of_mode>(node);
  if (mode == CO_INVALID) {
    transmit::clear(node, false);
    node.Transmit.Paused = 0;
    node.Pending = 0;
    node.Transmit.Off = 0;
    port::can_close(node);
  }
}

// Calls CONmtModeChange() and enters the state, unless the callback has requested another one.
void announce_and_enter(CO_NODE& node, CO_MODE next) {
  callback::change_mode(node, next);
  if (next == node.Nmt.Next) {
    enter(node, next);
  }
}

void boot(CO_NODE& node) {
  transmit::send_ahead(node, wire::boot_up(node.NodeId));
  event::request_mode(node, CO_PREOP);
}

// Sends the boot-up message and requests Pre-operational; a node without node-ID stays in Initialisation. [305]
void start(CO_NODE& node) {
  if (!parts::ask<&Part::of_awaits_node_id>(false, node)) {
    boot(node);
  }
}

// Resets the node. commanded: a reset by the NMT master drops the queued frames; a reset by the application still sends
// the SDO responses among them, as it may have been requested by a write, and NMT commands to other nodes.
void reset(CO_NODE& node, CO_NMT_RESET type, bool commanded) {
  const bool was_initialising = node.Nmt.Mode == CO_INIT;
  const bool waits_for_start = was_initialising && !parts::ask<&Part::of_is_waiting>(false, node);
  transmit::clear(node, !commanded);
  event::request_mode(node, CO_INIT);
  event::enter_requested_mode(node);
  if (node.Nmt.Mode != CO_INIT) {
    return;
  }
  if (!was_initialising) {
    transmit::withdraw(node, transmit::all_frames);  // messages of the last state
  }
  port::can_reset(node);
  parts::run<&Part::of_reset>(node);
  const bool is_ready = node::initialise(node, type);
  event::forget_resets(node);
  if (is_ready && !waits_for_start) {
    start(node);
    event::enter_requested_mode(node);
  }
}

}  // namespace

void init(CO_NODE& node) { routes::add(node, static_cast<uint32_t>(wire::CobId::nmt), routes::owner<PartId::nmt>(0)); }

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t) {
  if (frame.DLC != wire::nmt_dlc) {
    return false;
  }
  if (wire::addresses(frame, node.NodeId)) {
    execute_command(node, frame);
  }
  return true;
}

// Executes the self-start if the first state after Initialisation is Pre-operational. It is another one if
// CONmtModeChange() has requested it, which has priority over the self-start.
void on_mode(CO_NODE& node) {
  CO_NMT& nmt = node.Nmt;
  const bool first = nmt.Booting != 0;
  nmt.Booting = nmt.Mode == CO_INIT ? 1 : 0;
  if (first && nmt.Mode == CO_PREOP && starts_itself(node)) {
    event::request_mode(node, CO_OPERATIONAL);
  }
}

// Runs a deferred reset. pending: bits of event::Pending
void run_reset(CO_NODE& node, uint8_t pending) {
  const bool commanded = (pending & event::commanded) != 0;
  const CO_NMT_RESET type = (pending & event::reset_node) != 0 ? CO_RESET_NODE : CO_RESET_COM;
  if (type == CO_RESET_NODE) {
    parts::run<&Part::of_reset_node>(node);
  }
  reset(node, type, commanded);
  if (commanded && node.Nmt.Mode != CO_INVALID) {
    callback::request_reset(node, type);
  }
}

}  // namespace co::nmt

namespace co {

// Enters the requested NMT state, if it is another one. A state that CONmtModeChange() or a part requests replaces
// the one to be entered, or follows the one just entered. Messages that were deferred before are sent before, because
// the next state may not permit them. Resets that are requested while the node is started are dropped.
void event::enter_requested_mode(CO_NODE& node) {
  CO_NMT& nmt = node.Nmt;
  const bool starts = nmt.Mode == CO_INIT;
  while ((node.Pending & event::mode) != 0) {
    event::send_deferred(node);
    event::remove(node, event::mode);
    if (nmt.Next != nmt.Mode) {
      nmt::announce_and_enter(node, nmt.Next);
    }
  }
  if (starts) {
    event::forget_resets(node);
  }
}

void event::request_mode(CO_NODE& node, CO_MODE requested) {
  if (node.Nmt.Next != requested && node.Nmt.Next != CO_INVALID) {
    node.Nmt.Next = requested;
    node.Transmit.Off = requested == CO_INVALID ? uint8_t{stopping} : node.Transmit.Off;
    defer(node, mode);
  }
}

}  // namespace co

extern "C" {

void CONodeStart(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  if (node->Nmt.Mode == CO_INIT && node->Nmt.Next == CO_INIT && !co::event::is_working(*node)) {
    co::nmt::start(*node);
  }
  co::event::run_deferred(*node);
}

void CONodeStop(CO_NODE* node) {
  ASSERT_PTR_FATAL(node);
  co::event::request_mode(*node, CO_INVALID);
  co::event::run_deferred(*node);
}

void CONmtReset(CO_NMT* nmt, CO_NMT_RESET type) {
  ASSERT_PTR_FATAL(nmt);
  ASSERT_PTR_FATAL(nmt->Node);
  if (type == CO_RESET_NODE) {
    co::event::defer(*nmt->Node, co::event::reset_node);
  } else if (type == CO_RESET_COM) {
    co::event::defer(*nmt->Node, co::event::reset_communication);
  }
  co::event::run_deferred(*nmt->Node);
}

void CONmtSetMode(CO_NMT* nmt, CO_MODE mode) {
  ASSERT_PTR_FATAL(nmt);
  ASSERT_PTR_FATAL(nmt->Node);
  CO_NODE& node = *nmt->Node;
  const bool initialising = nmt->Next == CO_INIT && co::event::is_working(node);
  const bool unconfigured = !co::wire::is_node_id(node.NodeId);
  const bool stopped = nmt->Mode == CO_INVALID || nmt->Next == CO_INVALID;
  if (stopped || initialising || unconfigured || mode < CO_PREOP || mode >= CO_MODE_NUM) {
    co::error::report(node, CO_ERR_NMT_MODE);
    return;
  }
  if (nmt->Mode == CO_INIT && nmt->Next == CO_INIT) {
    co::nmt::boot(node);
    co::event::run_deferred(node);
  }
  co::event::request_mode(node, mode);
  co::event::run_deferred(node);
}

CO_MODE CONmtGetMode(CO_NMT* nmt) {
  ASSERT_PTR_FATAL_ERR(nmt, CO_INVALID);
  const bool is_requested = nmt->Node != nullptr && (nmt->Node->Pending & co::event::mode) != 0;
  return is_requested ? nmt->Next : nmt->Mode;
}

void CONmtSetNodeId(CO_NMT* nmt, uint8_t nodeId) {
  ASSERT_PTR_FATAL(nmt);
  ASSERT_PTR_FATAL(nmt->Node);
  if (nmt->Mode != CO_INIT) {
    co::error::report(*nmt->Node, CO_ERR_NMT_MODE);
  } else if (nodeId < 1 || nodeId > 127) {
    co::error::report(*nmt->Node, CO_ERR_BAD_ARG);
  } else {
    co::event::change_node_id(*nmt->Node, nodeId);
  }
}

uint8_t CONmtGetNodeId(CO_NMT* nmt) {
  ASSERT_PTR_FATAL_ERR(nmt, 0);
  ASSERT_PTR_FATAL_ERR(nmt->Node, 0);
  return nmt->Node->NodeId;
}

CO_MODE CONmtModeDecode(uint8_t code) {
  for (unsigned mode = CO_INIT; mode < CO_MODE_NUM; ++mode) {
    if (co::wire::heartbeat_states[mode] == code) {
      return static_cast<CO_MODE>(mode);
    }
  }
  return CO_INVALID;
}

uint8_t CONmtModeEncode(CO_MODE mode) { return co::wire::heartbeat_state(mode); }

}  // extern "C"

namespace co::node {
namespace {

// Refuses a change of any bit except CO_NMT_STARTUP_STAY: the others belong to an NMT master.
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  return ((value ^ before) & ~uint32_t{CO_NMT_STARTUP_STAY}) != 0 ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

}  // namespace
}  // namespace co::node

extern "C" const CO_OBJ_TYPE COTNmtStartup = co::parameter<4, co::rules::nmt_startup, co::node::may_replace>;
