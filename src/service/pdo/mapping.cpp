// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/mapping.hpp"

#include "base/error.hpp"
#include "base/events.hpp"
#include "co_assert.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/number.hpp"
#include "dictionary/types/stream.hpp"
#include "hal/port.hpp"
#include "service/pdo/multiplex.hpp"
#include "wire/bytes.hpp"

// Weak references: null unless the application defines the functions; see co_pdo.h.
#pragma weak CORpdoWriteData
#pragma weak COTpdoReadData

namespace co::pdo {
namespace {

constexpr uint16_t no_entry = 0xFFFF;
constexpr unsigned all_bits = 64;
constexpr unsigned unit = 8 / one_byte;  // bits per unit
// Numbers are copied directly, not by their types.
constexpr bool copies = USE_FAST_PATHS != 0 && wire::host_is_little_endian;
constexpr unsigned longest_number = 4;  // bytes; longer values are passed to callbacks of the application

// Lengths of the static data types BOOLEAN, INTEGER8, 16, 32, UNSIGNED8, 16, 32: their bits are skipped, never written.
// [301:7.4.1 table 44]
constexpr uint8_t static_type_bits[] = {1, 8, 16, 32, 8, 16, 32};

bool is_static_type(uint32_t mapping) { return CO_GET_IDX(mapping) - 1U < sizeof static_type_bits; }

bool is_skipped(Direction direction, uint32_t mapping) {
  const uint32_t index = CO_GET_IDX(mapping);
  const uint32_t bits = static_type_bits[index - 1];
  const bool fits = maps_bits || bits % 8 == 0;
  return direction == Direction::receive && fits && mapping == CO_LINK(index, 0, bits);
}

// Returns the type function that copies an object.
auto function_of(const CO_OBJ& obj, Direction direction) {
  return direction == Direction::receive ? obj.Type->Write : obj.Type->Read;
}

bool is_mappable(const CO_OBJ& obj, Direction direction, MappedBy author) {
  const uint32_t right = direction == Direction::receive ? CO_OBJ______W : CO_OBJ_____R_;
  const uint32_t flags = right | static_cast<uint32_t>(author);
  return (obj.Key & flags) == flags && function_of(obj, direction) != nullptr;
}

bool is_bit(const CO_OBJ& obj) { return maps_bits && obj.Type == CO_TBOOLEAN; }

bool has_length(CO_NODE& node, CO_OBJ& obj, unsigned bits) {
  const uint32_t bytes = (bits + 7U) / 8U;
  const bool whole = bits % 8 == 0 || (bits == 1 && is_bit(obj));
  return whole && bits - 1U < all_bits && obj::size(obj, node, obj::is_stream(obj) ? 0 : bytes) == bytes;
}

uintptr_t address_of(const CO_OBJ& obj) { return obj.Data; }

// Returns whether the value is exactly the bytes of its variable, accessible in one access. RPDO objects with flag A
// are written by their type, which detects changes.
bool is_plain(const CO_NODE& node, const CO_OBJ& obj, Direction direction, unsigned bytes) {
  const bool is_single_bit = maps_bits && bytes == 0;
  if (!copies || is_single_bit || integer::plain_bytes(obj) != bytes) {
    return false;
  }
  return direction == Direction::transmit ||
         (CO_IS_ASYNC(obj.Key) == 0 && port::is_writable(node, data_of<void>(obj), bytes));
}

// Joins numbers that are adjacent in the frame and in memory to copies of whole words. Aligned numbers are still
// written in one access each.
void join(const CO_OBJ* root, CO_PDO_MAP& map, unsigned num) {
  unsigned position = 0;   // in the frame
  unsigned first = 0;      // slot of the first number of the current run of adjacent numbers
  unsigned begin = 0;      // its position in the frame
  uintptr_t distance = 0;  // its address minus its position; never 0
  for (unsigned slot = 0; slot < num; ++slot) {
    const uintptr_t address = address_of(root[map.Entry[slot]]);
    if (address - position != distance) {
      first = slot;
      begin = position;
      distance = address - position;
    }
    const unsigned bytes = unsigned{map.Step[slot]} / one_byte;
    if ((position & (bytes - 1U)) != 0) {
      map.Step[slot] |= shifted;
    }
    position += bytes;
    if ((begin | distance | position) % sizeof(Word) == 0) {
      __builtin_memset(map.Step + first, 0, slot - first + 1);
      map.Step[first] = static_cast<uint8_t>((position - begin) * one_byte);
    }
  }
}

// Adds an object to a mapping, and increases Span so that it includes the object's distance from the first one. obj:
// null for bits that are skipped
void add(const CO_NODE& node, CO_PDO_MAP& map, unsigned slot, const CO_OBJ* obj) {
  map.Entry[slot] = obj == nullptr ? no_entry : number_of(node, *obj);
  const auto behind = static_cast<uint16_t>(map.Entry[slot] - map.Entry[0]);
  while (behind >> map.Span != 0) {
    ++map.Span;
  }
}

// Copies a 16- or 32-bit number that is not aligned in the frame. Returns its bytes.
template <Direction direction>
inline unsigned copy_shifted(void* variable, uint8_t* data, unsigned bytes) {
  uint32_t value = 0;
  if (direction == Direction::transmit) {
    value = bytes == sizeof(Half) ? *static_cast<Half*>(variable) : *static_cast<Word*>(variable);
    for (unsigned n = 0; n != bytes; ++n, value >>= 8) {
      data[n] = static_cast<uint8_t>(value);
    }
    return bytes;
  }
  for (unsigned n = bytes; n != 0; --n) {
    value = (value << 8) | data[n - 1];
  }
  if (bytes == sizeof(Half)) {
    *static_cast<Half*>(variable) = static_cast<uint16_t>(value);
  } else {
    *static_cast<Word*>(variable) = value;
  }
  return bytes;
}

// Executes one copy. Variables are aligned, so each number is accessed atomically. Returns the bytes copied.
template <Direction direction>
inline unsigned copy_access(void* variable, uint8_t* data, unsigned step) {
  constexpr bool receives = direction == Direction::receive;
  void* const to = receives ? variable : data;
  const void* const from = receives ? data : variable;
  if (step == one_byte) {
    *static_cast<uint8_t*>(to) = *static_cast<const uint8_t*>(from);
  } else if (step == sizeof(Half) * one_byte) {
    *static_cast<Half*>(to) = *static_cast<const Half*>(from);
  } else if ((step & shifted) != 0) {
    return copy_shifted<direction>(variable, data, (step - shifted) / one_byte);
  } else if (step != 0) {
    static_cast<Word*>(to)[0] = static_cast<const Word*>(from)[0];
    if (step != sizeof(Word) * one_byte) {
      static_cast<Word*>(to)[1] = static_cast<const Word*>(from)[1];
    }
  }
  return step / one_byte;
}

template <Direction direction>
CO_ERR copy_plain(const CO_OBJ* root, const CO_PDO_MAP& map, uint8_t* data) {
  const uint16_t* entry = map.Entry;
  const uint8_t* const end = data + length_of(map);
  for (const uint8_t* step = map.Step; data != end; ++step, ++entry) {
    data += copy_access<direction>(data_of<void>(root[*entry]), data, *step);
  }
  return CO_ERR_NONE;
}

bool is_copied(const CO_PDO_MAP& map) { return copies && map.Step[0] < by_type; }

CO_ERR copy_plain(const CO_OBJ* root, const CO_PDO_MAP& map, uint8_t* data, Direction direction) {
  return direction == Direction::receive ? copy_plain<Direction::receive>(root, map, data)
                                         : copy_plain<Direction::transmit>(root, map, data);
}

// An object that is copied by its type, and its position in the frame, in units of CO_PDO_MAP.Length.
struct Field {
  CO_OBJ& obj;
  unsigned position;
  unsigned length;
};

bool is_whole(const Field& field) { return (field.position | field.length) % one_byte == 0; }
unsigned first_byte(const Field& field) { return field.position / one_byte; }
unsigned bytes_of(const Field& field) { return (field.length + one_byte - 1U) / one_byte; }

bool get_bit(const uint8_t* data, unsigned bit) { return (data[bit / 8] & (1U << (bit % 8))) != 0; }

void copy_bits(uint8_t* to, unsigned to_bit, const uint8_t* from, unsigned from_bit, unsigned n) {
  for (; n != 0; --n, ++to_bit, ++from_bit) {
    to[to_bit / 8] = static_cast<uint8_t>(to[to_bit / 8] | (get_bit(from, from_bit) ? 1U << (to_bit % 8) : 0U));
  }
}

// Calls the Read or Write function of an object. value: the object's bytes in the order of the bus, converted to and
// from that of the CPU.
CO_ERR call_type(CO_NODE& node, const Field& field, uint8_t* value, Direction direction) {
  const uint32_t bytes = bytes_of(field);
  const uint32_t number = obj::is_stream(field.obj) ? 0 : bytes;
  if (direction == Direction::receive) {
    wire::swap_host(value, number);
  }
  const CO_ERR err = obj::access_whole(field.obj, node, function_of(field.obj, direction), value, bytes);
  if (direction == Direction::transmit) {
    wire::swap_host(value, number);
  }
  return err;
}

// Copies an object whose bits do not begin or end at a byte of the frame.
CO_ERR copy_bits_by_type(CO_NODE& node, CO_IF_FRM& frame, const Field& field, Direction direction) {
  uint8_t value[8] = {};
  if (direction == Direction::receive) {
    copy_bits(value, 0, frame.Data, field.position, field.length);
    return call_type(node, field, value, direction);
  }
  const CO_ERR err = call_type(node, field, value, direction);
  copy_bits(frame.Data, field.position, value, 0, field.length);
  return err;
}

CO_ERR copy_by_type(CO_NODE& node, CO_IF_FRM& frame, const Field& field, Direction direction) {
  if (!is_whole(field)) {
    return copy_bits_by_type(node, frame, field, direction);
  }
  const auto callback = direction == Direction::receive ? CORpdoWriteData : COTpdoReadData;
  const unsigned bytes = bytes_of(field);
  if (callback != nullptr && bytes > longest_number) {
    callback(&frame, static_cast<uint8_t>(first_byte(field)), static_cast<uint8_t>(bytes), &field.obj);
    return CO_ERR_NONE;
  }
  return call_type(node, field, frame.Data + first_byte(field), direction);
}

// Copies an object and reports an error.
CO_ERR copy_or_report(CO_NODE& node, CO_IF_FRM& frame, const Field& field, Direction direction) {
  const CO_ERR err = copy_by_type(node, frame, field, direction);
  error::report(node, err, field.obj.Key);
  return err;
}

CO_ERR copy_by_types(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame, Direction direction) {
  CO_ERR result = CO_ERR_NONE;
  unsigned position = 0;
  for (unsigned slot = 0; position != map.Length; ++slot) {
    CO_ASSERT(slot < CO_PDO_MAP_N && position < map.Length);
    const unsigned entry = map.Entry[slot];
    const unsigned length = map.Step[slot] % by_type;
    CO_ASSERT(entry == no_entry || entry < node.Dict.Num);
    if (entry != no_entry) {
      const CO_ERR err = copy_or_report(node, frame, {node.Dict.Root[entry], position, length}, direction);
      result = err != CO_ERR_NONE ? err : result;
    }
    position += length;
  }
  return direction == Direction::receive ? CO_ERR_NONE : result;
}

[[gnu::noinline]] CO_ERR copy_locked(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame, Direction direction) {
  const Lock lock(node);
  return is_copied(map) ? copy_plain(node.Dict.Root, map, frame.Data, direction)
                        : copy_by_types(node, map, frame, direction);
}

}  // namespace

CO_ERR check(CO_NODE& node, Direction direction, uint32_t mapping, MappedBy author) {
  if (is_static_type(mapping)) {
    return is_skipped(direction, mapping) ? CO_ERR_NONE : CO_ERR_OBJ_MAP_TYPE;
  }
  CO_OBJ* const obj = dict::find(node, mapping);
  if (obj == nullptr) {
    return dict::has_index(node.Dict, mapping) ? CO_ERR_OBJ_MAP_TYPE : CO_ERR_OBJ_NOT_FOUND;
  }
  return is_mappable(*obj, direction, author) && has_length(node, *obj, mapping & 0xFFU) ? CO_ERR_NONE
                                                                                         : CO_ERR_OBJ_MAP_TYPE;
}

Resolved resolve(CO_NODE& node, unsigned index, unsigned num, CO_PDO_MAP& map, MappedBy author) {
  const Direction direction = direction_of(index);
  unsigned bits = 0;
  uint8_t fitting = 0;  // entries that fit completely into the frame
  bool plain = copies;
  map.Length = 0;
  mpdo::clear_mode(map);
  if (num > CO_PDO_MAP_N) {
    return {mpdo::resolve(node, index, num, map), 0};
  }
  map.Span = 0;
  __builtin_memset(map.Entry, UINT8_MAX, sizeof map.Entry);
  for (unsigned slot = 0; slot < num; ++slot) {
    const uint32_t mapping = read_number(node, CO_DEV(index, slot + 1), sizeof mapping, 0);
    const auto sub = static_cast<uint8_t>(slot + 1);
    if (mapping == 0) {
      return {CO_ERR_OBJ_MAP_LEN, sub};
    }
    if (check(node, direction, mapping, author) != CO_ERR_NONE) {
      return {CO_ERR_OBJ_MAP_TYPE, sub};
    }
    const CO_OBJ* const obj = is_static_type(mapping) ? nullptr : dict::find(node, mapping);
    const unsigned length = mapping & 0xFFU;
    plain = plain && obj != nullptr && is_plain(node, *obj, direction, length / 8);
    add(node, map, slot, obj);
    map.Step[slot] = static_cast<uint8_t>(length / unit);
    bits += length;
    fitting = bits <= all_bits ? sub : fitting;
  }
  if (fitting != num) {
    return {CO_ERR_OBJ_MAP_LEN, static_cast<uint8_t>(fitting + 1)};
  }
  if (plain) {
    join(node.Dict.Root, map, num);
  } else {
    map.Step[0] |= by_type;
  }
  map.Length = static_cast<uint8_t>(bits / unit);
  return {CO_ERR_NONE, 0};
}

// Returns whether the lengths in Step add up to the length of the frame. For assertions.
[[maybe_unused]] static bool is_consistent(const CO_PDO_MAP& map) {
  const unsigned total = is_copied(map) ? length_of(map) : map.Length;
  unsigned sum = 0;
  for (unsigned slot = 0; slot < CO_PDO_MAP_N && sum < total; ++slot) {
    const unsigned step = map.Step[slot] % by_type;
    const unsigned copied = ((step & shifted) != 0 ? step - shifted : step) / one_byte;
    sum += is_copied(map) ? copied : step;
  }
  return sum == total && length_of(map) <= sizeof(CO_IF_FRM::Data);
}

CO_ERR copy_objects(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame, Direction direction) {
  CO_ASSERT(exists(map) && is_consistent(map));
  const bool at_once = is_copied(map) && node.Ext->OdLock == nullptr;
  return at_once ? copy_plain(node.Dict.Root, map, frame.Data, direction) : copy_locked(node, map, frame, direction);
}

unsigned find(const CO_PDO_MAP& map, uint16_t entry) {
  unsigned slot = exists(map) ? 0 : CO_PDO_MAP_N;
  while (slot < CO_PDO_MAP_N && map.Entry[slot] != entry) {
    ++slot;
  }
  return slot;
}

bool take_transferred(CO_PDO_MAP& map) {
  const bool was = has(map, transferred);
  clear(map, transferred);
  return was;
}

bool take_transferred(CO_PDO_MAP& map, uint16_t entry) {
  const unsigned slot = find(map, entry);
  if (slot == CO_PDO_MAP_N) {
    return false;
  }
  const auto bit = static_cast<uint8_t>(1U << (slot % 8U));
  uint8_t& bits = map.Transferred[slot / 8U];
  const bool was = (bits & bit) != 0;
  bits = static_cast<uint8_t>(bits & ~bit);
  return was;
}

}  // namespace co::pdo
