// SPDX-License-Identifier: Apache-2.0
// What a PDO holds: a mapping of the dictionary, resolved into steps, and the copies that they stand for.
#pragma once

#include "co_core.h"
#include "object/place.hpp"
#include "wire/bytes.hpp"

namespace co::pdo {

enum class Direction : uint8_t { receive, transmit };

// Of CO_PDO_MAP.Flags; the others belong to the PDO.
constexpr uint8_t passed = 0x40;  // sent or received since the application has asked
constexpr uint8_t served = 0x80;  // being sent or received; cleared by whatever changes the PDO, or ends Operational

[[nodiscard]] inline bool has(const CO_PDO_MAP& map, unsigned flags) { return (map.Flags & flags) != 0; }
inline void set(CO_PDO_MAP& map, unsigned flags) { map.Flags = static_cast<uint8_t>(map.Flags | flags); }
inline void clear(CO_PDO_MAP& map, unsigned flags) { map.Flags = static_cast<uint8_t>(map.Flags & ~flags); }

[[nodiscard]] inline bool exists(const CO_PDO_MAP& map) { return map.Length != 0; }

// Bytes of the frame.
[[nodiscard]] inline uint8_t length_of(const CO_PDO_MAP& map) {
  return USE_PDO_BITS != 0 ? static_cast<uint8_t>((map.Length + 7U) / 8U) : map.Length;
}

// May the object that a mapping entry names be mapped so? [301:7.4.7, 7.5.2.36]
[[nodiscard]] CO_ERR check(CO_NODE& node, Direction direction, uint32_t mapping);

// Resolves num entries of the mapping at index (1600h…, 1A00h…).
[[nodiscard]] CO_ERR resolve(CO_NODE& node, Direction direction, uint16_t index, uint8_t num, CO_PDO_MAP& map);

// Holds CO_NODE_EXT.OdLock while it lives.
class Lock {
 public:
  explicit Lock(CO_NODE& node) : node_(node) {
    if (node.OdLocked++ == 0 && node.Ext->OdLock != nullptr) {
      node.Ext->OdLock(node.Ext->User);
    }
  }
  ~Lock() {
    if (--node_.OdLocked == 0 && node_.Ext->OdUnlock != nullptr) {
      node_.Ext->OdUnlock(node_.Ext->User);
    }
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  CO_NODE& node_;
};

// Copying ------------------------------------------------------------------------------------------------------------

constexpr bool maps_bits = USE_PDO_BITS != 0;
constexpr uint8_t one_byte = maps_bits ? 8 : 1;  // in units of CO_PDO_MAP.Length and Step
constexpr uint8_t by_type = 0x80;                // in Step

typedef volatile uint32_t Word __attribute__((may_alias));
typedef volatile uint16_t Half __attribute__((may_alias));

// The 8 bytes of a frame, to or from where they are kept: both lie aligned.
inline void copy_data(uint8_t* to, const uint8_t* from) {
  wire::put_aligned(to, wire::get_aligned(from));
  wire::put_aligned(to + sizeof(Word), wire::get_aligned(from + sizeof(Word)));
}

// What both addresses and the length are multiples of, in its lowest bits.
inline uintptr_t alignment_of(const void* to, const void* from, uint32_t n) {
  return reinterpret_cast<uintptr_t>(to) | reinterpret_cast<uintptr_t>(from) | n;
}

template <class T>
inline void copy_unit(void* to, const void* from, unsigned n = 0) {
  static_cast<T*>(to)[n] = static_cast<const T*>(from)[n];
}

// Copies neighbours, or a number of 2 or 4 bytes, if they lie in the frame as aligned as in memory.
inline bool copy_alike(void* to, const void* from, uint32_t n) {
  const uintptr_t alignment = alignment_of(to, from, n);
  if (alignment % sizeof(Word) == 0) {
    copy_unit<Word>(to, from);
    if (n > sizeof(Word)) {
      copy_unit<Word>(to, from, 1);
    }
    return true;
  }
  const bool half = n == sizeof(Half) && alignment % sizeof(Half) == 0;
  if (half) {
    copy_unit<Half>(to, from);
  }
  return half;
}

// Copies what a step stands for, if it is a plain object. Most are bytes.
template <Direction direction>
inline bool copy_plain(const CO_OBJ* root, uint16_t entry, uint8_t* data, unsigned bytes) {
  constexpr unsigned typed = by_type / one_byte;
  constexpr bool receives = direction == Direction::receive;
  if (bytes == 1) {
    uint8_t* const variable = data_of<uint8_t>(root[entry]);
    copy_unit<uint8_t>(receives ? variable : data, receives ? data : variable);
    return true;
  }
  if (bytes == 0 || bytes >= typed) {
    return bytes == 0;
  }
  uint8_t* const variable = data_of<uint8_t>(root[entry]);
  return copy_alike(receives ? variable : data, receives ? data : variable, bytes);
}

// How far the copying of a PDO has come.
struct Progress {
  uint8_t place;
  uint8_t position;
};

// Goes on from there, in every case; the objects are locked meanwhile.
[[nodiscard]] CO_ERR copy_rest(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame, Direction direction,
                               Progress at);

// Copies the data of a frame into the objects of a PDO that is served, or the objects into a frame. Returns what the
// type of one has answered that could not be read; CO_ERR_TPDO_COM_OBJ: something has changed the PDO meanwhile, what
// was left of it is not copied.
template <Direction direction>
[[nodiscard]] inline CO_ERR copy_objects(CO_NODE& node, const CO_PDO_MAP& map, CO_IF_FRM& frame) {
  const uint16_t* entry = map.Entry;
  const uint8_t* step = map.Step;
  uint8_t* data = frame.Data;
  if (node.Ext->OdLock == nullptr && node.Pending == 0) {
    const CO_OBJ* const root = node.Dict.Root;
    const uint8_t* const end = data + length_of(map);
    for (; data != end && copy_plain<direction>(root, *entry, data, *step / one_byte); ++entry, ++step) {
      data += *step / one_byte;
    }
    if (data == end) {
      return CO_ERR_NONE;
    }
  }
  const auto place = static_cast<uint8_t>(step - map.Step);
  const auto position = static_cast<uint8_t>((data - frame.Data) * one_byte);
  return copy_rest(node, map, frame, direction, {place, position});
}

[[nodiscard]] inline uint16_t number_of(const CO_NODE& node, const CO_OBJ& obj) {
  return static_cast<uint16_t>(&obj - node.Dict.Root);
}

// Place of an entry in the mapping, or CO_PDO_MAP_N.
[[nodiscard]] unsigned find(const CO_PDO_MAP& map, uint16_t entry);

// Of many PDOs most are known at a glance.
[[nodiscard, gnu::always_inline]] inline bool maps(const CO_PDO_MAP& map, uint16_t entry) {
  const auto behind = static_cast<uint16_t>(entry - map.Entry[0]);
  return behind >> map.Span == 0 && find(map, entry) != CO_PDO_MAP_N;
}

// It has passed, with every object. Asking forgets it.
inline void pass(CO_PDO_MAP& map) {
  __builtin_memset(map.Passed, 0xFF, sizeof map.Passed);
  set(map, passed);
}
[[nodiscard]] bool has_passed(CO_PDO_MAP& map);
[[nodiscard]] bool has_passed(CO_PDO_MAP& map, uint16_t entry);

}  // namespace co::pdo
