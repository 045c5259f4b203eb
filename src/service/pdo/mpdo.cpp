// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/mpdo.hpp"

#if USE_MPDO

#include "base/error.hpp"
#include "base/events.hpp"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/whole.hpp"
#include "service/pdo/configuration.hpp"
#include "wire/mpdo.hpp"

namespace co::mpdo {
namespace {

constexpr uint16_t no_producer = 0;  // CO_MPDO.Producer holds numbers of TPDOs from 1

bool get(const uint8_t* bits, uint16_t place) { return (bits[place / 8U] & (1U << (place % 8U))) != 0; }
void put(uint8_t* bits, uint16_t place) {
  bits[place / 8U] = static_cast<uint8_t>(bits[place / 8U] | 1U << (place % 8U));
}
void clear(uint8_t* bits, uint16_t place) {
  bits[place / 8U] = static_cast<uint8_t>(bits[place / 8U] & ~(1U << (place % 8U)));
}

// Returns the object of an entry number; null if CODictInit() has renumbered the entries, until remap() has run.
CO_OBJ* object_at(CO_NODE& node, uint16_t entry) {
  return entry < node.Dict.Num && (node.Pending & event::remap) == 0 ? &node.Dict.Root[entry] : nullptr;
}

// Resolves the list that the PDO uses. Only one TPDO can use the scanner list. [301:7.2.3.2.2]
CO_ERR resolve_list(CO_NODE& node, unsigned index) {
  if (pdo::direction_of(index) == Direction::receive) {
    return resolve_dispatch(node);
  }
  const unsigned own = (index & 0x01FFU) + 1;
  const bool taken = node.Mpdo.Producer != no_producer && node.Mpdo.Producer != own;
  return taken ? CO_ERR_OBJ_INCOMPATIBLE : resolve_scan(node);
}

// Returns the object that an entry of the dispatching list, or a block of it, assigns to an object of the producer.
CO_OBJ* dispatch(CO_NODE& node, uint32_t producer) {
  for (uint16_t n = 0; n < node.Mpdo.BlockNum; ++n) {
    const CO_MPDO_BLOCK& block = node.Mpdo.Block[n];
    const uint32_t distance = producer - block.Producer;
    const uint32_t place = distance / wire::mpdo_next_sub;
    if (distance % wire::mpdo_next_sub == 0 && place < block.Num) {
      return object_at(node, static_cast<uint16_t>(block.Entry + place));
    }
  }
  return nullptr;
}

}  // namespace

CO_ERR resolve(CO_NODE& node, unsigned index, unsigned num, CO_PDO_MAP& map) {
  if (num < sam) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  const uint32_t type_key = CO_DEV(index - pdo::from_communication_to_mapping, 2);
  if (!pdo::is_event_driven(static_cast<uint8_t>(pdo::read_number(node, type_key, 1, pdo::default_type)))) {
    return CO_ERR_OBJ_INCOMPATIBLE;
  }
  const CO_ERR err = num == sam ? resolve_list(node, index) : CO_ERR_NONE;
  if (err != CO_ERR_NONE) {
    return err;
  }
  // The PDO exists and has a length of 8 bytes, but maps no object.
  __builtin_memset(map.Entry, UINT8_MAX, sizeof map.Entry);
  map.Span = 0;
  map.Length = wire::mpdo_dlc * pdo::one_byte;
  map.Step[0] = static_cast<uint8_t>(map.Length | pdo::by_type);
  set_mode(map, static_cast<uint8_t>(num));
  return CO_ERR_NONE;
}

// Returns whether an object can be sent in a multiplex PDO: up to 4 bytes; static data types have no data.
CO_ERR check_object(CO_NODE& node, Direction direction, CO_OBJ* obj, uint32_t key) {
  if (obj == nullptr || rules::is_static_type(key)) {
    return dict::has_index(node.Dict, key) ? CO_ERR_OBJ_MAP_TYPE : CO_ERR_OBJ_NOT_FOUND;
  }
  const uint32_t bytes = obj::size(*obj, node, 0);
  return bytes > wire::mpdo_data ? CO_ERR_OBJ_MAP_TYPE
                                 : pdo::check(node, direction, key | bytes * 8U, pdo::MappedBy::network);
}

// Consumer -----------------------------------------------------------------------------------------------------------

bool is_kind(const CO_PDO_MAP& map, const CO_IF_FRM& frame) {
  const uint8_t address = wire::mpdo_address(wire::get_low(frame));
  const bool to_consumer = (address & wire::mpdo_to_consumer) != 0;
  return !is_mpdo(map) || (is_dam(map) ? to_consumer : !to_consumer && address != 0);
}

bool is_addressed(const CO_NODE& node, const CO_PDO_MAP& map, const CO_IF_FRM& frame) {
  const uint8_t node_id = wire::mpdo_address(wire::get_low(frame)) & wire::mpdo_node_id;
  return !is_dam(map) || node_id == 0 || node_id == node.NodeId;
}

CO_OBJ* find(CO_NODE& node, const CO_PDO_MAP& map, const CO_IF_FRM& frame) {
  const uint32_t low = wire::get_low(frame);
  const uint32_t key = wire::mpdo_key(low);
  if (is_sam(map)) {
    return dispatch(node, key | wire::mpdo_address(low));
  }
  CO_OBJ* const obj = dict::find(node.Dict, key);
  return check_object(node, Direction::receive, obj, key) == CO_ERR_NONE ? obj : nullptr;
}

void write(CO_NODE& node, CO_PDO_MAP& map, CO_OBJ& obj, const CO_IF_FRM& frame) {
  uint8_t value[wire::mpdo_data];
  const uint32_t bytes = obj::size(obj, node, 0);
  if (bytes > sizeof value) {
    return;
  }
  __builtin_memcpy(value, frame.Data + wire::mpdo_data, sizeof value);
  map.Entry[0] = pdo::number_of(node, obj);  // the object of the last frame, for CORPdoObjWasReceived()
  if (!obj::is_stream(obj)) {
    wire::swap_host(value, bytes);
  }
  const uint32_t key = obj.Key;
  error::report(node, obj::access_whole(obj, node, obj.Type->Write, value, bytes), key);
  if (pdo::has(map, pdo::served)) {
    pdo::mark_transferred(map);
  }
}

// Producer in source address mode ------------------------------------------------------------------------------------

void set_producer(CO_NODE& node, unsigned number, const CO_PDO_MAP& map) {
  const auto own = static_cast<uint16_t>(number + 1);
  if (is_sam(map)) {
    node.Mpdo.Producer = own;
  } else if (node.Mpdo.Producer == own) {
    node.Mpdo.Producer = no_producer;
  }
}

CO_TPDO* producer([[maybe_unused]] CO_NODE& node) {
#if CO_TPDO_N > 0
  return node.Mpdo.Producer == no_producer ? nullptr : &node.TPdo[node.Mpdo.Producer - 1];
#else
  return nullptr;
#endif
}

bool mark(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  bool found = false;
  for (uint16_t place = 0; place < mpdo.ScanNum; ++place) {
    if (mpdo.Scan[place] == entry) {
      put(mpdo.Waiting, place);
      found = true;
    }
  }
  return found;
}

void mark_all(CO_TPDO& pdo) {
  CO_MPDO& mpdo = pdo.Node->Mpdo;
  for (uint16_t place = 0; is_sam(pdo.Map) && place < mpdo.ScanNum; ++place) {
    put(mpdo.Waiting, place);
  }
}

void forget_marks(CO_NODE& node) { __builtin_memset(node.Mpdo.Waiting, 0, sizeof node.Mpdo.Waiting); }

bool is_waiting(const CO_NODE& node) {
  uint8_t any = 0;
  for (const uint8_t bits : node.Mpdo.Waiting) {
    any |= bits;
  }
  return any != 0;
}

bool next(CO_NODE& node, uint16_t& place) {
  const CO_MPDO& mpdo = node.Mpdo;
  place = mpdo.NextObject;
  for (uint16_t n = 0; n < mpdo.ScanNum; ++n, ++place) {
    place = place < mpdo.ScanNum ? place : 0;
    if (get(mpdo.Waiting, place)) {
      return true;
    }
  }
  return false;
}

CO_ERR read(CO_NODE& node, uint16_t place, CO_IF_FRM& frame) {
  CO_OBJ* const obj = object_at(node, node.Mpdo.Scan[place]);
  if (obj == nullptr) {
    return CO_ERR_OBJ_NOT_FOUND;
  }
  uint8_t value[wire::mpdo_data] = {};
  const uint32_t bytes = obj::size(*obj, node, 0);
  if (bytes > sizeof value) {
    return CO_ERR_OBJ_SIZE;
  }
  const CO_ERR err = obj::access_whole(*obj, node, obj->Type->Read, value, bytes);
  if (!obj::is_stream(*obj)) {
    wire::swap_host(value, bytes);
  }
  frame = wire::mpdo(frame.Identifier, node.NodeId, CO_GET_DEV(obj->Key), wire::get_u32(value));
  return err;
}

// The list is checked again, because a callback may have changed it.
void finish_object(CO_NODE& node, uint16_t place, uint16_t entry, bool sent) {
  CO_MPDO& mpdo = node.Mpdo;
  if (place >= mpdo.ScanNum || mpdo.Scan[place] != entry) {
    return;
  }
  clear(mpdo.Waiting, place);
  mpdo.NextObject = static_cast<uint16_t>(place + 1);
  if (sent) {
    put(mpdo.Transferred, place);
  }
}

bool was_sent(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  bool was = false;
  for (uint16_t place = 0; place < mpdo.ScanNum; ++place) {
    if (mpdo.Scan[place] == entry) {
      was |= get(mpdo.Transferred, place);
      clear(mpdo.Transferred, place);
    }
  }
  return was;
}

Transferred transferred(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  unsigned place = 0;
  while (place < mpdo.ScanNum && mpdo.Scan[place] != entry) {
    ++place;
  }
  return {mpdo.Transferred, place, mpdo.ScanNum};
}

}  // namespace co::mpdo

#endif
