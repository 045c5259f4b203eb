// SPDX-License-Identifier: Apache-2.0
// INTEGERn, UNSIGNEDn, REALn and BOOLEAN: values in a variable of 1, 2, 4 or 8 bytes, or in the entry. Two compiled
// bodies, for variables of up to 32 bits and of 64 bits; the types are thin edges over them.
#include <type_traits>

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

template <class T>
T load_variable(const void* from, [[maybe_unused]] uint8_t storage) {
  if constexpr (sizeof(T) == 8) {
    return load<uint64_t>(from);
  } else if (storage == 1) {
    return load<uint8_t>(from);
  } else if (storage == 2) {
    return load<uint16_t>(from);
  } else {
    return load<uint32_t>(from);
  }
}

template <class T>
void store_variable(void* to, T value, [[maybe_unused]] uint8_t storage) {
  if constexpr (sizeof(T) == 8) {
    store<uint64_t>(to, value);
  } else if (storage == 1) {
    store<uint8_t>(to, static_cast<uint8_t>(value));
  } else if (storage == 2) {
    store<uint16_t>(to, static_cast<uint16_t>(value));
  } else {
    store<uint32_t>(to, value);
  }
}

template <class T>
T load_place(const CO_OBJ& obj, const void* place, uint8_t storage) {
  return CO_IS_DIRECT(obj.Key) != 0 ? static_cast<T>(uintptr_t{obj.Data}) : load_variable<T>(place, storage);
}

// The significant bytes of a number in the byte order of the CPU.
template <class T>
uint8_t* significant(T& number, uint8_t bytes) {
  return reinterpret_cast<uint8_t*>(&number) + (wire::host_is_little_endian ? 0U : sizeof(T) - bytes);
}

void copy_bytes(uint8_t* to, const uint8_t* from, uint8_t n) {
  for (; n != 0; --n) {
    *to++ = *from++;
  }
}

// The value modulo its width, with its sign in the bits above.
template <class T>
T extend(T value, const Format& format) {
  const T sign = static_cast<T>(T{1} << (8U * format.bytes - 1U));
  value &= static_cast<T>(sign | (sign - 1U));
  return format.is_signed ? static_cast<T>((value ^ sign) - sign) : value;
}

template <class T>
T node_id_of(const CO_OBJ& obj, const CO_NODE& node, const Format& format) {
  return format.may_follow_node_id && CO_IS_NODEID(obj.Key) != 0 ? node.NodeId : T{0};
}

template <class T>
CO_ERR read(CO_OBJ& obj, const CO_NODE& node, void* buffer, uint32_t size, const Format& format) {
  const void* const place = place_of(obj);
  if (size != format.bytes || place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  T value = load_place<T>(obj, place, format.storage);
  value = static_cast<T>(value + node_id_of<T>(obj, node, format));
  copy_bytes(static_cast<uint8_t*>(buffer), significant(value, format.bytes), format.bytes);
  return CO_ERR_NONE;
}

template <class T>
CO_ERR write(CO_OBJ& obj, CO_NODE& node, const void* buffer, uint32_t size, const Format& format) {
  void* const place = place_of(obj);
  if (size != format.bytes || place == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!port::is_writable(node, place, format.storage)) {
    return CO_ERR_OBJ_ACC;
  }
  T value = 0;
  copy_bytes(significant(value, format.bytes), static_cast<const uint8_t*>(buffer), format.bytes);
  value = extend(static_cast<T>(value - node_id_of<T>(obj, node, format)), format);
  const T before = load_place<T>(obj, place, format.storage);
  if (CO_IS_DIRECT(obj.Key) != 0) {
    obj.Data = static_cast<uintptr_t>(value);
  } else {
    store_variable<T>(place, value, format.storage);
  }
  if (CO_IS_ASYNC(obj.Key) != 0 && load_place<T>(obj, place, format.storage) != before) {
    event::change_object(node, obj);
  }
  return CO_ERR_NONE;
}

template <uint8_t bytes, uint8_t storage, bool is_signed = false, bool may_follow_node_id = true>
struct Type {
  using Body = std::conditional_t<storage == 8, uint64_t, uint32_t>;
  static constexpr Format format = {bytes, storage, is_signed, may_follow_node_id};
  static constexpr rules::Rule rule = may_follow_node_id ? rules::integer(storage) : rules::variable;

  static uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return place_of(*obj) == nullptr ? 0 : bytes; }
  static CO_ERR init(CO_OBJ* obj, CO_NODE* node) { return dict::check_type(*obj, *node, rule); }
  static CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return integer::read<Body>(*obj, *node, buffer, size, format);
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return integer::write<Body>(*obj, *node, buffer, size, format);
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
