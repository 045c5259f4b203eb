// SPDX-License-Identifier: Apache-2.0
// INTEGERn, UNSIGNEDn, REALn and BOOLEAN: values in a variable of 1, 2, 4 or 8 bytes, or in the entry. Those of 1, 2
// and 4 bytes share their functions, and so do all others.
#include "object/integer.hpp"
#include "co_integer16.h"
#include "co_integer32.h"
#include "co_integer64.h"
#include "co_integer8.h"
#include "co_real.h"
#include "core/dict.hpp"
#include "core/events.hpp"
#include "core/port.hpp"
#include "object/place.hpp"
#include "wire/bytes.hpp"

namespace co::integer {
namespace {

// Of a number whose variable is wider than it is, or wider than a word.
struct Format {
  uint8_t bytes;    // on the bus
  uint8_t storage;  // bytes of the variable
  bool is_signed;   // the variable takes its sign
};

template <class T>
struct Aliasing {
  typedef T type __attribute__((may_alias));
};

template <class T>
bool is_one_access(const void* address, unsigned bytes) {
  return bytes == sizeof(T) && (reinterpret_cast<uintptr_t>(address) & (sizeof(T) - 1)) == 0;
}

template <class T>
volatile typename Aliasing<T>::type& as(void* address) {
  return *static_cast<volatile typename Aliasing<T>::type*>(address);
}
template <class T>
const volatile typename Aliasing<T>::type& as(const void* address) {
  return *static_cast<const volatile typename Aliasing<T>::type*>(address);
}

// A byte of a number in the byte order of the CPU and of any alignment: byte n from the lowest.
constexpr unsigned place_of_byte(unsigned n, unsigned bytes) { return wire::host_is_little_endian ? n : bytes - 1 - n; }

// One access where alignment allows it, so that an interrupt sees the old or the new value.
template <class T>
inline T load(const void* from, unsigned bytes) {
  if (sizeof(T) == 8 && is_one_access<uint64_t>(from, bytes)) {
    return static_cast<T>(as<uint64_t>(from));
  }
  if (is_one_access<uint32_t>(from, bytes)) {
    return as<uint32_t>(from);
  }
  if (is_one_access<uint16_t>(from, bytes)) {
    return as<uint16_t>(from);
  }
  T value = 0;
  for (unsigned n = bytes; n != 0; --n) {
    value = static_cast<T>(value << 8U) | static_cast<const uint8_t*>(from)[place_of_byte(n - 1, bytes)];
  }
  return value;
}

template <class T>
inline void store(void* to, T value, unsigned bytes) {
  if (sizeof(T) == 8 && is_one_access<uint64_t>(to, bytes)) {
    as<uint64_t>(to) = value;
  } else if (is_one_access<uint32_t>(to, bytes)) {
    as<uint32_t>(to) = static_cast<uint32_t>(value);
  } else if (is_one_access<uint16_t>(to, bytes)) {
    as<uint16_t>(to) = static_cast<uint16_t>(value);
  } else {
    for (unsigned n = 0; n < bytes; ++n, value = static_cast<T>(value >> 8U)) {
      static_cast<uint8_t*>(to)[place_of_byte(n, bytes)] = static_cast<uint8_t>(value);
    }
  }
}

// The value of an entry with flag D lies in the lowest bytes of its word.
void* place_of(CO_OBJ& obj, unsigned storage) {
  const size_t above = wire::host_is_little_endian || storage >= sizeof obj.Data ? 0 : sizeof obj.Data - storage;
  return CO_IS_DIRECT(obj.Key) != 0 ? reinterpret_cast<uint8_t*>(&obj.Data) + above : data_of<void>(obj);
}

uint32_t node_id_of(const CO_OBJ& obj, const CO_NODE& node) { return CO_IS_NODEID(obj.Key) != 0 ? node.NodeId : 0U; }

constexpr uint64_t modulo(uint64_t value, unsigned bytes) { return value & (UINT64_MAX >> (64U - 8U * bytes)); }

// The value modulo its width, with its sign in the bits of the variable above.
constexpr uint64_t extend(uint64_t value, const Format& format) {
  const uint64_t sign = format.is_signed ? uint64_t{1} << (8U * format.bytes - 1U) : 0;
  return modulo((modulo(value, format.bytes) ^ sign) - sign, format.storage);
}

// Gives the variable its new value, and tells of a change where somebody watches it (flag A). All of the word of an
// entry takes the value.
template <class T>
inline CO_ERR keep(CO_OBJ& obj, CO_NODE& node, T value, unsigned storage) {
  void* const place = place_of(obj, storage);
  if (place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!port::is_writable(node, place, storage)) {
    return CO_ERR_OBJ_ACC;
  }
  const bool is_watched = CO_IS_ASYNC(obj.Key) != 0;
  if (is_watched && load<T>(place, storage) == value) {
    return CO_ERR_NONE;
  }
  if (CO_IS_DIRECT(obj.Key) != 0) {
    obj.Data = static_cast<uintptr_t>(value);
  } else {
    store<T>(place, value, storage);
  }
  if (is_watched) {
    event::change_object(node, obj);
  }
  return CO_ERR_NONE;
}

// A number of 1, 2 or 4 bytes in a variable as wide as it is. The node-ID is added to what is shown.
inline CO_ERR read_word(CO_OBJ& obj, const CO_NODE& node, void* buffer, unsigned bytes) {
  const void* const place = place_of(obj, bytes);
  if (place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  store(buffer, load<uint32_t>(place, bytes) + node_id_of(obj, node), bytes);
  return CO_ERR_NONE;
}

inline CO_ERR write_word(CO_OBJ& obj, CO_NODE& node, const void* buffer, unsigned bytes) {
  const uint32_t value = load<uint32_t>(buffer, bytes) - node_id_of(obj, node);
  return keep<uint32_t>(obj, node, value & (UINT32_MAX >> (32U - 8U * bytes)), bytes);
}

template <uint8_t bytes>
struct Word {
  static constexpr rules::Rule rule = rules::integer(bytes);

  static uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return place_of(*obj, bytes) == nullptr ? 0 : bytes; }
  static CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return size == bytes ? read_word(*obj, *node, buffer, size) : CO_ERR_BAD_ARG;
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return size == bytes ? write_word(*obj, *node, buffer, size) : CO_ERR_BAD_ARG;
  }
  static constexpr CO_OBJ_TYPE table = {size, dict::checked_by<rule>, read, write, nullptr};
};

// All others.
inline CO_ERR read_wide(CO_OBJ& obj, const CO_NODE& node, void* buffer, const Format& format) {
  const void* const place = place_of(obj, format.storage);
  if (place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  store(buffer, load<uint64_t>(place, format.storage) + node_id_of(obj, node), format.bytes);
  return CO_ERR_NONE;
}

inline CO_ERR write_wide(CO_OBJ& obj, CO_NODE& node, const void* buffer, const Format& format) {
  const uint64_t value = load<uint64_t>(buffer, format.bytes) - node_id_of(obj, node);
  return keep<uint64_t>(obj, node, extend(value, format), format.storage);
}

template <uint8_t bytes, uint8_t storage, bool is_signed = false>
struct Wide {
  static constexpr Format format = {bytes, storage, is_signed};
  static constexpr rules::Rule rule = rules::integer(storage);

  static uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return place_of(*obj, storage) == nullptr ? 0 : bytes; }
  static CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return size == bytes ? read_wide(*obj, *node, buffer, format) : CO_ERR_BAD_ARG;
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return size == bytes ? write_wide(*obj, *node, buffer, format) : CO_ERR_BAD_ARG;
  }
  static constexpr CO_OBJ_TYPE table = {size, dict::checked_by<rule>, read, write, nullptr};
};

using Byte = Word<1>;
using Real32 = Word<4>;
using Real64 = Wide<8, 8>;

CO_ERR write_boolean(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (size == 1 && *static_cast<const uint8_t*>(buffer) > 1) {
    return CO_ERR_OBJ_RANGE;
  }
  return Byte::write(obj, node, buffer, size);
}

}  // namespace

uint16_t get_u16(const void* from) { return static_cast<uint16_t>(load<uint32_t>(from, sizeof(uint16_t))); }
uint32_t get_u32(const void* from) { return load<uint32_t>(from, sizeof(uint32_t)); }
void put_u32(void* to, uint32_t value) { store(to, value, sizeof value); }

}  // namespace co::integer

using namespace co;
using namespace co::integer;

extern "C" {

const CO_OBJ_TYPE COTInt8 = Byte::table;
const CO_OBJ_TYPE COTInt16 = Word<2>::table;
const CO_OBJ_TYPE COTInt32 = Word<4>::table;
const CO_OBJ_TYPE COTInt64 = Wide<8, 8>::table;
const CO_OBJ_TYPE COTUnsigned24 = Wide<3, 4>::table;
const CO_OBJ_TYPE COTUnsigned40 = Wide<5, 8>::table;
const CO_OBJ_TYPE COTUnsigned48 = Wide<6, 8>::table;
const CO_OBJ_TYPE COTUnsigned56 = Wide<7, 8>::table;
const CO_OBJ_TYPE COTSigned24 = Wide<3, 4, true>::table;
const CO_OBJ_TYPE COTSigned40 = Wide<5, 8, true>::table;
const CO_OBJ_TYPE COTSigned48 = Wide<6, 8, true>::table;
const CO_OBJ_TYPE COTSigned56 = Wide<7, 8, true>::table;
// Flag N means nothing for these, and is refused.
const CO_OBJ_TYPE COTReal32 = {Real32::size, dict::checked_by<rules::variable>, Real32::read, Real32::write, nullptr};
const CO_OBJ_TYPE COTReal64 = {Real64::size, dict::checked_by<rules::variable>, Real64::read, Real64::write, nullptr};
const CO_OBJ_TYPE COTBoolean = {Byte::size, dict::checked_by<rules::boolean>, Byte::read, write_boolean, nullptr};

}  // extern "C"
