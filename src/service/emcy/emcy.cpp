// SPDX-License-Identifier: Apache-2.0
#include "service/emcy/emcy.hpp"

#include "base/error.hpp"
#include "base/timer.hpp"
#include "base/transmit.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "hal/port.hpp"
#include "wire/cob_id.hpp"
#include "wire/emcy.hpp"

#if USE_EMCY

namespace co::emcy {
namespace {

using event::Fault;

constexpr uint32_t key_register = CO_DEV(0x1001, 0);
constexpr uint32_t key_cob_id = CO_DEV(0x1014, 0);

constexpr uint8_t generic = 1U << CO_EMCY_REG_GENERAL;
constexpr uint8_t communication = generic | (1U << CO_EMCY_REG_COM);

constexpr uint16_t codes[] = {
#define CO_CODE(fault, code, bit, led) code,
    CO_FAULTS(CO_CODE)
#undef CO_CODE
};

constexpr uint16_t code_of(Fault fault) { return codes[static_cast<uint8_t>(fault)]; }
static_assert(code_of(Fault::overrun) == 0x8110 && code_of(Fault::life_guard) == 0x8130);
static_assert(code_of(Fault::recovered) == 0x8140 && code_of(Fault::pdo_timeout) == 0x8250);

// Returns how often a fault was raised without being resolved.
uint16_t& number_of(CO_NODE& node, Fault fault) { return node.Emcy.Fault[static_cast<uint8_t>(fault)]; }

constexpr CO_EMCY_USR nothing_added = {};

// Errors of the application -------------------------------------------------------------------------------------------

constexpr uint8_t mask(unsigned err) { return static_cast<uint8_t>(1U << (err % 8)); }

bool is_set(const CO_EMCY& emcy, unsigned err) { return (emcy.Err[err / 8] & mask(err)) != 0; }

// Reports that a bit of the error status has changed.
[[gnu::noinline]] void show_bits(CO_NODE& node) {
  if (node.Emcy.ShowBits != nullptr) {
    node.Emcy.ShowBits(&node);
  }
}

// Sets or clears an error. Returns false if it has that state already, or if there is no such error (reported as the
// node's error).
bool change(CO_EMCY& emcy, unsigned err, bool come) {
  if (emcy.Root == nullptr) {
    error::report(*emcy.Node, CO_ERR_EMCY_BAD_ROOT);
    return false;
  }
  if (err >= table_length(emcy)) {
    error::report(*emcy.Node, CO_ERR_BAD_ARG);
    return false;
  }
  uint8_t& bits = emcy.Err[err / 8];
  const unsigned before = bits;
  const unsigned after = come ? before | mask(err) : before & ~unsigned{mask(err)};
  bits = static_cast<uint8_t>(after);
  return after != before;
}

// Error register ------------------------------------------------------------------------------------------------------

// Returns the bits of the error register for CO_EMCY_TBL.Reg: that bit and "generic error". Bit 6 is reserved.
// [301:7.5.2.2]
constexpr uint32_t bits_of(uint8_t reg) {
  constexpr uint32_t reserved = 1U << 6;
  return generic | (reg < CO_EMCY_REG_NUM ? (1U << reg) & ~reserved : 0U);
}

uint8_t register_of(const CO_EMCY& emcy) {
  uint32_t bits = 0;
  for (uint32_t byte = 0; byte < sizeof emcy.Err; ++byte) {
    uint32_t err = byte * 8;
    for (uint32_t set = emcy.Err[byte]; set != 0; set >>= 1, ++err) {
      bits |= (set & 1U) != 0 ? bits_of(emcy.Root[err].Reg) : 0U;
    }
  }
  uint32_t faults = 0;
  for (const uint16_t number : emcy.Fault) {
    faults |= number;
  }
  return static_cast<uint8_t>(faults != 0 ? bits | communication : bits);
}

// Updates the error register. If it has changed, send_queued() writes it to 1001h.
uint8_t update_register(CO_NODE& node) {
  const uint8_t bits = register_of(node.Emcy);
  if (bits != node.Emcy.Register) {
    node.Emcy.Register = bits;
    node.Emcy.RegisterChanged = 1;
    event::defer(node, event::send_emcy);
  }
  return bits;
}

// Writes the error register to 1001h. An entry with flag D is not written, because it may be in read-only memory.
void write_register(CO_NODE& node) {
  node.Emcy.RegisterChanged = 0;
  CO_OBJ* const obj = dict::find(node, key_register);
  if (obj != nullptr && CO_IS_DIRECT(obj->Key) == 0) {
    uint8_t bits = node.Emcy.Register;
    error::report(node, obj::write(*obj, node, &bits, sizeof bits), key_register);
  }
}

// Messages ------------------------------------------------------------------------------------------------------------

// Updates the error register and sends a message with it.
void post(CO_NODE& node, CO_EMCY_MSG msg) {
  msg = wire::with_register(msg, update_register(node));
  if (event::is_allowed(node, CO_EMCY_ALLOWED)) {
    send_message(node, msg);
  }
}

// Ends an API function: sends its messages, also in a callback, before the TPDOs that the application requests then.
void finish_call(CO_NODE& node) {
  if ((node.Pending & event::send_emcy) != 0 && port::is_initialised(node)) {
    send_queued(node);
  }
  event::run_deferred(node);
}

void report_gone(CO_NODE& node, uint32_t detail) { post(node, wire::emcy_message(CO_EMCY_CODE_NO_ERR, detail)); }

void add_to_history(CO_NODE& node, uint32_t entry) {
  if (node.Emcy.Hist.Add != nullptr) {
    node.Emcy.Hist.Add(&node, entry);
  }
}

// Adds a fault to the history and sends its message. The first two bytes of the manufacturer-specific error field are 0
// in both, detail is in the others. [E11]
void report_fault(CO_NODE& node, Fault fault, uint32_t detail) {
  const uint16_t code = code_of(fault);
  add_to_history(node, code);
  post(node, wire::emcy_message(code, detail));
}

void report_error(CO_NODE& node, uint16_t code, const CO_EMCY_USR& usr) {
  add_to_history(node, code | (uint32_t{usr.Hist} << 16));
  post(node, wire::emcy_message(code, usr.Emcy));
}

// Faults without an event that ends them -----------------------------------------------------------------------------

// Faults that may occur with every frame. They are resolved by their timer, which each occurrence restarts, when they
// have not occurred for a second.
constexpr Fault held[CO_EMCY_HOLD_N] = {Fault::overrun, Fault::collision};
static_assert(static_cast<uint8_t>(held[0]) == 0 && static_cast<uint8_t>(held[1]) == 1);

void resolve_held(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  for (const Fault fault : held) {
    if (!tmr::is_running(node.Emcy.Hold[static_cast<uint8_t>(fault)])) {
      emcy::resolve(node, fault, 0);
    }
  }
}

// Reports the bit of a fault that has no occurrence left.
void show_if_gone(CO_NODE& node, Fault fault) {
  if (number_of(node, fault) == 0) {
    show_bits(node);
  }
}

// The controller ------------------------------------------------------------------------------------------------------

// Begins bus-off. Nothing can be sent: only sets the error register, and 8140h is sent after the recovery.
// [301:7.2.7.1]
void begin_bus_off(CO_NODE& node) {
  number_of(node, Fault::recovered) = 1;
  update_register(node);
}

// Ends the error state of the controller. After bus-off sends 8140h, then "no error"; an error passive state before the
// bus-off ends without a message. Otherwise resolves error passive.
void recover(CO_NODE& node) {
  Fault over = Fault::passive;
  if (number_of(node, Fault::recovered) != 0) {
    number_of(node, Fault::recovered) = 0;
    emcy::raise(node, Fault::recovered, 0);
    emcy::forget(node, Fault::passive, 0);
    over = Fault::recovered;
  }
  emcy::resolve(node, over, 0);
}

}  // namespace

unsigned table_length(const CO_EMCY& emcy) {
  const unsigned given = port::is_initialised(*emcy.Node) ? emcy.Node->Ext->EmcyNum : 0U;
  return given != 0 && given < CO_EMCY_N ? given : CO_EMCY_N;
}

void take_over(CO_NODE& node, const CO_NODE_SPEC& spec) {
  node.Emcy.Node = &node;
  node.Emcy.Root = spec.EmcyCode;
}

void init(CO_NODE& node) {
  for (uint16_t& number : node.Emcy.Fault) {
    number = 0;
  }
  init_history(node);
  node.Emcy.Register = static_cast<uint8_t>(dict::read_number(node, key_register, sizeof(uint8_t), node.Emcy.Register));
  update_register(node);
  if (USE_DICT_CHECK != 0 && node.Emcy.Root != nullptr && dict::find(node, key_cob_id) == nullptr) {
    error::report(node, CO_ERR_CFG_1014_0, key_cob_id);
  }
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_EMCY_ALLOWED)) {
    return;
  }
  withdraw(node, transmit::is_waiting(node) ? identifier(node) : wire::no_frame);
  if (!event::is_allowed(node, CO_NMT_ALLOWED)) {
    stop_inhibit_time(node);
    for (CO_TMR_MEM& timer : node.Emcy.Hold) {
      tmr::stop(node, timer);
    }
  }
}

// Counts the faults up to passive once, however often they occur: they describe a state, and one event ends them.
void raise(CO_NODE& node, Fault fault, uint32_t detail) {
  const auto kind = static_cast<uint8_t>(fault);
  uint16_t& number = number_of(node, fault);
  if (kind < CO_EMCY_HOLD_N) {
    tmr::start(node, node.Emcy.Hold[kind], node.Tmr.Freq, 0, resolve_held, &node);
  }
  if (kind <= static_cast<uint8_t>(Fault::passive) && number != 0) {
    return;
  }
  ++number;
  report_fault(node, fault, detail);
  if (number == 1) {
    show_bits(node);
  }
}

void resolve(CO_NODE& node, Fault fault, uint32_t detail) {
  if (number_of(node, fault) != 0) {
    --number_of(node, fault);
    report_gone(node, detail);
    show_if_gone(node, fault);
  }
}

void forget(CO_NODE& node, Fault fault, uint32_t) {
  if (number_of(node, fault) != 0) {
    --number_of(node, fault);
    update_register(node);
    show_if_gone(node, fault);
  }
}

void report_can(CO_NODE& node, CO_CAN_EVENT what) {
  if (node.Nmt.Mode == CO_INVALID) {
    return;
  }
  switch (what) {
    case CO_CAN_OVERRUN: emcy::raise(node, Fault::overrun, 0); break;
    case CO_CAN_PASSIVE: emcy::raise(node, Fault::passive, 0); break;
    case CO_CAN_BUS_OFF: begin_bus_off(node); break;
    case CO_CAN_RECOVERED: recover(node); break;
    default: break;
  }
}

void forget_application(CO_NODE& node) {
  for (uint8_t& bits : node.Emcy.Err) {
    bits = 0;
  }
  clear_history(node);
}

void send_queued(CO_NODE& node) {
  event::remove(node, event::send_emcy);
  if (node.Emcy.RegisterChanged != 0) {
    write_register(node);
  }
  send_waiting(node);
}

uint32_t identifier(CO_NODE& node) {
  return cob_id::identifier(dict::read_number(node, key_cob_id, sizeof(uint32_t), wire::cob_invalid));
}

}  // namespace co::emcy

using namespace co;

extern "C" {

void COEmcySet(CO_EMCY* emcy, uint8_t err, const CO_EMCY_USR* usr) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  if (emcy::change(*emcy, err, true)) {
    emcy::report_error(*emcy->Node, emcy->Root[err].Code, usr != nullptr ? *usr : emcy::nothing_added);
    emcy::show_bits(*emcy->Node);
  }
  emcy::finish_call(*emcy->Node);
}

void COEmcyClr(CO_EMCY* emcy, uint8_t err) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  if (emcy::change(*emcy, err, false)) {
    emcy::report_gone(*emcy->Node, 0);
    emcy::show_bits(*emcy->Node);
  }
  emcy::finish_call(*emcy->Node);
}

int16_t COEmcyGet(CO_EMCY* emcy, uint8_t err) {
  ASSERT_PTR_ERR(emcy, -1);
  ASSERT_PTR_ERR(emcy->Node, -1);
  if (err >= emcy::table_length(*emcy)) {
    return -1;
  }
  return emcy::is_set(*emcy, err) ? 1 : 0;
}

int16_t COEmcyCnt(CO_EMCY* emcy) {
  ASSERT_PTR_ERR(emcy, -1);
  int16_t number = 0;
  for (uint16_t err = 0; err < CO_EMCY_N; ++err) {
    number = static_cast<int16_t>(number + (emcy::is_set(*emcy, err) ? 1 : 0));
  }
  return number;
}

void COEmcyReset(CO_EMCY* emcy, uint8_t silent) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  bool changed = false;
  for (uint16_t err = 0; err < CO_EMCY_N; ++err) {
    if (!emcy::is_set(*emcy, err)) {
      continue;
    }
    changed = emcy::change(*emcy, err, false) || changed;
    if (silent == 0) {
      emcy::report_gone(*emcy->Node, 0);
    }
  }
  emcy::update_register(*emcy->Node);
  if (changed) {
    emcy::show_bits(*emcy->Node);
  }
  emcy::finish_call(*emcy->Node);
}

void COEmcyHistReset(CO_EMCY* emcy) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  emcy::clear_history(*emcy->Node);
}

}  // extern "C"

// 1014h, COB-ID EMCY. [301:7.5.2.17]

namespace co::emcy {
namespace {

constexpr uint32_t reserved = 1U << 30;

// Checks a COB-ID. A restricted CAN-ID is refused in a COB-ID that is not valid, too. [P5]
CO_ERR may_replace(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t before) {
  if (value == before) {
    return CO_ERR_NONE;
  }
  const bool is_change = wire::is_valid(before) && wire::is_valid(value);
  return is_change || (value & reserved) != 0 || !cob_id::is_free(value) ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

// Drops the messages that wait with the identifier before, if there is no new one.
void apply(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t before) {
  if (!wire::is_valid(value)) {
    withdraw(node, cob_id::identifier(before));
  }
}

}  // namespace
}  // namespace co::emcy

extern "C" const CO_OBJ_TYPE COTEmcyId =
    co::parameter<co::integer::cob_id, co::rules::emcy_cob_id, co::emcy::may_replace, co::emcy::apply>;

#endif
