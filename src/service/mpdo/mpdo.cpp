// SPDX-License-Identifier: Apache-2.0
// Configuration of multiplex PDOs: mode, type and lists.
#include "service/mpdo/mpdo.hpp"

#include "base/events.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "service/pdo/configuration.hpp"
#include "service/pdo/multiplex.hpp"
#include "wire/mpdo.hpp"

#if CO_MPDO_N > 0

namespace co::mpdo {
namespace {

// Resolves the list that the PDO uses. Returns an error if another TPDO uses the scanner list. [301:7.2.3.2.2]
CO_ERR resolve_list(CO_NODE& node, unsigned index) {
  if (pdo::direction_of(index) == Direction::receive) {
    return resolve_dispatch(node);
  }
  const unsigned own = pdo::number_of(index) + 1;
  const bool taken = node.Mpdo.Producer != no_producer && node.Mpdo.Producer != own;
  return taken ? CO_ERR_OBJ_INCOMPATIBLE : resolve_scan(node);
}

// Length of the address byte and the multiplexer in a frame, in the unit of CO_PDO_MAP.Length.
constexpr uint8_t multiplexer = wire::mpdo_data * pdo::one_byte;

}  // namespace

void init(CO_NODE& node) { node.Mpdo.Producer = no_producer; }

bool is_selected(CO_NODE& node, unsigned index) {
  return dict::read_number(node, CO_DEV(index + pdo::from_communication_to_mapping, 0), sizeof(uint8_t), 0) >= sam;
}

CO_ERR resolve(CO_NODE& node, unsigned index, unsigned num, CO_PDO_MAP& map) {
  if (num < sam) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  const uint32_t type_key = CO_DEV(index - pdo::from_communication_to_mapping, 2);
  if (!pdo::is_event_driven(static_cast<uint8_t>(dict::read_number(node, type_key, 1, pdo::default_type)))) {
    return CO_ERR_OBJ_INCOMPATIBLE;
  }
  const CO_ERR err = num == sam ? resolve_list(node, index) : CO_ERR_NONE;
  if (err != CO_ERR_NONE) {
    return err;
  }
  // The PDO exists, but maps no object until one is sent or received: see map_object().
  __builtin_memset(map.Entry, UINT8_MAX, sizeof map.Entry);
  map.Span = 0;
  map.Length = multiplexer;
  map.Step[0] = multiplexer | pdo::by_type;
  map.Mode = static_cast<uint8_t>(num);
  return CO_ERR_NONE;
}

CO_ERR check_object(CO_NODE& node, Direction direction, CO_OBJ* obj, uint32_t key) {
  if (obj == nullptr || rules::is_static_type(key)) {
    return obj != nullptr || dict::has_index(node.Dict, key) ? CO_ERR_OBJ_MAP_TYPE : CO_ERR_OBJ_NOT_FOUND;
  }
  const uint32_t bytes = obj::size(*obj, node, 0);
  return bytes > wire::mpdo_data ? CO_ERR_OBJ_MAP_TYPE
                                 : pdo::check(node, direction, key | bytes * 8U, pdo::MappedBy::network);
}

CO_ERR map_object(CO_NODE& node, CO_PDO_MAP& map, CO_OBJ& obj) {
  const uint32_t bytes = obj::size(obj, node, 0);
  if (bytes > wire::mpdo_data) {
    return CO_ERR_OBJ_SIZE;
  }
  map.Entry[1] = pdo::number_of(node, obj);
  map.Step[1] = static_cast<uint8_t>(bytes * pdo::one_byte);
  map.Length = static_cast<uint8_t>(multiplexer + map.Step[1]);
  return CO_ERR_NONE;
}

CO_OBJ* object_at(CO_NODE& node, uint16_t entry) { return entry < node.Dict.Num ? &node.Dict.Root[entry] : nullptr; }

}  // namespace co::mpdo

extern "C" CO_ERR COTPdoSendTo(CO_NODE* node, uint16_t num, uint8_t node_id, uint32_t key, uint32_t value) {
  ASSERT_PTR_ERR(node, CO_ERR_BAD_ARG);
  if (node_id > co::wire::mpdo_node_id) {
    return CO_ERR_BAD_ARG;
  }
  const co::event::Call call(*node);
  if constexpr (CO_TPDO_N == 0) {
    return CO_ERR_TPDO_NUM_TRIGGER;
  } else {
    return co::mpdo::send_to(*node, num, node_id, key, value);
  }
}

#endif
