// SPDX-License-Identifier: Apache-2.0
// INTEGERn, UNSIGNEDn, REALn and BOOLEAN: values in a variable of 1, 2, 4 or 8 bytes, or in the entry. One text, which
// is compiled for each type with a variable of up to 4 bytes, and once for all others.
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

struct Format {
  uint8_t bytes;            // on the bus
  uint8_t storage;          // bytes of the variable
  bool is_signed;           // the variable is wider than the value and takes its sign
  bool may_follow_node_id;  // flag N is honoured
};

template <class T>
struct Aliasing {
  typedef T type __attribute__((may_alias));
};

bool is_aligned(const void* address, uintptr_t to) { return (reinterpret_cast<uintptr_t>(address) & (to - 1)) == 0; }

// One access where alignment allows it, so that an interrupt sees the old or the new value.
template <class T>
T load(const void* from) {
  if (is_aligned(from, sizeof(T))) {
    return *static_cast<const volatile typename Aliasing<T>::type*>(from);
  }
  T value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}

template <class T>
void store(void* to, T value) {
  if (is_aligned(to, sizeof(T))) {
    *static_cast<volatile typename Aliasing<T>::type*>(to) = value;
  } else {
    __builtin_memcpy(to, &value, sizeof value);
  }
}

// The value of an entry with flag D lies in the lowest bytes of its word.
[[gnu::always_inline]] inline void* place_of(CO_OBJ& obj, uint8_t storage) {
  const size_t above = wire::host_is_little_endian || storage >= sizeof obj.Data ? 0 : sizeof obj.Data - storage;
  return CO_IS_DIRECT(obj.Key) != 0 ? reinterpret_cast<uint8_t*>(&obj.Data) + above : data_of<void>(obj);
}

template <class T>
[[gnu::always_inline]] inline T load_from(const void* place, [[maybe_unused]] uint8_t storage) {
  if constexpr (sizeof(T) == 8) {
    return load<uint64_t>(place);
  } else if (storage == 1) {
    return load<uint8_t>(place);
  } else if (storage == 2) {
    return load<uint16_t>(place);
  } else {
    return load<uint32_t>(place);
  }
}

// All of the word of an entry takes the value.
template <class T>
[[gnu::noinline]] void store_place(CO_OBJ& obj, void* place, T value, [[maybe_unused]] uint8_t storage) {
  if (CO_IS_DIRECT(obj.Key) != 0) {
    obj.Data = static_cast<uintptr_t>(value);
  } else if constexpr (sizeof(T) == 8) {
    store<uint64_t>(place, value);
  } else if (storage == 1) {
    store<uint8_t>(place, static_cast<uint8_t>(value));
  } else if (storage == 2) {
    store<uint16_t>(place, static_cast<uint16_t>(value));
  } else {
    store<uint32_t>(place, value);
  }
}

// The significant bytes of a number, in the byte order of the CPU and of any alignment: byte n from the lowest.
template <class Byte>
Byte& byte_of(Byte* number, unsigned n, unsigned bytes) {
  return number[wire::host_is_little_endian ? n : bytes - 1 - n];
}

template <class T>
[[gnu::always_inline]] inline void put_number(uint8_t* to, T value, uint8_t bytes) {
  if constexpr (sizeof(T) == 8) {
    for (unsigned n = 0; n < bytes; ++n, value >>= 8U) {
      byte_of(to, n, bytes) = static_cast<uint8_t>(value);
    }
  } else {
    byte_of(to, 0, bytes) = static_cast<uint8_t>(value);
    if (bytes > 1) {
      byte_of(to, 1, bytes) = static_cast<uint8_t>(value >> 8);
    }
    if (bytes > 2) {
      byte_of(to, 2, bytes) = static_cast<uint8_t>(value >> 16);
    }
    if (bytes > 3) {
      byte_of(to, 3, bytes) = static_cast<uint8_t>(value >> 24);
    }
  }
}

template <class T>
[[gnu::always_inline]] inline T get_number(const uint8_t* from, uint8_t bytes) {
  T value = 0;
  if constexpr (sizeof(T) == 8) {
    for (unsigned n = bytes; n != 0; --n) {
      value = (value << 8U) | byte_of(from, n - 1, bytes);
    }
  } else {
    value = byte_of(from, 0, bytes);
    value |= bytes > 1 ? static_cast<T>(byte_of(from, 1, bytes)) << 8 : 0U;
    value |= bytes > 2 ? static_cast<T>(byte_of(from, 2, bytes)) << 16 : 0U;
    value |= bytes > 3 ? static_cast<T>(byte_of(from, 3, bytes)) << 24 : 0U;
  }
  return value;
}

// The value modulo its width, with its sign in the bits above.
template <class T>
[[gnu::always_inline]] inline T extend(T value, const Format& format) {
  const T sign = static_cast<T>(T{1} << (8U * format.bytes - 1U));
  value &= static_cast<T>(sign | (sign - 1U));
  return format.is_signed ? static_cast<T>((value ^ sign) - sign) : value;
}

[[gnu::always_inline]] inline bool follows_node_id(const CO_OBJ& obj, const Format& format) {
  return format.may_follow_node_id && CO_IS_NODEID(obj.Key) != 0;
}

template <class T>
[[gnu::always_inline]] inline CO_ERR read(CO_OBJ& obj, const CO_NODE& node, void* buffer, uint32_t size,
                                          const Format& format) {
  const void* const place = place_of(obj, format.storage);
  if (size != format.bytes || place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  T value = load_from<T>(place, format.storage);
  if (follows_node_id(obj, format)) {
    value += node.NodeId;
  }
  put_number<T>(static_cast<uint8_t*>(buffer), value, format.bytes);
  return CO_ERR_NONE;
}

// Gives the variable its new value, and tells of a change where somebody watches it (flag A).
template <class T>
[[gnu::noinline]] CO_ERR keep(CO_OBJ& obj, CO_NODE& node, T value, uint8_t storage) {
  void* const place = place_of(obj, storage);
  if (place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!port::is_writable(node, place, storage)) {
    return CO_ERR_OBJ_ACC;
  }
  const bool is_watched = CO_IS_ASYNC(obj.Key) != 0;
  if (is_watched && load_from<T>(place, storage) == value) {
    return CO_ERR_NONE;
  }
  store_place<T>(obj, place, value, storage);
  if (is_watched) {
    event::change_object(node, obj);
  }
  return CO_ERR_NONE;
}

template <class T>
[[gnu::always_inline]] inline CO_ERR write(CO_OBJ& obj, CO_NODE& node, const void* buffer, uint32_t size,
                                           const Format& format) {
  if (size != format.bytes) {
    return CO_ERR_BAD_ARG;
  }
  T value = get_number<T>(static_cast<const uint8_t*>(buffer), format.bytes);
  if (follows_node_id(obj, format)) {
    value -= node.NodeId;
  }
  return keep<T>(obj, node, extend<T>(value, format), format.storage);
}

[[gnu::noinline]] CO_ERR read_wide(CO_OBJ& obj, const CO_NODE& node, void* buffer, uint32_t size,
                                   const Format& format) {
  return read<uint64_t>(obj, node, buffer, size, format);
}

[[gnu::noinline]] CO_ERR write_wide(CO_OBJ& obj, CO_NODE& node, const void* buffer, uint32_t size,
                                    const Format& format) {
  return write<uint64_t>(obj, node, buffer, size, format);
}

template <uint8_t bytes, uint8_t storage, bool is_signed = false, bool may_follow_node_id = true>
struct Type {
  static constexpr Format format = {bytes, storage, is_signed, may_follow_node_id};
  static constexpr rules::Rule rule = may_follow_node_id ? rules::integer(storage) : rules::variable;

  static uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return place_of(*obj, storage) == nullptr ? 0 : bytes; }
  static CO_ERR init(CO_OBJ* obj, CO_NODE* node) { return dict::check_type(*obj, *node, rule); }
  static CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return storage == 8 ? read_wide(*obj, *node, buffer, size, format)
                        : integer::read<uint32_t>(*obj, *node, buffer, size, format);
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return storage == 8 ? write_wide(*obj, *node, buffer, size, format)
                        : integer::write<uint32_t>(*obj, *node, buffer, size, format);
  }
  static constexpr CO_OBJ_TYPE table = {size, init, read, write, nullptr};
};

using Byte = Type<1, 1>;

CO_ERR init_boolean(CO_OBJ* obj, CO_NODE* node) { return dict::check_type(*obj, *node, rules::boolean); }

CO_ERR write_boolean(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  if (size == 1 && *static_cast<const uint8_t*>(buffer) > 1) {
    return CO_ERR_OBJ_RANGE;
  }
  return Byte::write(obj, node, buffer, size);
}

}  // namespace
}  // namespace co::integer

using namespace co::integer;

extern "C" {

const CO_OBJ_TYPE COTInt8 = Byte::table;
const CO_OBJ_TYPE COTInt16 = Type<2, 2>::table;
const CO_OBJ_TYPE COTInt32 = Type<4, 4>::table;
const CO_OBJ_TYPE COTInt64 = Type<8, 8>::table;
const CO_OBJ_TYPE COTUnsigned24 = Type<3, 4>::table;
const CO_OBJ_TYPE COTUnsigned40 = Type<5, 8>::table;
const CO_OBJ_TYPE COTUnsigned48 = Type<6, 8>::table;
const CO_OBJ_TYPE COTUnsigned56 = Type<7, 8>::table;
const CO_OBJ_TYPE COTSigned24 = Type<3, 4, true>::table;
const CO_OBJ_TYPE COTSigned40 = Type<5, 8, true>::table;
const CO_OBJ_TYPE COTSigned48 = Type<6, 8, true>::table;
const CO_OBJ_TYPE COTSigned56 = Type<7, 8, true>::table;
const CO_OBJ_TYPE COTReal32 = Type<4, 4, false, false>::table;
const CO_OBJ_TYPE COTReal64 = Type<8, 8, false, false>::table;
const CO_OBJ_TYPE COTBoolean = {Byte::size, init_boolean, Byte::read, write_boolean, nullptr};

}  // extern "C"
