// SPDX-License-Identifier: Apache-2.0
#include "service/lss/lss.hpp"

#if USE_LSS

#include "base/access_hook.hpp"
#include "base/callbacks.hpp"
#include "base/error.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/state_machine.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "storage/budget.hpp"
#include "wire/lss.hpp"

namespace co::lss {
namespace {

using wire::Lss;

enum class State : uint8_t { waiting, configuration, count };

using Handler = void (*)(CO_NODE& node, const CO_IF_FRM& request);

// Error codes of the services 11h, 13h and 17h.
constexpr uint32_t not_supported = 1;
constexpr uint32_t medium = 2;
constexpr uint32_t manufacturers_error = 255;
constexpr uint32_t budget_used_up = manufacturers_error | 0x2200;  // 22h as in SDO abort 0800 0022h

bool is_unconfigured(const CO_NODE& node) { return node.NodeId == wire::no_node_id; }

// The LSS address: sub-indices 1…4 of 1018h.
constexpr uint32_t key_of(unsigned part) { return CO_DEV(0x1018, part + 1U); }
uint32_t part_of(CO_NODE& node, unsigned part) { return dict::read_number(node, key_of(part), sizeof(uint32_t), 0); }

// Sends a frame. An unconfigured node is in Initialisation and sends nothing else.
void send(CO_NODE& node, const CO_IF_FRM& frame) {
  node.Nmt.Mode == CO_INIT ? transmit::send_ahead(node, frame) : static_cast<void>(transmit::send(node, frame));
}

void answer(CO_NODE& node, Lss command) {
  send(node, wire::lss_frame(wire::lss_answer, static_cast<uint8_t>(command)));
}

void answer(CO_NODE& node, const CO_IF_FRM& request, uint32_t data) {
  CO_IF_FRM frame = wire::lss_frame(wire::lss_answer, request.Data[0]);
  wire::put_u32(frame.Data + 1, data);
  send(node, frame);
}

// Enters an LSS state. The state waiting starts an unconfigured node that has received a node-ID.
void enter(CO_NODE& node, State state) {
  CO_LSS& lss = node.Lss;
  const bool configured = lss.Started != 0 && lss.CfgNodeId != wire::no_node_id;
  lss.Mode = state == State::waiting ? CO_LSS_WAIT : CO_LSS_CONF;
  lss.Selected = 0;
  event::change_lss(node);
  if (state == State::waiting && configured) {
    event::defer(node, event::reset_communication);
  }
}

// Access hook --------------------------------------------------------------------------------------------------------

// Parameters of a service that changes the node; 0 if the service has no such parameter.
struct Change {
  uint8_t state;  // CO_LSS_WAIT, CO_LSS_CONF
  uint8_t node_id;
  uint32_t rate;
};

// Calls the access hook. Returns 0, or the error code of the response, with the manufacturer's code in the next byte.
// Refuses also if the application has stopped the node.
uint32_t ask_application([[maybe_unused]] CO_NODE& node, [[maybe_unused]] CO_ACCESS_LSS& access) {
#if USE_ACCESS_HOOK
  const uint8_t error = access_hook::ask(node, &CO_CALLBACKS::AccessLss, access);
  const bool is_stopped = node.Nmt.Next == CO_INVALID;
  return error == manufacturers_error || is_stopped ? manufacturers_error | uint32_t{access.Specific} << 8 : error;
#else
  return 0;
#endif
}

uint32_t ask_application([[maybe_unused]] CO_NODE& node, [[maybe_unused]] const CO_IF_FRM& request,
                         [[maybe_unused]] Change change) {
#if USE_ACCESS_HOOK
  CO_ACCESS_LSS access = {};
  access.Service = request.Data[0];
  access.State = change.state;
  access.NodeId = change.node_id;
  access.Baudrate = change.rate;
  return ask_application(node, access);
#else
  return 0;
#endif
}

bool may_enter(CO_NODE& node, const CO_IF_FRM& request, State state) {
  return ask_application(node, request,
                         {static_cast<uint8_t>(state == State::waiting ? CO_LSS_WAIT : CO_LSS_CONF), 0, 0}) == 0;
}

// [305] Switch state global, selective -------------------------------------------------------------------------------

void switch_global(CO_NODE& node, const CO_IF_FRM& request) {
  const State state = request.Data[1] == 0 ? State::waiting : State::configuration;
  if (request.Data[1] <= 1 && may_enter(node, request, state)) {
    enter(node, state);
  }
}

// Processes a part of the address. The parts have to arrive in their order; any other part restarts the sequence.
void switch_selective(CO_NODE& node, const CO_IF_FRM& request) {
  CO_LSS& lss = node.Lss;
  const unsigned part = request.Data[0] - static_cast<unsigned>(Lss::switch_selective);
  const bool matches = (part == 0 || part == lss.Selected) && wire::get_u32(request.Data + 1) == part_of(node, part);
  lss.Selected = static_cast<uint8_t>(matches ? part + 1 : 0);
  if (lss.Selected == wire::lss_address_parts && may_enter(node, request, State::configuration)) {
    enter(node, State::configuration);
    answer(node, Lss::selected);
  }
}

// Configure ----------------------------------------------------------------------------------------------------------

void configure_node_id(CO_NODE& node, const CO_IF_FRM& request) {
  const uint8_t id = request.Data[1];
  const uint32_t error = wire::may_be_configured(id) ? ask_application(node, request, {0, id, 0}) : not_supported;
  node.Lss.CfgNodeId = error == 0 ? id : node.Lss.CfgNodeId;
  answer(node, request, error);
}

void configure_bit_timing(CO_NODE& node, const CO_IF_FRM& request) {
  const uint32_t rate = request.Data[1] == 0 ? wire::bit_rate(request.Data[2]) : 0;
  const uint32_t error = rate != 0 ? ask_application(node, request, {0, 0, rate}) : not_supported;
  node.Lss.CfgBaudrate = error == 0 ? rate : node.Lss.CfgBaudrate;
  answer(node, request, error);
}

void end_switch(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  event::end_switching(node);
  transmit::flush(node);
}

// Calls a function after the switch delay.
void call_after_delay(CO_NODE& node, CO_TMR_FUNC then) {
  if (node.Lss.Delay == 0) {
    then(&node);
  } else {
    tmr::start(node, node.Lss.Tmr, node.Lss.Delay, 0, then, &node);
  }
}

void switch_rate(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  event::set_bit_rate(node, node.Baudrate);
  call_after_delay(node, end_switch);
}

// Enters the NMT state in which the bit rate is switched, if the node is in Operational, Pre-operational or Stopped.
// Returns false if the application has stopped the node.
bool prepare_switch(CO_NODE& node, CO_MODE mode) {
  if (node.Nmt.Mode > CO_INIT && mode > CO_INIT && mode < CO_MODE_NUM) {
    event::request_mode(node, mode);
    event::enter_requested_mode(node);
  }
  return node.Nmt.Next != CO_INVALID;
}

// Activates the bit rate: disables transmission, switches after the delay, and enables transmission after another
// delay. The node leaves Operational first, because it must not process PDOs of a bus that it is about to leave.
void activate_bit_timing(CO_NODE& node, const CO_IF_FRM& request) {
  const uint16_t delay = wire::get_u16(request.Data + 1);
  CO_ACCESS_LSS access = {};
  access.Service = CO_LSS_SERVICE_ACTIVATE;
  access.Baudrate = node.Lss.CfgBaudrate;
  access.Delay = delay;
  access.Mode = event::mode_for_switch(node);
  if (ask_application(node, access) != 0 || !prepare_switch(node, access.Mode)) {
    return;
  }
  const uint32_t ticks = tmr::ticks(node, delay, CO_TMR_UNIT_1MS);
  node.Lss.Delay = delay != 0 && ticks == 0 ? UINT32_MAX : ticks;
  node.Baudrate = node.Lss.CfgBaudrate;  // kept by CO_NODE.Baudrate, because a reset may load other values meanwhile
  node.Transmit.Off |= event::switching;
  call_after_delay(node, switch_rate);
}

uint32_t code_of(CO_ERR err) {
  switch (err) {
    case CO_ERR_NONE: return 0;
    case CO_ERR_LSS_NO_STORE: return not_supported;
    case CO_ERR_OBJ_STATE: return budget_used_up;
    default: return medium;
  }
}

// Stores node-ID and bit rate. Returns an error code of LSS.
uint32_t store_pending(CO_NODE& node) {
  const budget::Command counted(node);
  const CO_ERR err = callback::store_lss(node, node.Lss.CfgBaudrate, node.Lss.CfgNodeId);
  if (err != CO_ERR_NONE) {
    error::report(node, CO_ERR_LSS_STORE);
  }
  return code_of(err);
}

void store(CO_NODE& node, const CO_IF_FRM& request) {
  uint32_t error = ask_application(node, request, {0, node.Lss.CfgNodeId, node.Lss.CfgBaudrate});
  if (error == 0) {
    error = store_pending(node);
  }
  answer(node, request, error);
}

// Inquire, identify --------------------------------------------------------------------------------------------------

void inquire(CO_NODE& node, const CO_IF_FRM& request) {
  answer(node, request, part_of(node, request.Data[0] - static_cast<unsigned>(Lss::inquire)));
}

void inquire_node_id(CO_NODE& node, const CO_IF_FRM& request) { answer(node, request, node.NodeId); }

// Returns whether the request with this number, 0…5 for 46h…4Bh, matches the address: vendor-ID and product code have
// to be equal; revision and serial number within the lowest (even number) and highest limit.
bool is_identified(CO_NODE& node, unsigned step, uint32_t value) {
  constexpr uint8_t parts[] = {0, 1, 2, 2, 3, 3};
  constexpr uint8_t first_limit = 2;
  const uint32_t own = part_of(node, parts[step]);
  const bool lowest = step % 2 == 0;
  if (step < first_limit) {
    return own == value;
  }
  return lowest ? own >= value : own <= value;
}

void identify(CO_NODE& node, const CO_IF_FRM& request) {
  CO_LSS& lss = node.Lss;
  const unsigned step = request.Data[0] - static_cast<unsigned>(Lss::identify);
  const bool in_order = step == 0 || step == lss.Identified;
  const bool matches = in_order && is_identified(node, step, wire::get_u32(request.Data + 1));
  lss.Identified = static_cast<uint8_t>(matches ? step + 1 : 0);
  if (lss.Identified == wire::lss_identify_parts) {
    lss.Identified = 0;
    answer(node, Lss::identified);
  }
}

void identify_unconfigured(CO_NODE& node, const CO_IF_FRM&) {
  if (is_unconfigured(node) && node.Lss.CfgNodeId == wire::no_node_id) {
    answer(node, Lss::unconfigured);
  }
}

// Processes a fastscan. When all bits of a part have matched, the next part follows; the last one selects the node.
void fastscan(CO_NODE& node, const CO_IF_FRM& request) {
  CO_LSS& lss = node.Lss;
  const wire::Fastscan scan = wire::get_fastscan(request);
  if (!is_unconfigured(node) || lss.CfgNodeId != wire::no_node_id) {
    return;
  }
  if (scan.bit == wire::fastscan_begin) {
    lss.Scanned = 0;
    answer(node, Lss::identified);
    return;
  }
  if (!wire::is_possible(scan) || scan.part != lss.Scanned || !wire::is_match(scan, part_of(node, scan.part))) {
    return;
  }
  const bool is_selected = scan.bit == 0 && scan.next < scan.part;
  if (is_selected && !may_enter(node, request, State::configuration)) {
    return;
  }
  CO_ASSERT(scan.part < wire::lss_address_parts && scan.next < wire::lss_address_parts);
  lss.Scanned = scan.bit == 0 ? scan.next : lss.Scanned;
  if (is_selected) {
    enter(node, State::configuration);
  }
  answer(node, Lss::identified);
}

constexpr uint8_t both = in(State::waiting, State::configuration);
constexpr uint8_t waiting = in(State::waiting);
constexpr uint8_t configuration = in(State::configuration);

// A service: its command specifiers, and the states in which it is valid. Others are ignored.
struct Row {
  Lss first;
  uint8_t num;
  uint8_t states;
  Handler run;
};

constexpr Row rows[] = {
    {Lss::switch_global, 1, both, switch_global},
    {Lss::switch_selective, wire::lss_address_parts, waiting, switch_selective},
    {Lss::configure_node_id, 1, configuration, configure_node_id},
    {Lss::configure_bit_timing, 1, configuration, configure_bit_timing},
    {Lss::activate_bit_timing, 1, configuration, activate_bit_timing},
    {Lss::store, 1, configuration, store},
    {Lss::inquire, wire::lss_address_parts, configuration, inquire},
    {Lss::inquire_node_id, 1, configuration, inquire_node_id},
    {Lss::identify, wire::lss_identify_parts, both, identify},
    {Lss::identify_unconfigured, 1, both, identify_unconfigured},
    {Lss::fastscan, 1, waiting, fastscan},
};

void process_request(CO_NODE& node, const CO_IF_FRM& request) {
  const auto state = node.Lss.Mode == CO_LSS_CONF ? State::configuration : State::waiting;
  for (const Row& row : rows) {
    const unsigned part = request.Data[0] - static_cast<unsigned>(row.first);
    if (part < row.num && (row.states & in(state)) != 0) {
      row.run(node, request);
      return;
    }
  }
}

// Returns whether 1018h has all four parts of the LSS address. Without them the node is no LSS slave.
bool has_address(CO_NODE& node) {
  unsigned part = 0;
  while (part < wire::lss_address_parts && dict::find(node, key_of(part)) != nullptr) {
    ++part;
  }
  return part == wire::lss_address_parts;
}

// Returns whether LSS services are processed: after CONodeStart(), in Operational depending on CO_LSS_IN_OPERATIONAL.
bool is_served(const CO_NODE& node) {
  const CO_MODE mode = node.Nmt.Mode;
  return mode == CO_INIT ? node.Lss.Started != 0 : CO_LSS_IN_OPERATIONAL != 0 || mode != CO_OPERATIONAL;
}

}  // namespace

void begin(CO_NODE& node) {
  node.Lss.Node = &node;
  node.Lss.OwnBaudrate = node.Baudrate;
  node.Lss.OwnNodeId = node.NodeId;
  load(node);
  take_node_id(node);
  node.Baudrate = node.Lss.CfgBaudrate;
}

void load(CO_NODE& node) {
  CO_LSS& lss = node.Lss;
  uint32_t baud = lss.OwnBaudrate;
  uint8_t id = lss.OwnNodeId;
  const bool loaded = callback::load_lss(node, baud, id) == CO_ERR_NONE && wire::may_be_configured(id);
  if (!loaded) {
    error::report(node, CO_ERR_LSS_LOAD);
  }
  lss.CfgBaudrate = loaded ? baud : lss.OwnBaudrate;
  lss.CfgNodeId = loaded ? id : lss.OwnNodeId;
}

void take_node_id(CO_NODE& node) { node.NodeId = node.Lss.CfgNodeId; }

void change_node_id(CO_NODE& node, uint8_t id) {
  node.Lss.OwnNodeId = id;
  node.Lss.CfgNodeId = id;
}

bool is_waiting(const CO_NODE& node) { return node.Lss.Started != 0; }

bool awaits_node_id(CO_NODE& node) {
  node.Lss.Started = is_unconfigured(node) ? 1 : 0;
  event::change_lss(node);
  return node.Lss.Started != 0;
}

void init(CO_NODE& node) {
  CO_LSS& lss = node.Lss;
  lss.Mode = CO_LSS_WAIT;
  lss.Selected = 0;
  lss.Identified = 0;
  lss.Scanned = 0;
  if (has_address(node)) {
    routes::add(node, wire::lss_request, routes::owner<PartId::lss>(0));
  }
}

void on_mode(CO_NODE& node) {
  if (node.Nmt.Mode == CO_INVALID) {
    tmr::stop(node, node.Lss.Tmr);
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t) {
  if (frame.DLC != wire::lss_dlc) {
    return false;
  }
  if (node.Transmit.Off == 0 && is_served(node)) {
    process_request(node, frame);
  }
  return true;
}

}  // namespace co::lss

// Default callbacks.
extern "C" {

WEAK CO_ERR COLssLoad(uint32_t*, uint8_t*) { return CO_ERR_NONE; }

WEAK CO_ERR COLssStore(uint32_t, uint8_t) { return CO_ERR_LSS_NO_STORE; }

}  // extern "C"

#endif
