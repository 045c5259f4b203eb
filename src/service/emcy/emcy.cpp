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

using event::Change;
using event::Fault;

constexpr uint32_t key_register = CO_DEV(0x1001, 0);
constexpr uint32_t key_cob_id = CO_DEV(0x1014, 0);

constexpr uint16_t codes[] = {
#define CO_CODE(fault, code, led) code,
    CO_FAULTS(CO_CODE)
#undef CO_CODE
};

// Returns the position of a fault in CO_EMCY.Fault, which is its bit of the error status (CO_EMCY_BIT_…).
constexpr uint8_t number_of(Fault fault) { return static_cast<uint8_t>(fault); }
static_assert(number_of(Fault::passive) == CO_EMCY_BIT_PASSIVE);
static_assert(number_of(Fault::recovered) == CO_EMCY_BIT_BUS_OFF && number_of(Fault::pdo_long) == CO_EMCY_BIT_PDO_LONG);
static_assert(number_of(Fault::pdo_timeout) == CO_EMCY_BIT_PDO_TIMEOUT);

bool has_fault(const CO_EMCY& emcy, Fault fault) { return emcy.Fault[number_of(fault)] != 0; }

// Errors of the application -------------------------------------------------------------------------------------------

constexpr uint8_t mask(unsigned err) { return static_cast<uint8_t>(1U << (err % 8)); }

bool is_set(const CO_EMCY& emcy, unsigned err) { return (emcy.Err[err / 8] & mask(err)) != 0; }

// Reports that a bit of the error status has changed.
[[gnu::noinline]] void show_bits(CO_EMCY& emcy) {
  if (emcy.ShowBits != nullptr) {
    emcy.ShowBits(emcy.Node);
  }
}

void clear_errors(CO_EMCY& emcy) {
  for (uint8_t& bits : emcy.Err) {
    bits = 0;
  }
}

// Error register ------------------------------------------------------------------------------------------------------

constexpr uint32_t generic = 1U << CO_EMCY_REG_GENERAL;

// Returns the bits of the error register for an error (CO_EMCY_TBL.Reg): that bit and "generic error".
inline uint32_t bits_of(const CO_EMCY_TBL& error) {
  return generic | (error.Reg < CO_EMCY_REG_NUM ? 1U << error.Reg : 0U);
}

// Updates the error register, of which bit 6 is reserved. [301:7.5.2.2] If it changes, send_queued() writes it to
// 1001h.
void update_register(CO_EMCY& emcy) {
  uint32_t bits = emcy.Faults != 0 ? generic | 1U << CO_EMCY_REG_COM : 0U;
  for (uint32_t byte = 0; byte < sizeof emcy.Err; ++byte) {
    uint32_t err = byte * 8;
    for (uint32_t set = emcy.Err[byte]; set != 0; set >>= 1, ++err) {
      bits |= (set & 1U) != 0 ? bits_of(emcy.Root[err]) : 0U;
    }
  }
  bits &= UINT8_MAX - (1U << 6);
  if (bits != emcy.Register) {
    emcy.Register = static_cast<uint8_t>(bits);
    event::defer(*emcy.Node, event::send_emcy | event::write_register);
  }
}

// Counts that a fault has occurred (come: 1) or has ended (0).
void count_fault(CO_EMCY& emcy, Fault fault, unsigned come) {
  const unsigned step = 2 * come - 1;
  CO_EMCY_COUNT& number = emcy.Fault[number_of(fault)];
  number = static_cast<CO_EMCY_COUNT>(number + step);
  emcy.Faults = static_cast<uint16_t>(emcy.Faults + step);
  update_register(emcy);
  if (number == come) {  // the first occurrence, or the last one has ended
    show_bits(emcy);
  }
}

// Writes the error register to 1001h. An entry with flag D is not written, because it may be in read-only memory.
void write_register(CO_NODE& node) {
  CO_OBJ* const obj = node.Emcy.RegisterEntry;
  if (obj != nullptr && CO_IS_DIRECT(obj->Key) == 0) {
    uint8_t bits = node.Emcy.Register;
    error::report(node, obj::write(*obj, node, &bits, sizeof bits), key_register);
  }
}

// Messages ------------------------------------------------------------------------------------------------------------

void add_to_history(CO_EMCY& emcy, uint32_t entry) {
  if (emcy.Hist.Add != nullptr) {
    emcy.Hist.Add(emcy.Node, entry);
  }
}

// Sends a message with the error register. low, high: its other bytes, as in wire::emcy()
void send_with_register(CO_EMCY& emcy, uint32_t low, uint32_t high) {
  if (event::is_allowed(*emcy.Node, CO_EMCY_ALLOWED)) {
    send_message(*emcy.Node, low | uint32_t{emcy.Register} << 16, high);
  }
}

// Ends an API function: sends its messages, also in a callback, before the TPDOs that the application requests then.
void finish_call(CO_NODE& node) {
  if ((node.Pending & event::send_emcy) != 0) {
    send_queued(node);
  }
  event::run_deferred(node);
}

// Reports that an error of the application has been set or cleared: in the register, the history and by a message. usr:
// may be null
void report_change(CO_EMCY& emcy, const CO_EMCY_TBL& error, bool come, const CO_EMCY_USR* usr) {
  uint32_t low = 0;
  uint32_t high = 0;
  if (come) {
    uint32_t entry = low = error.Code;
    if (usr != nullptr) {
      entry |= uint32_t{usr->Hist} << 16;
      low |= uint32_t{usr->Emcy[0]} << 24;
      high = wire::get_u32(usr->Emcy + 1);
    }
    add_to_history(emcy, entry);
  }
  update_register(emcy);
  send_with_register(emcy, low, high);
  show_bits(emcy);
}

// Sets or clears an error of the application. If there is no such error, that is the node's error. usr: may be null
void change_error(CO_EMCY* emcy, unsigned err, bool come, const CO_EMCY_USR* usr) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  CO_NODE& node = *emcy->Node;
  const unsigned bit = mask(err);
  if (emcy->Root == nullptr) {
    error::report(node, CO_ERR_EMCY_BAD_ROOT);
  } else if (err >= table_length(*emcy)) {
    error::report(node, CO_ERR_BAD_ARG);
  } else if (uint8_t& bits = emcy->Err[err / 8]; ((bits & bit) != 0) != come) {
    bits = static_cast<uint8_t>(bits ^ bit);
    report_change(*emcy, emcy->Root[err], come, usr);
  }
  finish_call(node);
}

// Reports a fault: in the history, unless it has ended, and by a message. The first two bytes of the
// manufacturer-specific error field, which are also in 1003h, are 0; detail is in the others. [301:7.5.2.4]
void report_fault(CO_EMCY& emcy, uint16_t code, uint32_t detail) {
  if (code != CO_EMCY_CODE_NO_ERR) {
    add_to_history(emcy, code);
  }
  send_with_register(emcy, code, detail << 8);
}

// Faults without an event that ends them -----------------------------------------------------------------------------

// Faults that may occur with every frame. They are resolved by their timer, which each occurrence restarts, when they
// have not occurred for a second.
constexpr Fault held[CO_EMCY_HOLD_N] = {Fault::overrun, Fault::collision};
static_assert(number_of(held[0]) == 0 && number_of(held[1]) == 1);

void resolve_held(void* node_pointer) {
  CO_NODE& node = *static_cast<CO_NODE*>(node_pointer);
  for (const Fault fault : held) {
    if (!tmr::is_running(node.Emcy.Hold[number_of(fault)])) {
      emcy::change_fault(node, fault, Change::ended, 0);
    }
  }
}

// The controller ------------------------------------------------------------------------------------------------------

// Begins bus-off. Nothing can be sent: only sets the error register, and 8140h is sent after the recovery.
// [301:7.2.7.1]
void begin_bus_off(CO_NODE& node) {
  if (!has_fault(node.Emcy, Fault::recovered)) {
    count_fault(node.Emcy, Fault::recovered, 1);
  }
}

// Ends the error state of the controller. After bus-off sends 8140h, then "no error"; an error passive state before the
// bus-off ends without a message. Otherwise resolves error passive.
void recover(CO_NODE& node) {
  Fault over = Fault::passive;
  if (has_fault(node.Emcy, Fault::recovered)) {
    report_fault(node.Emcy, codes[number_of(Fault::recovered)], 0);
    emcy::change_fault(node, Fault::passive, Change::forgotten, 0);
    over = Fault::recovered;
  }
  emcy::change_fault(node, over, Change::ended, 0);
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

void find_objects(CO_NODE& node) {
  CO_EMCY& emcy = node.Emcy;
  emcy.RegisterEntry = dict::find(node, key_register);
  emcy.IdEntry = dict::find(node, key_cob_id);
#if CO_EMCY_QUEUE_N > 0
  emcy.InhibitEntry = dict::find(node, CO_DEV(0x1015, 0));
#endif
}

void init(CO_NODE& node) {
  CO_EMCY& emcy = node.Emcy;
  for (CO_EMCY_COUNT& number : emcy.Fault) {
    number = 0;
  }
  emcy.Faults = 0;
  init_history(node);
  find_objects(node);
  emcy.Register = static_cast<uint8_t>(dict::read_number(node, emcy.RegisterEntry, sizeof(uint8_t), emcy.Register));
  update_register(emcy);
  if (USE_DICT_CHECK != 0 && emcy.Root != nullptr && emcy.IdEntry == nullptr) {
    error::report(node, CO_ERR_CFG_1014_0, key_cob_id);
  }
}

void on_mode(CO_NODE& node) {
  if (event::is_allowed(node, CO_EMCY_ALLOWED)) {
    return;
  }
  // The table may be gone when the application stops the node: it is read only if frames wait.
  withdraw(node, transmit::is_waiting(node) ? identifier(node) : wire::no_frame);
  if (!event::is_allowed(node, CO_NMT_ALLOWED)) {
    stop_inhibit_time(node);
    for (CO_TMR_MEM& timer : node.Emcy.Hold) {
      tmr::stop(node, timer);
    }
  }
}

// Counts the faults up to passive once, however often they occur: they describe a state, and one event ends them.
void change_fault(CO_NODE& node, Fault fault, Change change, uint32_t detail) {
  const unsigned number = number_of(fault);
  const unsigned come = change == Change::occurred ? 1 : 0;
  CO_EMCY& emcy = node.Emcy;
  if (come != 0 && number < CO_EMCY_HOLD_N) {
    tmr::start(node, emcy.Hold[number], node.Tmr.Freq, 0, resolve_held, &node);
  }
  const unsigned before = emcy.Fault[number];
  if (come != 0 ? before != 0 && number <= number_of(Fault::passive) : before == 0) {
    return;
  }
  count_fault(emcy, fault, come);
  if (change != Change::forgotten) {
    report_fault(emcy, come != 0 ? codes[number] : uint16_t{CO_EMCY_CODE_NO_ERR}, detail);
  }
}

void report_can(CO_NODE& node, CO_CAN_EVENT what) {
  if (node.Nmt.Mode == CO_INVALID) {
    return;
  }
  switch (what) {
    case CO_CAN_OVERRUN: emcy::change_fault(node, Fault::overrun, Change::occurred, 0); break;
    case CO_CAN_PASSIVE: emcy::change_fault(node, Fault::passive, Change::occurred, 0); break;
    case CO_CAN_BUS_OFF: begin_bus_off(node); break;
    case CO_CAN_RECOVERED: recover(node); break;
    default: break;
  }
}

void forget_application(CO_NODE& node) {
  clear_errors(node.Emcy);
  clear_history(node);
}

void send_queued(CO_NODE& node) {
  const unsigned pending = node.Pending;
  event::remove(node, event::send_emcy | event::write_register);
  if ((pending & event::write_register) != 0) {
    write_register(node);
  }
  send_waiting(node);
}

uint32_t identifier(CO_NODE& node) {
  return cob_id::identifier(dict::read_number(node, node.Emcy.IdEntry, sizeof(uint32_t), wire::cob_invalid));
}

}  // namespace co::emcy

extern "C" {

void COEmcySet(CO_EMCY* emcy, uint8_t err, const CO_EMCY_USR* usr) { co::emcy::change_error(emcy, err, true, usr); }

void COEmcyClr(CO_EMCY* emcy, uint8_t err) { co::emcy::change_error(emcy, err, false, nullptr); }

int16_t COEmcyGet(CO_EMCY* emcy, uint8_t err) {
  ASSERT_PTR_ERR(emcy, -1);
  ASSERT_PTR_ERR(emcy->Node, -1);
  if (err >= co::emcy::table_length(*emcy)) {
    return -1;
  }
  return co::emcy::is_set(*emcy, err) ? 1 : 0;
}

int16_t COEmcyCnt(CO_EMCY* emcy) {
  ASSERT_PTR_ERR(emcy, -1);
  int16_t number = 0;
  for (uint16_t err = 0; err < CO_EMCY_N; ++err) {
    number = static_cast<int16_t>(number + (co::emcy::is_set(*emcy, err) ? 1 : 0));
  }
  return number;
}

void COEmcyReset(CO_EMCY* emcy, uint8_t silent) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  for (uint16_t err = 0; silent == 0 && err < CO_EMCY_N; ++err) {
    if (co::emcy::is_set(*emcy, err)) {
      COEmcyClr(emcy, static_cast<uint8_t>(err));
    }
  }
  if (COEmcyCnt(emcy) != 0) {
    co::emcy::clear_errors(*emcy);
    co::emcy::update_register(*emcy);
    co::emcy::show_bits(*emcy);
  }
  co::emcy::finish_call(*emcy->Node);
}

void COEmcyHistReset(CO_EMCY* emcy) {
  ASSERT_PTR_FATAL(emcy);
  ASSERT_PTR_FATAL(emcy->Node);
  co::emcy::clear_history(*emcy->Node);
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
