// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/configuration.hpp"

#include "core/dict.hpp"
#include "core/obj.hpp"
#include "core/timer.hpp"
#include "object/cob_id.hpp"
#include "wire/cob_id.hpp"

namespace co::pdo {
namespace {

template <class T>
T read_parameter(CO_NODE& node, uint16_t index, uint8_t sub, T otherwise) {
  T value = otherwise;
  CO_OBJ* const obj = dict::find(node.Dict, CO_DEV(index, sub));
  return obj != nullptr && obj::read(*obj, node, &value, sizeof value) == CO_ERR_NONE ? value : otherwise;
}

Parameters read_parameters(CO_NODE& node, uint16_t index) {
  return {read_parameter(node, index, 1, wire::cob_invalid),
          ticks(node, read_parameter(node, index, 3, uint16_t{0}), CO_TMR_UNIT_100US),
          ticks(node, read_parameter(node, index, 5, uint16_t{0}), CO_TMR_UNIT_1MS),
          read_parameter(node, index, 2, default_type)};
}

CO_ERR wrong(Direction direction, CO_ERR rpdo, CO_ERR tpdo) { return direction == Direction::receive ? rpdo : tpdo; }

}  // namespace

bool is_type(Direction direction, uint8_t type) {
  const bool by_request = type == type_rtr || type == type_rtr_synchronous;
  if (by_request && (direction == Direction::receive || USE_PDO_RTR == 0)) {
    return false;
  }
  return is_synchronous(type) || type >= type_rtr;
}

uint8_t start_value(CO_NODE& node, uint16_t number) {
  return read_parameter(node, static_cast<uint16_t>(first_tpdo + number), 6, uint8_t{0});
}

uint32_t ticks(const CO_NODE& node, uint16_t time, uint32_t unit) { return tmr::ticks(node.Tmr, time, unit); }

CO_ERR resolve(CO_NODE& node, Direction direction, uint16_t index, CO_PDO_MAP& map) {
  const auto mapping = static_cast<uint16_t>(index + from_communication_to_mapping);
  const CO_ERR err = resolve(node, direction, mapping, read_parameter(node, mapping, 0, uint8_t{0}), map);
  return err == CO_ERR_NONE && map.Length == 0 ? CO_ERR_OBJ_MAP_LEN : err;
}

void configure(CO_NODE& node, Direction direction, uint16_t index, Parameters& parameters, CO_PDO_MAP& map) {
  map = {};
  parameters = read_parameters(node, index);
  const uint32_t cob_id = parameters.cob_id;
  if ((cob_id & wire::cob_invalid) != 0) {
    return;
  }
  parameters.cob_id = wire::cob_invalid;
  if (!wire::is_usable(cob_id) || !cob_id::is_free(cob_id) || !is_type(direction, parameters.type)) {
    node.Error = wrong(direction, CO_ERR_RPDO_COM_OBJ, CO_ERR_TPDO_COM_OBJ);
  } else if (resolve(node, direction, index, map) != CO_ERR_NONE) {
    map = {};
    node.Error = wrong(direction, CO_ERR_RPDO_MAP_OBJ, CO_ERR_TPDO_MAP_OBJ);
  } else {
    parameters.cob_id = cob_id;
  }
}

}  // namespace co::pdo
