// SPDX-License-Identifier: Apache-2.0
// 1400h…1BFFh: communication and mapping parameters of PDOs. [301:7.5.2.35-38]
#include "base/timer.hpp"
#include "dictionary/parameter.hpp"
#include "dictionary/types/integer.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/multiplex.hpp"
#include "wire/cob_id.hpp"

namespace co::pdo_objects {
namespace {

using pdo::Direction;
using pdo::MappedBy;

constexpr uint32_t changeable_flags = CO_TPDO_COBID_OFF | CO_TPDO_COBID_REMOTE;

bool is_tpdo(const CO_OBJ& obj) { return CO_GET_IDX(obj.Key) >= pdo::first_tpdo; }
Direction direction_of(const CO_OBJ& obj) { return is_tpdo(obj) ? Direction::transmit : Direction::receive; }
uint16_t number_of(const CO_OBJ& obj) { return CO_GET_IDX(obj.Key) & 0x01FFU; }
uint16_t communication_of(const CO_OBJ& obj) {
  return static_cast<uint16_t>((is_tpdo(obj) ? pdo::first_tpdo : pdo::first_rpdo) + number_of(obj));
}

// Returns whether the PDO exists; false if its COB-ID is not in the dictionary.
bool exists(CO_NODE& node, const CO_OBJ& obj) {
  const uint32_t key = CO_DEV(communication_of(obj), 1);
  return (pdo::read_number(node, key, sizeof(uint32_t), wire::cob_invalid) & wire::cob_invalid) == 0;
}

// Returns whether the configuration of the stack has a PDO with this number (CO_RPDO_N, CO_TPDO_N).
bool is_configured(const CO_OBJ& obj) {
  constexpr unsigned configured[] = {CO_RPDO_N, CO_TPDO_N};
  return dict::is_number(number_of(obj), configured[is_tpdo(obj) ? 1 : 0]);
}

void configure(CO_NODE& node, const CO_OBJ& obj) {
  if (is_configured(obj)) {
    pdo::request_configuration(node, communication_of(obj));
  }
}

// Sub 1 --------------------------------------------------------------------------------------------------------------

// Not inlined, so that its map is not on the CPU's stack while the PDO is configured.
[[gnu::noinline]] bool can_exist(CO_NODE& node, const CO_OBJ& obj) {
  CO_PDO_MAP map;
  return pdo::resolve(node, communication_of(obj), map).err == CO_ERR_NONE;
}

// Returns whether a COB-ID may replace another. Bit 30 is ignored in RPDOs. Without USE_PDO_RTR a TPDO that exists must
// have it set: remote requests are not answered.
bool may_replace(const CO_OBJ& obj, uint32_t before, uint32_t value) {
  const bool asked = USE_PDO_RTR == 0 && is_tpdo(obj) && ((value & changeable_flags) == 0);
  const bool same = ((before ^ value) & ~CO_TPDO_COBID_REMOTE) == 0;
  return !asked && (same || cob_id::may_replace(before, value));
}

CO_ERR may_have_id(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before) {
  if (!may_replace(obj, before, value)) {
    return CO_ERR_OBJ_RANGE;
  }
  const bool is_new = !wire::is_valid(before) && wire::is_valid(value);
  return is_new && !can_exist(node, obj) ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

// Configures the PDO if its COB-ID or its transmission type has changed.
void apply(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before) {
  if (value != before) {
    configure(node, obj);
  }
}

// Sub 2 --------------------------------------------------------------------------------------------------------------

// Returns whether the type is allowed: a multiplex PDO that exists remains event-driven. [301:7.2.3.2]
bool fits_mapping(CO_NODE& node, const CO_OBJ& obj, uint8_t type) {
  return pdo::is_event_driven(type) || !mpdo::is_selected(node, communication_of(obj)) || !exists(node, obj);
}

CO_ERR may_have_type(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t) {
  const auto type = static_cast<uint8_t>(value);
  return pdo::is_type(direction_of(obj), type) && fits_mapping(node, obj, type) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

// Sub 3 and 6 --------------------------------------------------------------------------------------------------------

// Checks the inhibit time, or the SYNC start value, which cannot be changed while the PDO exists.
template <uint32_t highest>
CO_ERR may_change(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before) {
  const bool changes = value != before && exists(node, obj);
  return changes || value > highest ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

// Sub 5 --------------------------------------------------------------------------------------------------------------

void apply_event(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t) {
  if (!is_configured(obj)) {
    return;
  }
  const uint32_t ticks = pdo::ticks(node, value, CO_TMR_UNIT_1MS);
  if (is_tpdo(obj)) {
    pdo::change_event_time(node, number_of(obj), ticks);
  } else {
    pdo::change_deadline(node, number_of(obj), ticks);
  }
}

// Mapping ------------------------------------------------------------------------------------------------------------

// Checks the number of mapped objects. If the mapping cannot be resolved, the write is refused and the number becomes
// 0. Writing the present number does not require flag P of the objects, because the mapping may be the designer's.
CO_ERR may_map(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before) {
  if (exists(node, obj)) {
    return CO_ERR_OBJ_ACC;
  }
  CO_PDO_MAP map;
  const MappedBy author = value == before ? MappedBy::designer : MappedBy::network;
  const CO_ERR err = pdo::resolve(node, CO_GET_IDX(obj.Key), value, map, author).err;
  if (err != CO_ERR_NONE) {
    uint8_t none = 0;
    (void)integer::Number<1>::write(&obj, &node, &none, sizeof none);
  }
  return err;
}

CO_ERR may_be_mapped(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t) {
  constexpr uint8_t unknown = 1;
  const uint32_t num = pdo::read_number(node, CO_DEV(CO_GET_IDX(obj.Key), 0), sizeof(uint8_t), unknown);
  if (num != 0 || exists(node, obj)) {
    return CO_ERR_OBJ_ACC;
  }
  return value == 0 ? CO_ERR_NONE : pdo::check(node, direction_of(obj), value, MappedBy::network);
}

}  // namespace
}  // namespace co::pdo_objects

extern "C" {

const CO_OBJ_TYPE COTPdoId =
    co::parameter<co::integer::cob_id, co::rules::pdo_cob_id, co::pdo_objects::may_have_id, co::pdo_objects::apply>;
const CO_OBJ_TYPE COTPdoType =
    co::parameter<1, co::rules::pdo_type, co::pdo_objects::may_have_type, co::pdo_objects::apply>;
const CO_OBJ_TYPE COTPdoInhibit = co::parameter<2, co::rules::pdo_inhibit, co::pdo_objects::may_change<UINT16_MAX>>;
const CO_OBJ_TYPE COTPdoEvent =
    co::parameter<2, co::rules::pdo_event, co::fits_timer<CO_TMR_UNIT_1MS>, co::pdo_objects::apply_event>;
const CO_OBJ_TYPE COTPdoStart =
    co::parameter<1, co::rules::pdo_start, co::pdo_objects::may_change<co::pdo::last_synchronous_type>>;
const CO_OBJ_TYPE COTPdoNum = co::parameter<1, co::rules::pdo_number, co::pdo_objects::may_map>;
const CO_OBJ_TYPE COTPdoMap = co::parameter<4, co::rules::pdo_mapping, co::pdo_objects::may_be_mapped>;

}  // extern "C"
