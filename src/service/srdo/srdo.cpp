// SPDX-License-Identifier: Apache-2.0
#include "service/srdo/configuration.hpp"

#include "base/callbacks.hpp"
#include "base/events.hpp"
#include "base/routes.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "co_assert.h"
#include "wire/cob_id.hpp"
#include "wire/frame.hpp"
#include "wire/srdo.hpp"

#if CO_SRDO_N > 0

namespace co::srdo {
namespace {

using event::Fault;

// Bits of CO_SRDO.Flags, in addition to accessing.
enum Flag : uint8_t {
  halved = 0x01,     // consumer: the inverse frame is expected; producer: it is sent after CO_SRDO_GAP
  requested = 0x02,  // producer: another pair follows the present one
  failed = 0x08,     // Fault::srdo is raised
  refused = 0x10,    // Fault::srdo_configuration is raised
  routed = 0x20,     // consumer: the routes of its identifiers exist
  halted = 0x40,     // ended, the callback was not called yet
};

bool has(const CO_SRDO& srdo, unsigned flags) { return (srdo.Flags & flags) != 0; }
void set(CO_SRDO& srdo, unsigned flags) { srdo.Flags = static_cast<uint8_t>(srdo.Flags | flags); }
void clear(CO_SRDO& srdo, unsigned flags) { srdo.Flags = static_cast<uint8_t>(srdo.Flags & ~flags); }

unsigned number_of(const CO_SRDO& srdo) { return static_cast<unsigned>(&srdo - srdo.Node->Srdo); }

bool is_running(const CO_SRDO& srdo) { return srdo.State == CO_SRDO_INITIALISING || srdo.State == CO_SRDO_ESTABLISHED; }

// Third to fifth byte of the manufacturer-specific error field of an EMCY message.
constexpr uint32_t detail_of(unsigned index, unsigned last) { return index | (last << 16); }

// Calls the callback of the application, which may end or restart the SRDO.
void change_state(CO_SRDO& srdo, CO_SRDO_STATE state) {
  if (srdo.State != state) {
    srdo.State = state;
    callback::change_srdo(*srdo.Node, static_cast<uint8_t>(number_of(srdo)), state);
  }
}

void withdraw(CO_SRDO& srdo) {
  CO_NODE& node = *srdo.Node;
  if (srdo.Direction == CO_SRDO_TX && transmit::is_waiting(node)) {
    transmit::withdraw(node, srdo.Identifier[0]);
    transmit::withdraw(node, srdo.Identifier[1]);
  }
}

void stop(CO_SRDO& srdo) {
  tmr::stop(*srdo.Node, srdo.Tmr);
  clear(srdo, halved | requested | accessing);
  withdraw(srdo);
}

// Raises a fault after the callback of the application, unless the callback has ended the state.
void raise(CO_SRDO& srdo, CO_SRDO_STATE state, Flag flag, Fault fault, uint32_t detail) {
  change_state(srdo, state);
  if (srdo.State == state && !has(srdo, flag)) {
    set(srdo, flag);
    event::raise(*srdo.Node, fault, detail);
  }
}

// Ends the SRDO in an error state, which only leaving Operational ends.
void fail(CO_SRDO& srdo, CO_SRDO_STATE state) {
  stop(srdo);
  raise(srdo, state, failed, Fault::srdo, detail_of(first_communication + number_of(srdo), state));
}

void on_time(void* srdo_pointer);

void start(CO_SRDO& srdo, uint32_t ticks) {
  tmr::start(*srdo.Node, srdo.Tmr, ticks != 0 ? ticks : 1, 0, on_time, &srdo);
}

uint32_t elapsed(const CO_SRDO& srdo) { return tmr::now(*srdo.Node) - srdo.Tick; }

// Producer ------------------------------------------------------------------------------------------------------------

// Starts the refresh time, which began at Tick.
void start_cycle(CO_SRDO& srdo) {
  const uint32_t passed = elapsed(srdo);
  start(srdo, passed < srdo.Cycle ? srdo.Cycle - passed : 0);
}

void start_gap(CO_SRDO& srdo) { start(srdo, tmr::ticks(*srdo.Node, CO_SRDO_GAP, unit_us)); }

// Returns whether a frame of the last pair was not sent yet.
bool is_queued(const CO_SRDO& srdo) {
  CO_NODE& node = *srdo.Node;
  return transmit::is_waiting(node) && (transmit::find_waiting(node, srdo.Identifier[0]) != nullptr ||
                                        transmit::find_waiting(node, srdo.Identifier[1]) != nullptr);
}

// Ends a pair whose frames were both sent or queued. A request during the gap is processed after another gap.
void end_pair(CO_SRDO& srdo) {
  clear(srdo, halved);
  has(srdo, requested) ? start_gap(srdo) : start_cycle(srdo);
  change_state(srdo, CO_SRDO_ESTABLISHED);
}

void send_inverse(CO_SRDO& srdo, const uint8_t* data) {
  CO_ASSERT(srdo.Length <= sizeof srdo.Data);
  CO_IF_FRM frame = wire::empty_frame(srdo.Identifier[1], srdo.Length);
  __builtin_memcpy(frame.Data, data, srdo.Length);
  transmit::send(*srdo.Node, frame) ? end_pair(srdo) : fail(srdo, CO_SRDO_ERR_SEND);
}

// Sends a pair that was read and compared.
void send_pair(CO_SRDO& srdo, const CO_IF_FRM& plain, const uint8_t* inverse) {
  if (is_queued(srdo) || !transmit::send(*srdo.Node, plain)) {
    fail(srdo, CO_SRDO_ERR_SEND);
  } else if (CO_SRDO_GAP == 0) {
    send_inverse(srdo, inverse);
  } else {
    __builtin_memcpy(srdo.Data, inverse, sizeof srdo.Data);
    set(srdo, halved);
    start_gap(srdo);
  }
}

// Reads the mapped objects and sends a pair. Both frames are read together, so that they are of the same moment.
void produce(CO_SRDO& srdo) {
  CO_NODE& node = *srdo.Node;
  CO_IF_FRM plain = wire::empty_frame(srdo.Identifier[0], srdo.Length);
  uint8_t inverse[sizeof srdo.Data] = {};
  set(srdo, accessing);
  const CO_ERR err = read_objects(node, srdo, plain.Data, inverse);
  if (!has(srdo, accessing)) {
    return;
  }
  clear(srdo, accessing | requested);
  if (err != CO_ERR_NONE) {
    fail(srdo, CO_SRDO_ERR_INTERNAL);
  } else if (!wire::is_inverse(plain.Data, inverse, srdo.Length)) {
    fail(srdo, CO_SRDO_ERR_TX_NOT_INVERSE);
  } else {
    send_pair(srdo, plain, inverse);
  }
}

// Sends the pair that is due. Its refresh time begins when the last one has ended, so that it does not drift.
void produce_in_cycle(CO_SRDO& srdo) {
  const uint32_t passed = elapsed(srdo);
  srdo.Tick += !has(srdo, requested) && passed - srdo.Cycle < srdo.Cycle ? srdo.Cycle : passed;
  produce(srdo);
}

// Starts the time until the first pair: 0.5 ms for each node-ID below.
void start_producer(CO_SRDO& srdo) {
  constexpr uint32_t share = 5;  // x 100 µs
  const uint32_t first = tmr::ticks(*srdo.Node, srdo.Node->NodeId * share, CO_TMR_UNIT_100US);
  srdo.Tick = tmr::now(*srdo.Node) + first - srdo.Cycle;
  start(srdo, first);
}

CO_ERR request(CO_NODE& node, CO_SRDO& srdo) {
  if (!is_operational(node)) {
    return CO_ERR_NMT_MODE;
  }
  if (!is_running(srdo) || srdo.Direction != CO_SRDO_TX || has(srdo, accessing)) {
    return CO_ERR_OBJ_STATE;
  }
  if (has(srdo, halved)) {
    set(srdo, requested);
    return CO_ERR_NONE;
  }
  srdo.Tick = tmr::now(node);
  produce(srdo);
  return is_running(srdo) ? CO_ERR_NONE : CO_ERR_OBJ_READ;
}

// Consumer ------------------------------------------------------------------------------------------------------------

// Starts the timer for a time that began at Tick: it elapses in the first tick in which a frame would be late.
void expect(CO_SRDO& srdo, uint32_t time) {
  const uint32_t passed = elapsed(srdo);
  start(srdo, passed <= time ? time - passed + 1 : 0);
}

// Returns the error of a frame that came later than the timer allows, although the timer has not been processed yet;
// otherwise the given state. Before the first plain frame no time is monitored.
CO_SRDO_STATE late_or(const CO_SRDO& srdo, CO_SRDO_STATE state) {
  if (has(srdo, halved)) {
    return elapsed(srdo) > srdo.Validation ? CO_SRDO_ERR_SRVT : state;
  }
  return srdo.State == CO_SRDO_ESTABLISHED && elapsed(srdo) > srdo.Cycle ? CO_SRDO_ERR_SCT : state;
}

// Returns the state after a plain frame: its present state, or an error.
CO_SRDO_STATE check_plain(const CO_SRDO& srdo, const CO_IF_FRM& frame) {
  const auto present = static_cast<CO_SRDO_STATE>(srdo.State);
  const CO_SRDO_STATE in_order = has(srdo, halved) ? CO_SRDO_ERR_RX_NOT_INVERSE : present;
  return late_or(srdo, in_order == present && frame.DLC < srdo.Length ? CO_SRDO_ERR_SHORT : in_order);
}

// Returns the state after an inverse frame: established, or an error.
CO_SRDO_STATE check_inverse(const CO_SRDO& srdo, const CO_IF_FRM& frame) {
  if (!has(srdo, halved)) {
    return late_or(srdo, CO_SRDO_ERR_RX_NOT_INVERSE);
  }
  if (frame.DLC < srdo.Length) {
    return late_or(srdo, CO_SRDO_ERR_SHORT);
  }
  const bool inverse = wire::is_inverse(srdo.Data, frame.Data, srdo.Length);
  return late_or(srdo, inverse ? CO_SRDO_ESTABLISHED : CO_SRDO_ERR_RX_NOT_INVERSE);
}

void receive_plain(CO_SRDO& srdo, const CO_IF_FRM& frame) {
  const CO_SRDO_STATE state = check_plain(srdo, frame);
  if (state != srdo.State) {
    fail(srdo, state);
    return;
  }
  __builtin_memcpy(srdo.Data, frame.Data, sizeof srdo.Data);
  srdo.Tick = tmr::now(*srdo.Node);
  set(srdo, halved);
  expect(srdo, srdo.Validation);
}

// Writes the objects of a valid pair.
void consume(CO_SRDO& srdo, const CO_IF_FRM& frame) {
  CO_NODE& node = *srdo.Node;
  CO_IF_FRM inverse = frame;
  clear(srdo, halved);
  expect(srdo, srdo.Cycle);
  set(srdo, accessing);
  const CO_ERR err = write_objects(node, srdo, srdo.Data, inverse.Data);
  if (!has(srdo, accessing)) {
    return;
  }
  clear(srdo, accessing);
  err == CO_ERR_NONE ? change_state(srdo, CO_SRDO_ESTABLISHED) : fail(srdo, CO_SRDO_ERR_INTERNAL);
}

// Processes an inverse frame. One that comes before the first plain frame belongs to a pair that began before this node
// entered Operational.
void receive_inverse(CO_SRDO& srdo, const CO_IF_FRM& frame) {
  if (srdo.State == CO_SRDO_INITIALISING && !has(srdo, halved)) {
    return;
  }
  const CO_SRDO_STATE state = check_inverse(srdo, frame);
  state == CO_SRDO_ESTABLISHED ? consume(srdo, frame) : fail(srdo, state);
}

// -----------------------------------------------------------------------------------------------------------------

void on_time(void* srdo_pointer) {
  CO_SRDO& srdo = *static_cast<CO_SRDO*>(srdo_pointer);
  if (srdo.Direction == CO_SRDO_RX) {
    fail(srdo, has(srdo, halved) ? CO_SRDO_ERR_SRVT : CO_SRDO_ERR_SCT);
  } else if (has(srdo, halved)) {
    send_inverse(srdo, srdo.Data);
  } else {
    produce_in_cycle(srdo);
  }
}

// Changes the routes of a consumer. Returns whether they were other ones.
bool change_routes(CO_SRDO& srdo, bool receives, const uint32_t (&before)[2]) {
  const bool same = receives == has(srdo, routed) && (!receives || before[0] == srdo.Identifier[0]);
  for (unsigned frame = 0; frame < 2 && !same; ++frame) {
    const auto number = static_cast<uint16_t>(2 * number_of(srdo) + frame);
    routes::change(*srdo.Node, receives ? srdo.Identifier[frame] : wire::no_frame, routes::owner<PartId::srdo>(number));
  }
  receives ? set(srdo, routed) : clear(srdo, routed);
  return !same;
}

// Checks an SRDO and starts it. is_valid: 13FEh was valid when Operational was entered. Returns whether the routes have
// changed.
bool begin(CO_NODE& node, unsigned number, bool is_valid) {
  CO_ASSERT(node.Srdo[number].Node == &node && !is_running(node.Srdo[number]));
  CO_SRDO& srdo = node.Srdo[number];
  const uint32_t before[] = {srdo.Identifier[0], srdo.Identifier[1]};
  srdo.Identifier[0] = srdo.Identifier[1] = wire::no_frame;
  srdo.Direction = direction_of(node, number);
  const bool exists = srdo.Direction != CO_SRDO_NONE;
  const uint32_t fault = exists && is_valid ? configure(node, number) : 0;
  const bool starts = exists && is_valid && fault == 0;
  if (!starts) {
    srdo.Identifier[0] = srdo.Identifier[1] = wire::no_frame;
  }
  const bool changed = change_routes(srdo, starts && srdo.Direction == CO_SRDO_RX, before);
  if (starts && srdo.Direction == CO_SRDO_TX) {
    start_producer(srdo);
  }
  if (starts || !exists) {
    change_state(srdo, starts ? CO_SRDO_INITIALISING : CO_SRDO_DELETED);
  } else if (fault == 0) {
    change_state(srdo, CO_SRDO_ERR_CONFIGURATION);
  } else {
    invalidate(node);
    raise(srdo, CO_SRDO_ERR_CONFIGURATION, refused, Fault::srdo_configuration,
          detail_of(CO_GET_IDX(fault), CO_GET_SUB(fault)));
  }
  return changed;
}

void begin_all(CO_NODE& node) {
  const bool valid = is_valid(node);
  bool changed = false;
  for (unsigned number = 0; number < CO_SRDO_N; ++number) {
    changed |= begin(node, number, valid);
  }
  if (changed) {
    routes::publish(node);
  }
}

// Ends all SRDOs that run, before a callback can access one of them that still does. The callbacks follow.
void halt_all(CO_NODE& node, CO_SRDO_STATE state) {
  for (CO_SRDO& srdo : node.Srdo) {
    if (is_running(srdo)) {
      stop(srdo);
      set(srdo, halted);
      srdo.State = state;
    }
  }
}

// Ends an SRDO when Operational is left.
void end(CO_SRDO& srdo) {
  const uint32_t index = first_communication + number_of(srdo);
  stop(srdo);
  if (has(srdo, failed)) {
    event::resolve(*srdo.Node, Fault::srdo, detail_of(index, srdo.State));
  }
  if (has(srdo, refused)) {
    event::resolve(*srdo.Node, Fault::srdo_configuration, index);
  }
  const bool was_halted = has(srdo, halted);
  clear(srdo, failed | refused | halted);
  if (was_halted && srdo.State == CO_SRDO_NOT_OPERATIONAL) {
    callback::change_srdo(*srdo.Node, static_cast<uint8_t>(number_of(srdo)), CO_SRDO_NOT_OPERATIONAL);
  } else if (srdo.State != CO_SRDO_DELETED) {
    change_state(srdo, CO_SRDO_NOT_OPERATIONAL);
  }
}

}  // namespace

void change_direction(CO_NODE& node, unsigned number) {
  CO_ASSERT(number < CO_SRDO_N && !is_running(node.Srdo[number]));
  if (node.Srdo[number].Node == nullptr) {
    return;  // written by an Init function in CONodeInit(): init() follows
  }
  const bool exists = direction_of(node, number) != CO_SRDO_NONE;
  change_state(node.Srdo[number], exists ? CO_SRDO_NOT_OPERATIONAL : CO_SRDO_DELETED);
}

void init(CO_NODE& node) {
  for (unsigned number = 0; number < CO_SRDO_N; ++number) {
    CO_SRDO& srdo = node.Srdo[number];
    srdo.Node = &node;
    srdo.Flags = 0;
    srdo.Direction = CO_SRDO_NONE;
    srdo.Identifier[0] = srdo.Identifier[1] = wire::no_frame;
    srdo.State = direction_of(node, number) != CO_SRDO_NONE ? CO_SRDO_NOT_OPERATIONAL : CO_SRDO_DELETED;
    tmr::assign_to_real_time(srdo.Tmr);
  }
}

void on_mode(CO_NODE& node) {
  if (is_operational(node)) {
    begin_all(node);
    return;
  }
  halt_all(node, CO_SRDO_NOT_OPERATIONAL);
  for (CO_SRDO& srdo : node.Srdo) {
    if (srdo.Node != nullptr) {
      end(srdo);
    }
  }
}

bool on_frame(CO_NODE& node, const CO_IF_FRM& frame, uint16_t number) {
  CO_ASSERT(number / 2 < CO_SRDO_N);
  CO_SRDO& srdo = node.Srdo[number / 2];
  if (is_running(srdo)) {
    number % 2 == 0 ? receive_plain(srdo, frame) : receive_inverse(srdo, frame);
  }
  return true;
}

void halt(CO_NODE& node) { halt_all(node, CO_SRDO_ERR_INTERNAL); }

void report_halted(CO_NODE& node) {
  for (CO_SRDO& srdo : node.Srdo) {
    if (has(srdo, halted)) {
      clear(srdo, halted);
      srdo.State = CO_SRDO_ESTABLISHED;  // the callback is called for changes only
      fail(srdo, CO_SRDO_ERR_INTERNAL);
    }
  }
}

}  // namespace co::srdo

extern "C" {

// Default callbacks.
WEAK void COSrdoChange(CO_NODE*, uint8_t, CO_SRDO_STATE) {}

CO_SRDO_STATE COSrdoGetState(const CO_NODE* node, uint8_t number) {
  ASSERT_PTR_ERR(node, CO_SRDO_DELETED);
  return number < CO_SRDO_N ? static_cast<CO_SRDO_STATE>(node->Srdo[number].State) : CO_SRDO_DELETED;
}

bool COSrdoIsEstablished(const CO_NODE* node) {
  ASSERT_PTR_ERR(node, false);
  bool any = false;
  for (const CO_SRDO& srdo : node->Srdo) {
    if (srdo.State != CO_SRDO_DELETED && srdo.State != CO_SRDO_ESTABLISHED) {
      return false;
    }
    any |= srdo.State == CO_SRDO_ESTABLISHED;
  }
  return any;
}

CO_ERR COSrdoRequest(CO_NODE* node, uint8_t number) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  if (number >= CO_SRDO_N) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(*node);
  return co::srdo::request(*node, node->Srdo[number]);
}

CO_ERR COSrdoSignature(CO_NODE* node, uint8_t number, uint16_t* signature) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  ASSERT_PTR_ERR(signature, CO_ERR_BAD_ARG);
  return number < CO_SRDO_N ? co::srdo::compute_signature(*node, number, *signature) : CO_ERR_BAD_ARG;
}

}  // extern "C"

#endif
