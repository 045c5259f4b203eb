// SPDX-License-Identifier: Apache-2.0
// 1301h…1340h, 1381h…13C0h, 13FEh, 13FFh: configuration of SRDOs. [EN 50325-5]
#include "dictionary/parameter.hpp"
#include "service/srdo/configuration.hpp"

#if CO_SRDO_N > 0

namespace co::srdo_objects {
namespace {

constexpr unsigned mapping_of(unsigned number) { return srdo::first_mapping + number; }

// Numbers of an SRDO by the index of its communication parameter and of its mapping.
unsigned number_of(const CO_OBJ& obj) { return CO_GET_IDX(obj.Key) - srdo::first_communication; }
unsigned number_of_mapping(const CO_OBJ& obj) { return CO_GET_IDX(obj.Key) - srdo::first_mapping; }

// Return the type of the number in an entry of 1301h…, and of 1381h….
const CO_OBJ_TYPE& communication_type(const CO_OBJ& obj) {
  switch (CO_GET_SUB(obj.Key)) {
    case 2: return COTInt16;
    case 5:
    case 6: return COTInt32;
    default: return COTInt8;
  }
}
const CO_OBJ_TYPE& mapping_type(const CO_OBJ& obj) { return CO_GET_SUB(obj.Key) == 0 ? COTInt8 : COTInt32; }

using TypeOf = const CO_OBJ_TYPE& (*)(const CO_OBJ& obj);

template <TypeOf type_of>
uint32_t size(CO_OBJ* obj, CO_NODE* node, uint32_t width) {
  return type_of(*obj).Size(obj, node, width);
}

template <TypeOf type_of>
CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return type_of(*obj).Read(obj, node, buffer, size);
}

template <TypeOf type_of, const integer::Parameter& parameter>
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  return integer::write(obj, node, buffer, size, type_of(*obj).Size(obj, node, size), &parameter);
}

// The configuration can be changed outside of Operational, and is not valid any more then.
CO_ERR may_change(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) {
  return srdo::is_operational(node) ? CO_ERR_OBJ_STATE : CO_ERR_NONE;
}
void invalidate(CO_NODE& node, CO_OBJ&, uint32_t, uint32_t) { srdo::invalidate(node); }

CO_ERR may_communicate(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t) {
  if (srdo::is_operational(node)) {
    return CO_ERR_OBJ_STATE;
  }
  return srdo::is_parameter(CO_GET_SUB(obj.Key), value) ? CO_ERR_NONE : CO_ERR_OBJ_RANGE;
}

void apply_communication(CO_NODE& node, CO_OBJ& obj, uint32_t, uint32_t) {
  srdo::invalidate(node);
  if (CO_GET_SUB(obj.Key) == 1 && node.Nmt.Mode != CO_INVALID && dict::is_number(number_of(obj), CO_SRDO_N)) {
    srdo::change_direction(node, number_of(obj));
  }
}

constexpr integer::Parameter communication = {may_communicate, apply_communication};

CO_ERR check_number(uint32_t value) {
  return value % 2 == 0 && value <= CO_SRDO_MAP_N ? CO_ERR_NONE : CO_ERR_OBJ_MAP_LEN;
}

// A mapping can be changed while the SRDO does not exist, and its entries while their number is 0.
CO_ERR may_map(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t) {
  if (srdo::is_operational(node)) {
    return CO_ERR_OBJ_STATE;
  }
  const unsigned number = number_of_mapping(obj);
  const bool is_number = CO_GET_SUB(obj.Key) == 0;
  const uint32_t mapped = dict::read_number(node, CO_DEV(mapping_of(number), 0), sizeof(uint8_t), 1);
  if (srdo::direction_of(node, number) != CO_SRDO_NONE || (!is_number && mapped != 0)) {
    return CO_ERR_OBJ_ACC;
  }
  if (is_number) {
    return check_number(value);
  }
  return value == 0 ? CO_ERR_NONE : srdo::check_mapping(node, value, CO_OBJ____P__);
}

constexpr integer::Parameter mapping = {may_map, invalidate};

// Returns an Init function, or null where checks are switched off (USE_DICT_CHECK).
constexpr CO_OBJ_INIT_FUNC checking(CO_OBJ_INIT_FUNC init) { return USE_DICT_CHECK != 0 ? init : nullptr; }

// Check entries whose sub-index decides which rule applies.

const rules::Rule& communication_rule(uint8_t sub) {
  switch (sub) {
    case 2: return rules::srdo_cycle;
    case 3:
    case 4: return rules::srdo_byte;
    case 5:
    case 6: return rules::srdo_cob_id;
    default: return rules::srdo_direction;
  }
}
CO_ERR init_communication(CO_OBJ* obj, CO_NODE* node) {
  return dict::check_type(*obj, *node, communication_rule(CO_GET_SUB(obj->Key)));
}
CO_ERR init_mapping(CO_OBJ* obj, CO_NODE* node) {
  return dict::check_type(*obj, *node, CO_GET_SUB(obj->Key) == 0 ? rules::srdo_number : rules::srdo_mapping);
}

}  // namespace
}  // namespace co::srdo_objects

extern "C" {

const CO_OBJ_TYPE COTSrdoCom = {
    co::srdo_objects::size<co::srdo_objects::communication_type>,
    co::srdo_objects::checking(co::srdo_objects::init_communication),
    co::srdo_objects::read<co::srdo_objects::communication_type>,
    co::srdo_objects::write<co::srdo_objects::communication_type, co::srdo_objects::communication>, nullptr};
const CO_OBJ_TYPE COTSrdoMap = {
    co::srdo_objects::size<co::srdo_objects::mapping_type>, co::srdo_objects::checking(co::srdo_objects::init_mapping),
    co::srdo_objects::read<co::srdo_objects::mapping_type>,
    co::srdo_objects::write<co::srdo_objects::mapping_type, co::srdo_objects::mapping>, nullptr};
const CO_OBJ_TYPE COTSrdoValid = co::parameter<1, co::rules::srdo_valid, co::srdo_objects::may_change>;
const CO_OBJ_TYPE COTSrdoSignature =
    co::parameter<2, co::rules::srdo_signature, co::srdo_objects::may_change, co::srdo_objects::invalidate>;

}  // extern "C"

#endif
