// SPDX-License-Identifier: Apache-2.0
#include "service/lss/lss.hpp"

#if USE_LSS_MASTER

#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "wire/lss.hpp"

namespace co::lss_master {
namespace {

using wire::Lss;

// State of a service: the event that it awaits. From answer on responses are evaluated, from found on those of any
// slave.
enum class State : uint8_t {
  idle,
  sending,    // the gap before the next frame of a request
  leaving,    // end of the gap after a request without response
  silent,     // end of the delay before the switch of the bit rate
  switched,   // end of the delay after the switch, for slower nodes
  answer,     // response of one slave
  found,      // responses of the identified slaves
  begun,      // fastscan: a slave without node-ID responds
  scanned,    // fastscan: a slave whose bit is 0 responds
  confirmed,  // fastscan: a slave with this number responds
};

constexpr uint32_t gap = 1;  // ms, between frames
constexpr uint8_t highest_bit = 31;

State state_of(const CO_LSSM& master) { return static_cast<State>(master.State); }
void set_state(CO_LSSM& master, State state) { master.State = static_cast<uint8_t>(state); }

bool is_awaiting(const CO_LSSM& master) { return state_of(master) >= State::answer; }
bool is_looking(const CO_LSSM& master) { return state_of(master) >= State::found; }
bool is_switching(const CO_LSSM& master) {
  return state_of(master) == State::silent || state_of(master) == State::switched;
}

// Returns the time of the present state in ms. Number[0] is the switch delay of "activate bit timing".
uint32_t time_of(const CO_LSSM& master) {
  if (is_looking(master)) {
    return master.Listen != 0 ? master.Listen : CO_LSSM_LISTEN_MS;
  }
  if (is_awaiting(master)) {
    return master.Timeout != 0 ? master.Timeout : CO_LSSM_TIMEOUT_MS;
  }
  return is_switching(master) && master.Number[0] != 0 ? master.Number[0] : gap;
}

void on_time(void* master_pointer);

// Enters a state and starts its time. Times beyond the timer's range are limited to the longest time.
void enter_state(CO_LSSM& master, State state) {
  CO_NODE& node = *master.Node;
  set_state(master, state);
  const uint32_t ticks = tmr::ticks(node, time_of(master), CO_TMR_UNIT_1MS);
  tmr::start(node, master.Tmr, ticks != 0 ? ticks : UINT32_MAX, 0, on_time, &master);
}

// Ends the service and calls its callback. Must be the last action: the callback may start the next service.
void finish(CO_LSSM& master, CO_LSSM_RESULT result) {
  CO_NODE& node = *master.Node;
  if (is_switching(master)) {
    event::end_switching(node);
  }
  tmr::stop(node, master.Tmr);
  set_state(master, State::idle);
  master.Call(&master, result);
}

// Sends a frame and starts the time of the next state. Returns false, without any change, if the frame was not sent.
[[nodiscard]] bool send(CO_LSSM& master, const CO_IF_FRM& frame, State then) {
  const bool sent = transmit::send_for_application(*master.Node, frame);
  if (sent) {
    master.Heard = 0;
    enter_state(master, then);
  }
  return sent;
}

void end_unless(bool sent, CO_LSSM& master) {
  if (!sent) {
    finish(master, CO_LSSM_NOT_SENT);
  }
}

// Requests of frames that carry a number each ------------------------------------------------------------------------

struct Request {
  unsigned command;  // command specifier of the first frame; those of the others are consecutive
  uint8_t frames;
  Lss answer;
  State then;
};

constexpr unsigned first(Lss command) { return static_cast<unsigned>(command); }

[[nodiscard]] bool send_number(CO_LSSM& master) {
  const uint8_t n = master.Sent;
  CO_ASSERT(n < master.Frames && master.Frames <= wire::lss_identify_parts);
  const bool is_last = n + 1 == master.Frames;
  CO_IF_FRM frame = wire::lss_frame(wire::lss_request, static_cast<uint8_t>(master.Request + n));
  wire::put_u32(frame.Data + 1, master.Number[n]);
  master.Sent = static_cast<uint8_t>(n + 1);
  return send(master, frame, is_last ? static_cast<State>(master.Then) : State::sending);
}

CO_ERR check(const CO_LSSM* master, CO_LSSM_CALLBACK callback, bool is_possible) {
  if (master == nullptr || master->Node == nullptr || callback == nullptr || !is_possible) {
    return CO_ERR_BAD_ARG;
  }
  if (state_of(*master) != State::idle) {
    return CO_ERR_LSS_BUSY;
  }
  return master->Node->Nmt.Mode > CO_INIT ? CO_ERR_NONE : CO_ERR_NMT_MODE;
}

// Prepares a service. The route for responses is added only when a service is used.
void prepare(CO_LSSM& master, CO_LSSM_CALLBACK callback, Lss answer) {
  master.Call = callback;
  master.Answer = static_cast<uint8_t>(answer);
  if (master.Routed == 0) {
    master.Routed = 1;
    routes::add(*master.Node, wire::lss_answer, routes::owner<PartId::lss_master>(0));
    routes::publish(*master.Node);
  }
}

CO_ERR begin(CO_LSSM& master, CO_LSSM_CALLBACK callback, const Request& request, const uint32_t* numbers) {
  prepare(master, callback, request.answer);
  master.Request = static_cast<uint8_t>(request.command);
  master.Frames = request.frames;
  master.Then = static_cast<uint8_t>(request.then);
  master.Sent = 0;
  for (uint8_t n = 0; n < request.frames; ++n) {
    master.Number[n] = numbers[n];
  }
  return send_number(master) ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND;
}

CO_ERR start(CO_LSSM* master, CO_LSSM_CALLBACK callback, const Request& request, const uint32_t* numbers) {
  const CO_ERR err = check(master, callback, numbers != nullptr);
  return err == CO_ERR_NONE ? begin(*master, callback, request, numbers) : err;
}

// Starts a service to which one slave responds with the command of the request. number: parameter of the frame
CO_ERR start(CO_LSSM* master, CO_LSSM_CALLBACK callback, unsigned command, bool is_possible, uint32_t number) {
  const Request request = {command, 1, static_cast<Lss>(command), State::answer};
  return start(master, callback, request, is_possible ? &number : nullptr);
}

// Answers ------------------------------------------------------------------------------------------------------------

CO_LSSM_RESULT read_response(CO_LSSM& master, const CO_IF_FRM& answer) {
  const uint8_t* const data = answer.Data + 1;
  switch (static_cast<Lss>(answer.Data[0])) {
    case Lss::selected: return CO_LSSM_OK;
    case Lss::configure_node_id:
    case Lss::configure_bit_timing:
    case Lss::store:
      master.Error = data[0];
      master.Specific = data[1];
      return data[0] == 0 ? CO_LSSM_OK : CO_LSSM_REFUSED;
    case Lss::inquire_node_id: master.Value = data[0]; return CO_LSSM_OK;
    default: master.Value = wire::get_u32(data); return CO_LSSM_OK;
  }
}

// Activate bit timing ------------------------------------------------------------------------------------------------

// Starts the switch of the bit rate. The request must have been sent before transmission is disabled.
CO_ERR activate(CO_LSSM& master, CO_LSSM_CALLBACK callback, uint32_t delay) {
  CO_NODE& node = *master.Node;
  transmit::flush(node);
  if (transmit::is_waiting(node)) {
    return CO_ERR_IF_CAN_SEND;
  }
  CO_ERR err = begin(master, callback, {first(Lss::activate_bit_timing), 1, Lss{}, State::silent}, &delay);
  if (err == CO_ERR_NONE && transmit::is_waiting(node)) {
    transmit::withdraw(node, wire::lss_request);
    tmr::stop(node, master.Tmr);
    set_state(master, State::idle);
    err = CO_ERR_IF_CAN_SEND;
  }
  if (err == CO_ERR_NONE) {
    node.Transmit.Off |= event::switching;
  }
  return err;
}

void switch_own_bit_rate(CO_LSSM& master) {
  if (master.Baudrate != 0) {
    event::set_bit_rate(*master.Node, master.Baudrate);
  }
  enter_state(master, State::switched);
}

// Fastscan -----------------------------------------------------------------------------------------------------------

bool is_known(const CO_LSSM& master) { return master.Part < master.Known; }

[[nodiscard]] bool scan(CO_LSSM& master, State then) {
  CO_ASSERT(master.Part < wire::lss_address_parts && (master.Bit < 32 || master.Bit == wire::fastscan_begin));
  const unsigned next = then == State::confirmed ? (master.Part + 1U) % wire::lss_address_parts : master.Part;
  CO_IF_FRM frame = wire::lss_frame(wire::lss_request, static_cast<uint8_t>(Lss::fastscan));
  wire::put_fastscan(frame, {master.Address[master.Part], master.Bit, master.Part, static_cast<uint8_t>(next)});
  return send(master, frame, then);
}

// Begins to scan a part of the address; a part that the application has given is only confirmed.
void scan_part(CO_LSSM& master) {
  const bool known = is_known(master);
  master.Address[master.Part] = known ? master.Number[master.Part] : 0;
  master.Bit = known ? 0 : highest_bit;
  end_unless(scan(master, known ? State::confirmed : State::scanned), master);
}

// Sets the bit that was scanned to 1 if no slave has responded that it is 0, and scans the next lower bit.
void scan_next_bit(CO_LSSM& master) {
  CO_ASSERT(master.Part < wire::lss_address_parts && master.Bit < 32);
  const bool is_last = master.Bit == 0;
  master.Address[master.Part] |= master.Heard != 0 ? 0 : uint32_t{1} << master.Bit;
  master.Bit = static_cast<uint8_t>(is_last ? 0 : master.Bit - 1);
  end_unless(scan(master, is_last ? State::confirmed : State::scanned), master);
}

void scan_next_part(CO_LSSM& master) {
  if (master.Heard == 0) {
    finish(master, is_known(master) ? CO_LSSM_NOT_FOUND : CO_LSSM_TIMEOUT);
  } else if (++master.Part == wire::lss_address_parts) {
    finish(master, CO_LSSM_OK);
  } else {
    scan_part(master);
  }
}

CO_ERR begin_scan(CO_LSSM& master, const uint32_t* known, uint8_t num, CO_LSSM_CALLBACK callback) {
  prepare(master, callback, Lss::identified);
  master.Known = num;
  master.Part = 0;
  master.Bit = wire::fastscan_begin;
  for (uint8_t part = 0; part < wire::lss_address_parts; ++part) {
    master.Number[part] = part < num ? known[part] : 0;
    master.Address[part] = 0;
  }
  return scan(master, State::begun) ? CO_ERR_NONE : CO_ERR_IF_CAN_SEND;
}

void on_time(void* master_pointer) {
  CO_LSSM& master = *static_cast<CO_LSSM*>(master_pointer);
  const bool heard = master.Heard != 0;
  switch (state_of(master)) {
    case State::sending: end_unless(send_number(master), master); break;
    case State::leaving:
    case State::switched: finish(master, CO_LSSM_OK); break;
    case State::silent: switch_own_bit_rate(master); break;
    case State::answer: finish(master, CO_LSSM_TIMEOUT); break;
    case State::found: finish(master, heard ? CO_LSSM_OK : CO_LSSM_NOT_FOUND); break;
    case State::begun: heard ? scan_part(master) : finish(master, CO_LSSM_NOT_FOUND); break;
    case State::scanned: scan_next_bit(master); break;
    case State::confirmed: scan_next_part(master); break;
    case State::idle: break;
  }
}

}  // namespace

void init(CO_NODE& node) {
  node.Lssm.Node = &node;
  node.Lssm.Routed = 0;
}

// A switch of the bit rate continues during a reset, because the other nodes switch, too.
void on_mode(CO_NODE& node) {
  CO_LSSM& master = node.Lssm;
  const bool stopped = node.Nmt.Mode == CO_INVALID;
  const bool reset = node.Nmt.Mode == CO_INIT && !is_switching(master);
  if ((stopped || reset) && state_of(master) != State::idle) {
    finish(master, CO_LSSM_STOPPED);
  }
}

// Counts responses in CO_LSSM.Heard also after the end of the service: further responses mean several slaves.
bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t) {
  CO_LSSM& master = node.Lssm;
  if (frame.DLC != wire::lss_dlc) {
    return false;
  }
  const bool is_idle = state_of(master) == State::idle;
  if ((!is_idle && !is_awaiting(master)) || frame.Data[0] != master.Answer) {
    return true;
  }
  master.Heard = static_cast<uint8_t>(master.Heard == UINT8_MAX ? UINT8_MAX : master.Heard + 1);
  if (state_of(master) == State::answer) {
    finish(master, read_response(master, frame));
  }
  return true;
}

}  // namespace co::lss_master

using co::wire::Lss;

extern "C" {

CO_ERR COLssmSetTimes(CO_LSSM* lssm, uint32_t timeout, uint32_t listen) {
  if (lssm == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  lssm->Timeout = timeout;
  lssm->Listen = listen;
  return CO_ERR_NONE;
}

CO_ERR COLssmCancel(CO_LSSM* lssm) {
  if (lssm == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (co::lss_master::state_of(*lssm) != co::lss_master::State::idle) {
    co::lss_master::finish(*lssm, CO_LSSM_CANCELLED);
  }
  return CO_ERR_NONE;
}

CO_ERR COLssmSwitchGlobal(CO_LSSM* lssm, uint8_t state, CO_LSSM_CALLBACK callback) {
  const uint32_t number = state;
  const bool is_possible = state <= CO_LSSM_CONFIGURATION;
  return co::lss_master::start(lssm, callback,
                               {co::lss_master::first(Lss::switch_global), 1, Lss{}, co::lss_master::State::leaving},
                               is_possible ? &number : nullptr);
}

CO_ERR COLssmSwitchSelective(CO_LSSM* lssm, const uint32_t address[CO_LSSM_PARTS], CO_LSSM_CALLBACK callback) {
  const co::lss_master::Request request = {co::lss_master::first(Lss::switch_selective), co::wire::lss_address_parts,
                                           Lss::selected, co::lss_master::State::answer};
  return start(lssm, callback, request, address);
}

CO_ERR COLssmConfigureNodeId(CO_LSSM* lssm, uint8_t nodeId, CO_LSSM_CALLBACK callback) {
  return co::lss_master::start(lssm, callback, co::lss_master::first(Lss::configure_node_id),
                               co::wire::may_be_configured(nodeId), nodeId);
}

CO_ERR COLssmConfigureBitTiming(CO_LSSM* lssm, uint32_t baudrate, CO_LSSM_CALLBACK callback) {
  const uint8_t index = co::wire::index_of_bit_rate(baudrate);
  const bool is_possible = index != co::wire::lss_bit_rates;
  return co::lss_master::start(lssm, callback, co::lss_master::first(Lss::configure_bit_timing), is_possible,
                               uint32_t{index} << 8);
}

CO_ERR COLssmActivateBitTiming(CO_LSSM* lssm, uint16_t delay, uint32_t baudrate, CO_LSSM_CALLBACK callback) {
  const CO_ERR err = co::lss_master::check(lssm, callback, true);
  if (err != CO_ERR_NONE) {
    return err;
  }
  lssm->Baudrate = baudrate;
  return co::lss_master::activate(*lssm, callback, delay);
}

CO_ERR COLssmStore(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) {
  return co::lss_master::start(lssm, callback, co::lss_master::first(Lss::store), true, 0);
}

CO_ERR COLssmInquire(CO_LSSM* lssm, uint8_t which, CO_LSSM_CALLBACK callback) {
  return co::lss_master::start(lssm, callback, co::lss_master::first(Lss::inquire) + which,
                               which < co::wire::lss_address_parts, 0);
}

CO_ERR COLssmInquireNodeId(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) {
  return co::lss_master::start(lssm, callback, co::lss_master::first(Lss::inquire_node_id), true, 0);
}

CO_ERR COLssmIdentify(CO_LSSM* lssm, const uint32_t range[6], CO_LSSM_CALLBACK callback) {
  const co::lss_master::Request request = {co::lss_master::first(Lss::identify), co::wire::lss_identify_parts,
                                           Lss::identified, co::lss_master::State::found};
  return start(lssm, callback, request, range);
}

CO_ERR COLssmIdentifyUnconfigured(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) {
  constexpr uint32_t none = 0;
  return co::lss_master::start(
      lssm, callback,
      {co::lss_master::first(Lss::identify_unconfigured), 1, Lss::unconfigured, co::lss_master::State::found}, &none);
}

CO_ERR COLssmFastscan(CO_LSSM* lssm, const uint32_t* known, uint8_t num, CO_LSSM_CALLBACK callback) {
  const CO_ERR err = co::lss_master::check(lssm, callback, num <= CO_LSSM_PARTS && (num == 0 || known != nullptr));
  return err == CO_ERR_NONE ? co::lss_master::begin_scan(*lssm, known, num, callback) : err;
}

}  // extern "C"

#endif
