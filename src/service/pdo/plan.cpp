// SPDX-License-Identifier: Apache-2.0
#include "service/pdo/plan.hpp"

#include "core/dict.hpp"
#include "core/obj.hpp"
#include "core/port.hpp"
#include "object/place.hpp"
#include "wire/bytes.hpp"

// Only an application that defines them has them; see co_pdo.h.
#pragma weak CORpdoWriteData
#pragma weak COTpdoReadData

namespace co::pdo {
namespace {

constexpr uint16_t no_entry = 0xFFFF;
constexpr uint8_t by_type = 0x80;
constexpr uint8_t all_bits = 64;
constexpr uint8_t longest_number = 4;  // bytes, that callbacks of the application do not get
constexpr bool maps_bits = USE_PDO_BITS != 0;

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
  switch (bits) {
    case 8: return &COTInt8;
    case 16: return &COTInt16;
    case 32: return &COTInt32;
    default: return nullptr;
  }
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
         port::is_writable(node, place_of(obj), bits / 8U);
}

// A number that lies behind the one before it, in the frame as in memory, is copied with it.
void merge(const CO_NODE& node, CO_PDO_MAP& map, uint8_t first, uint8_t place) {
  if (maps_bits || place == 0) {
    return;
  }
  const uint8_t width = map.Bits[place];
  const uint8_t before = map.Bits[first];
  if (((width | before) & by_type) != 0 || map.Entry[place] == no_entry || map.Entry[first] == no_entry) {
    return;
  }
  CO_OBJ& a = node.Dict.Root[map.Entry[first]];
  CO_OBJ& b = node.Dict.Root[map.Entry[place]];
  const bool same_width = a.Type->Size == b.Type->Size;
  if (same_width && static_cast<uint8_t*>(place_of(a)) + before / 8 == place_of(b)) {
    map.Bits[first] = static_cast<uint8_t>(before + width);
    map.Bits[place] = 0;
  }
}

uint16_t number_of(const CO_NODE& node, const CO_OBJ* obj) {
  return obj == nullptr ? no_entry : static_cast<uint16_t>(obj - node.Dict.Root);
}

// Memory of the application is read and written in units as wide as it is aligned: a number is never torn. The other
// side is a frame.

typedef volatile uint32_t Word __attribute__((may_alias));
typedef volatile uint16_t Half __attribute__((may_alias));

bool is_aligned(const uint8_t* memory, uint32_t bytes, uintptr_t to) {
  return ((reinterpret_cast<uintptr_t>(memory) | bytes) & (to - 1)) == 0;
}

void to_memory(uint8_t* to, const uint8_t* from, uint32_t n) {
  const uint8_t* const end = from + n;
  if (is_aligned(to, n, sizeof(uint32_t))) {
    for (; from != end; from += sizeof(uint32_t), to += sizeof(uint32_t)) {
      *static_cast<Word*>(static_cast<void*>(to)) = wire::get_u32(from);
    }
  } else if (is_aligned(to, n, sizeof(uint16_t))) {
    for (; from != end; from += sizeof(uint16_t), to += sizeof(uint16_t)) {
      *static_cast<Half*>(static_cast<void*>(to)) = wire::get_u16(from);
    }
  } else {
    for (; from != end; ++from, ++to) {
      *static_cast<volatile uint8_t*>(to) = *from;
    }
  }
}

void from_memory(uint8_t* to, const uint8_t* from, uint32_t n) {
  const uint8_t* const end = from + n;
  if (is_aligned(from, n, sizeof(uint32_t))) {
    for (; from != end; from += sizeof(uint32_t), to += sizeof(uint32_t)) {
      wire::put_u32(to, *static_cast<const Word*>(static_cast<const void*>(from)));
    }
  } else if (is_aligned(from, n, sizeof(uint16_t))) {
    for (; from != end; from += sizeof(uint16_t), to += sizeof(uint16_t)) {
      wire::put_u16(to, *static_cast<const Half*>(static_cast<const void*>(from)));
    }
  } else {
    for (; from != end; ++from, ++to) {
      *to = *static_cast<const volatile uint8_t*>(from);
    }
  }
}

// A step of a plan: an object, or neighbours, and where it lies in the frame.
struct Step {
  CO_OBJ& obj;
  uint8_t position;  // bits
  uint8_t bits;
  bool typed;
};

bool is_whole(const Step& step) { return !maps_bits || ((step.position | step.bits) & 7U) == 0; }
uint8_t* first_byte(CO_IF_FRM& frame, const Step& step) { return frame.Data + step.position / 8; }

bool get_bit(const uint8_t* data, unsigned bit) { return (data[bit / 8] & (1U << (bit % 8))) != 0; }
void put_bit(CO_IF_FRM& frame, unsigned bit, bool value) {
  frame.Data[bit / 8] = static_cast<uint8_t>(frame.Data[bit / 8] | (value ? 1U << (bit % 8) : 0U));
}

// Bytes of a step in front, whatever bits of the frame they are.
void extract(const CO_IF_FRM& frame, const Step& step, uint8_t* value) {
  for (unsigned bit = 0; bit < step.bits; ++bit) {
    value[bit / 8] =
        static_cast<uint8_t>(value[bit / 8] | (get_bit(frame.Data, step.position + bit) ? 1U << (bit % 8) : 0U));
  }
}
void place(CO_IF_FRM& frame, const Step& step, const uint8_t* value) {
  for (unsigned bit = 0; bit < step.bits; ++bit) {
    put_bit(frame, step.position + bit, get_bit(value, bit));
  }
}

bool is_left_to(void (*callback)(CO_IF_FRM*, uint8_t, uint8_t, CO_OBJ*), const Step& step) {
  return callback != nullptr && step.bits > longest_number * 8U && is_whole(step);
}

CO_ERR write_by_type(CO_NODE& node, CO_IF_FRM& frame, const Step& step) {
  const uint32_t n = (step.bits + 7U) / 8U;
  if (is_left_to(CORpdoWriteData, step)) {
    CORpdoWriteData(&frame, step.position / 8, static_cast<uint8_t>(n), &step.obj);
    return CO_ERR_NONE;
  }
  uint8_t value[8] = {};
  if (is_whole(step)) {
    __builtin_memcpy(value, first_byte(frame, step), n);
  } else {
    extract(frame, step, value);
  }
  if (!obj::is_stream(step.obj)) {
    wire::swap_host(value, n);
  }
  const CO_ERR err = obj::seek(step.obj, node, 0);
  return err == CO_ERR_NONE ? obj::write(step.obj, node, value, n) : err;
}

CO_ERR read_by_type(CO_NODE& node, CO_IF_FRM& frame, const Step& step) {
  const uint32_t n = (step.bits + 7U) / 8U;
  if (is_left_to(COTpdoReadData, step)) {
    COTpdoReadData(&frame, step.position / 8, static_cast<uint8_t>(n), &step.obj);
    return CO_ERR_NONE;
  }
  uint8_t value[8] = {};
  CO_ERR err = obj::seek(step.obj, node, 0);
  if (err == CO_ERR_NONE) {
    err = obj::read(step.obj, node, value, n);
  }
  if (!obj::is_stream(step.obj)) {
    wire::swap_host(value, n);
  }
  if (is_whole(step)) {
    __builtin_memcpy(first_byte(frame, step), value, n);
  } else {
    place(frame, step, value);
  }
  return err;
}

void write_step(CO_NODE& node, CO_IF_FRM& frame, const Step& step) {
  if (!step.typed && is_whole(step)) {
    to_memory(static_cast<uint8_t*>(place_of(step.obj)), first_byte(frame, step), step.bits / 8U);
    return;
  }
  const CO_ERR err = write_by_type(node, frame, step);
  if (err != CO_ERR_NONE) {
    node.Error = err;
  }
}

CO_ERR read_step(CO_NODE& node, CO_IF_FRM& frame, const Step& step) {
  if (!step.typed && is_whole(step)) {
    from_memory(first_byte(frame, step), static_cast<const uint8_t*>(place_of(step.obj)), step.bits / 8U);
    return CO_ERR_NONE;
  }
  return read_by_type(node, frame, step);
}

}  // namespace

Lock::Lock(CO_NODE& node) : node_(node) {
  if (node.OdLocked++ == 0 && node.Ext->OdLock != nullptr) {
    node.Ext->OdLock(node.Ext->User);
  }
}

Lock::~Lock() {
  if (--node_.OdLocked == 0 && node_.Ext->OdUnlock != nullptr) {
    node_.Ext->OdUnlock(node_.Ext->User);
  }
}

CO_ERR check(CO_NODE& node, Direction direction, uint32_t mapping) {
  CO_OBJ* obj = nullptr;
  return locate(node, direction, mapping, obj);
}

CO_ERR resolve(CO_NODE& node, Direction direction, uint16_t index, uint8_t num, CO_PDO_MAP& map) {
  unsigned length = 0;
  uint8_t first = 0;
  if (num > CO_PDO_MAP_N) {
    return CO_ERR_OBJ_MAP_LEN;
  }
  for (uint8_t place = 0; place < num; ++place) {
    uint32_t mapping = 0;
    CO_OBJ* obj = nullptr;
    if (dict::read_u32(node.Dict, CO_DEV(index, place + 1), mapping) != CO_ERR_NONE || mapping == 0) {
      return CO_ERR_OBJ_MAP_LEN;
    }
    if (locate(node, direction, mapping, obj) != CO_ERR_NONE) {
      return CO_ERR_OBJ_MAP_TYPE;
    }
    const auto bits = static_cast<uint8_t>(mapping);
    const bool plain = obj == nullptr || is_plain(node, *obj, direction, bits);
    length += bits;
    map.Entry[place] = number_of(node, obj);
    map.Bits[place] = static_cast<uint8_t>(bits | (plain ? 0 : by_type));
    merge(node, map, first, place);
    first = map.Bits[place] != 0 ? place : first;
  }
  map.Num = num;
  map.Length = static_cast<uint8_t>((length + 7U) / 8U);
  return length > all_bits ? CO_ERR_OBJ_MAP_LEN : CO_ERR_NONE;
}

// A type function that changes the mapping itself changes what is left of it.
void write(CO_NODE& node, CO_PDO_MAP& map, const CO_IF_FRM& frame) {
  CO_IF_FRM copy = frame;
  uint8_t position = 0;
  for (uint8_t place = 0; place < map.Num && position < all_bits; ++place) {
    const auto bits = static_cast<uint8_t>(map.Bits[place] & ~by_type);
    const uint16_t entry = map.Entry[place];
    if (bits != 0 && entry < node.Dict.Num) {
      write_step(node, copy, {node.Dict.Root[entry], position, bits, (map.Bits[place] & by_type) != 0});
    }
    position = static_cast<uint8_t>(position + bits);
  }
  pass(map);
}

CO_ERR read(CO_NODE& node, CO_PDO_MAP& map, CO_IF_FRM& frame) {
  uint8_t position = 0;
  CO_ERR err = CO_ERR_NONE;
  for (uint8_t place = 0; place < map.Num && position < all_bits && err == CO_ERR_NONE; ++place) {
    const auto bits = static_cast<uint8_t>(map.Bits[place] & ~by_type);
    const uint16_t entry = map.Entry[place];
    if (bits != 0 && entry < node.Dict.Num) {
      err = read_step(node, frame, {node.Dict.Root[entry], position, bits, (map.Bits[place] & by_type) != 0});
    }
    position = static_cast<uint8_t>(position + bits);
  }
  return err;
}

uint8_t find(const CO_NODE& node, const CO_PDO_MAP& map, const CO_OBJ& obj) {
  const uint16_t entry = number_of(node, &obj);
  uint8_t place = 0;
  while (place < map.Num && map.Entry[place] != entry) {
    ++place;
  }
  return place;
}

void pass(CO_PDO_MAP& map) { __builtin_memset(map.Passed, 0xFF, sizeof map.Passed); }

bool has_passed(CO_PDO_MAP& map, uint8_t place) {
  const auto bit = static_cast<uint8_t>(1U << (place % 8U));
  uint8_t& bits = map.Passed[place / 8U];
  const bool passed = (bits & bit) != 0;
  bits = static_cast<uint8_t>(bits & ~bit);
  return passed;
}

}  // namespace co::pdo
