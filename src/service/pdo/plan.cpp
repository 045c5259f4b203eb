// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/plan.hpp"

#include "core/dict.hpp"
#include "core/events.hpp"
#include "core/obj.hpp"
#include "core/port.hpp"
#include "object/place.hpp"
#include "service/pdo/mpdo.hpp"
#include "wire/bytes.hpp"

// Only an application that defines them has them; see co_pdo.h.
#pragma weak CORpdoWriteData
#pragma weak COTpdoReadData

namespace co::pdo {
namespace {

constexpr uint16_t no_entry = 0xFFFF;
constexpr uint8_t all_bits = 64;
constexpr uint8_t unit = 8 / one_byte;  // bits
constexpr uint8_t longest_number = 4;   // bytes, that callbacks of the application do not get

// BOOLEAN, INTEGER8, 16, 32, UNSIGNED8, 16, 32: objects that are never written, only skipped. [301:7.4.1 table 44]
constexpr uint8_t static_type_bits[] = {1, 8, 16, 32, 8, 16, 32};

bool is_static_type(uint32_t mapping) {
  const uint16_t index = CO_GET_IDX(mapping);
  return index >= 1 && index <= sizeof static_type_bits;
}

CO_ERR check_static_type(Direction direction, uint32_t mapping) {
  const uint8_t bits = static_type_bits[CO_GET_IDX(mapping) - 1];
  const bool fits = maps_bits || bits % 8 == 0;
  const bool named = CO_GET_SUB(mapping) == 0 && (mapping & 0xFFU) == bits;
  return direction == Direction::receive && fits && named ? CO_ERR_NONE : CO_ERR_OBJ_MAP_TYPE;
}

bool is_mappable(const CO_OBJ& obj, Direction direction) {
  const uint32_t right = direction == Direction::receive ? CO_OBJ____P_W : CO_OBJ____PR_;
  const bool has_function = direction == Direction::receive ? obj.Type->Write != nullptr : obj.Type->Read != nullptr;
  return (obj.Key & right) == right && has_function;
}

bool is_bit(const CO_OBJ& obj) {
  if constexpr (maps_bits) {
    return obj.Type == CO_TBOOLEAN;
  }
  return false;
}

CO_ERR check_length(CO_NODE& node, CO_OBJ& obj, uint8_t bits) {
  const uint32_t bytes = (bits + 7U) / 8U;
  const bool whole = bits % 8 == 0 || (bits == 1 && is_bit(obj));
  const bool fits = bits != 0 && bits <= all_bits && whole;
  const bool exact = fits && obj::size(obj, node, obj::is_stream(obj) ? 0 : bytes) == bytes;
  return exact ? CO_ERR_NONE : CO_ERR_OBJ_MAP_TYPE;
}

// The object that a mapping entry names; null for a static type.
CO_ERR locate(CO_NODE& node, Direction direction, uint32_t mapping, CO_OBJ*& obj) {
  obj = nullptr;
  if (is_static_type(mapping)) {
    return check_static_type(direction, mapping);
  }
  obj = dict::find(node.Dict, CO_GET_DEV(mapping));
  if (obj == nullptr) {
    return dict::has_index(node.Dict, mapping) ? CO_ERR_OBJ_MAP_TYPE : CO_ERR_OBJ_NOT_FOUND;
  }
  return is_mappable(*obj, direction) ? check_length(node, *obj, mapping & 0xFFU) : CO_ERR_OBJ_MAP_TYPE;
}

const CO_OBJ_TYPE* number_of_bits(uint8_t bits) {
  if (bits == 8) {
    return &COTInt8;
  }
  if (bits == 16) {
    return &COTInt16;
  }
  return bits == 32 ? &COTInt32 : nullptr;
}

// Is the value nothing but the bytes of its variable? What a change has to be noticed of (flag A) is written by its
// type.
bool is_plain(const CO_NODE& node, CO_OBJ& obj, Direction direction, uint8_t bits) {
  constexpr uint32_t none = CO_OBJ_D_____ | CO_OBJ__N____;
  const CO_OBJ_TYPE* const number = number_of_bits(bits);
  if (!wire::host_is_little_endian || number == nullptr || (obj.Key & none) != 0) {
    return false;
  }
  if (direction == Direction::transmit) {
    return obj.Type->Read == number->Read;
  }
  return obj.Type->Write == number->Write && CO_IS_ASYNC(obj.Key) == 0 &&
         port::is_writable(node, data_of<void>(obj), bits / 8U);
}

// Numbers of one width that lie side by side, in the frame as in memory, are copied together.
struct Row {
  uint8_t first;  // place
  uint8_t width;  // bits
  const uint8_t* end;
};

void merge(CO_PDO_MAP& map, Row& row, uint8_t place, uint8_t width, const uint8_t* variable) {
  if (!maps_bits && variable != nullptr && variable == row.end && width == row.width) {
    map.Step[row.first] = static_cast<uint8_t>(map.Step[row.first] + map.Step[place]);
    map.Step[place] = 0;
  } else {
    row.first = place;
    row.width = width;
  }
  row.end = variable == nullptr ? nullptr : variable + width / 8;
}

void add(const CO_NODE& node, CO_PDO_MAP& map, uint8_t place, const CO_OBJ* obj, uint8_t step) {
  map.Entry[place] = obj == nullptr ? no_entry : number_of(node, *obj);
  map.Step[place] = step;
  const auto behind = static_cast<uint16_t>(map.Entry[place] - map.Entry[0]);
  while (behind >> map.Span != 0) {
    ++map.Span;
  }
}

template <class T>
void copy_units(void* to, const void* from, uint32_t n) {
  for (uint32_t place = 0; place < n / sizeof(T); ++place) {
    copy_unit<T>(to, from, place);
  }
}

// In units as wide as both sides are aligned.
void copy_aligned(void* to, const void* from, uint32_t n) {
  const uintptr_t alignment = alignment_of(to, from, n);
  if (alignment % sizeof(Word) == 0) {
    copy_units<Word>(to, from, n);
  } else if (alignment % sizeof(Half) == 0) {
    copy_units<Half>(to, from, n);
  } else {
    copy_units<uint8_t>(to, from, n);
  }
}

// One of both is a frame. Memory of the application is read and written in units as wide as it is aligned, so that a
// number is never torn, wherever it lies in the frame.
void copy(void* to, const void* from, uint32_t n) {
  uint32_t buffer[2] = {};
  const uintptr_t different = reinterpret_cast<uintptr_t>(to) ^ reinterpret_cast<uintptr_t>(from);
  if (different % sizeof(Word) != 0) {
    copy_aligned(buffer, from, n);
    from = buffer;
  }
  copy_aligned(to, from, n);
}

// An object that is copied by its type, and where it lies in the frame, in units.
struct Part {
  CO_OBJ& obj;
  uint8_t position;
  uint8_t length;
};

bool is_whole(const Part& part) { return (part.position | part.length) % one_byte == 0; }
uint8_t first_byte(const Part& part) { return part.position / one_byte; }
uint8_t bytes_of(const Part& part) { return static_cast<uint8_t>((part.length + one_byte - 1U) / one_byte); }

bool get_bit(const uint8_t* data, unsigned bit) { return (data[bit / 8] & (1U << (bit % 8))) != 0; }

void copy_bits(uint8_t* to, unsigned to_bit, const uint8_t* from, unsigned from_bit, unsigned n) {
  for (; n != 0; --n, ++to_bit, ++from_bit) {
    to[to_bit / 8] = static_cast<uint8_t>(to[to_bit / 8] | (get_bit(from, from_bit) ? 1U << (to_bit % 8) : 0U));
  }
}

void copy_part(uint8_t* value, CO_IF_FRM& frame, const Part& part, bool receives) {
  if (!is_whole(part)) {
    receives ? copy_bits(value, 0, frame.Data, part.position, part.length)
             : copy_bits(frame.Data, part.position, value, 0, part.length);
    return;
  }
  uint8_t* const data = frame.Data + first_byte(part);
  __builtin_memcpy(receives ? value : data, receives ? data : value, bytes_of(part));
}

CO_ERR copy_by_type(CO_NODE& node, CO_IF_FRM& frame, const Part& part, bool receives) {
  const uint8_t n = bytes_of(part);
  const auto callback = receives ? CORpdoWriteData : COTpdoReadData;
  if (callback != nullptr && n > longest_number && is_whole(part)) {
    callback(&frame, first_byte(part), n, &part.obj);
    return CO_ERR_NONE;
  }
  uint8_t value[8] = {};
  CO_ERR err = obj::seek(part.obj, node, 0);
  if (receives) {
    copy_part(value, frame, part, receives);
    if (!obj::is_stream(part.obj)) {
      wire::swap_host(value, n);
    }
    return err == CO_ERR_NONE ? obj::write(part.obj, node, value, n) : err;
  }
  if (err == CO_ERR_NONE) {
    err = obj::read(part.obj, node, value, n);
  }
  if (!obj::is_stream(part.obj)) {
    wire::swap_host(value, n);
  }
  copy_part(value, frame, part, receives);
  return err;
}

// Entries have their numbers until a frame has been processed in which CODictInit() was called.
bool is_numbered_anew(const CO_NODE& node) { return (node.Pending & event::remap) != 0; }

}  // namespace

CO_ERR check(CO_NODE& node, Direction direction, uint32_t mapping) {
  CO_OBJ* obj = nullptr;
  return locate(node, direction, mapping, obj);
}

CO_ERR resolve(CO_NODE& node, Direction direction, uint16_t index, uint8_t num, CO_PDO_MAP& map) {
  unsigned bits = 0;
  Row row = {};
  mpdo::set_mode(map, 0);
  if (num > CO_PDO_MAP_N) {
    return mpdo::resolve(node, direction, index, num, map);
  }
  map.Span = 0;
  __builtin_memset(map.Entry, UINT8_MAX, sizeof map.Entry);
  for (uint8_t place = 0; place < num; ++place) {
    uint32_t mapping = 0;
    CO_OBJ* obj = nullptr;
    if (dict::read_u32(node.Dict, CO_DEV(index, place + 1), mapping) != CO_ERR_NONE || mapping == 0) {
      return CO_ERR_OBJ_MAP_LEN;
    }
    if (locate(node, direction, mapping, obj) != CO_ERR_NONE) {
      return CO_ERR_OBJ_MAP_TYPE;
    }
    const auto length = static_cast<uint8_t>(mapping);
    const bool plain = obj != nullptr && (!maps_bits || bits % 8 == 0) && is_plain(node, *obj, direction, length);
    bits += length;
    add(node, map, place, obj, static_cast<uint8_t>(length / unit | (plain ? 0 : by_type)));
    merge(map, row, place, length, plain ? data_of<uint8_t>(*obj) : nullptr);
  }
  map.Length = static_cast<uint8_t>(bits / unit);
  return bits > all_bits ? CO_ERR_OBJ_MAP_LEN : CO_ERR_NONE;
}

// What cannot be written is the node's error, and the rest is written all the same; a TPDO is read as a whole. A type
// function that changes the PDO ends it.
CO_ERR copy_rest(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame, Direction direction, Progress at) {
  const bool receives = direction == Direction::receive;
  const Lock lock(node);
  for (;;) {
    if (!has(map, served) || is_numbered_anew(node)) {
      return CO_ERR_TPDO_COM_OBJ;
    }
    if (at.position >= map.Length) {
      return CO_ERR_NONE;
    }
    const uint16_t entry = map.Entry[at.place];
    const auto length = static_cast<uint8_t>(map.Step[at.place] & ~by_type);
    CO_ERR err = CO_ERR_NONE;
    if (map.Step[at.place] < by_type) {
      uint8_t* const variable = data_of<uint8_t>(node.Dict.Root[entry]);
      uint8_t* const data = frame.Data + at.position / one_byte;
      copy(receives ? variable : data, receives ? data : variable, length / one_byte);
    } else if (entry != no_entry) {
      err = copy_by_type(node, frame, {node.Dict.Root[entry], at.position, length}, receives);
    }
    if (err != CO_ERR_NONE) {
      node.Error = err;
    }
    if (err != CO_ERR_NONE && !receives) {
      return err;
    }
    ++at.place;
    at.position = static_cast<uint8_t>(at.position + length);
  }
}

unsigned find(const CO_PDO_MAP& map, uint16_t entry) {
  unsigned place = exists(map) ? 0 : CO_PDO_MAP_N;
  while (place < CO_PDO_MAP_N && map.Entry[place] != entry) {
    ++place;
  }
  return place;
}

bool has_passed(CO_PDO_MAP& map) {
  const bool was = has(map, passed);
  clear(map, passed);
  return was;
}

bool has_passed(CO_PDO_MAP& map, uint16_t entry) {
  const unsigned place = find(map, entry);
  if (place == CO_PDO_MAP_N) {
    return false;
  }
  const auto bit = static_cast<uint8_t>(1U << (place % 8U));
  uint8_t& bits = map.Passed[place / 8U];
  const bool was = (bits & bit) != 0;
  bits = static_cast<uint8_t>(bits & ~bit);
  return was;
}

}  // namespace co::pdo
