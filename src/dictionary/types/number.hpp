// SPDX-License-Identifier: Apache-2.0
// Access to the variables of numbers of every width.
#pragma once

#include "base/events.hpp"
#include "co_core.h"
#include "co_number.h"
#include "dictionary/obj.hpp"
#include "hal/port.hpp"
#include "wire/bytes.hpp"

namespace co::integer {

// T as a type whose lvalues may alias variables of any type.
template <class T>
struct Aliasing {
  typedef T type __attribute__((may_alias));
};

// Returns whether a number of this many bytes can be accessed as one T, which requires alignment.
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

// Returns the offset of byte n, counted from the lowest, in a number in the byte order of the CPU.
constexpr unsigned offset_of_byte(unsigned n, unsigned bytes) {
  return wire::host_is_little_endian ? n : bytes - 1 - n;
}

// Reads a number, at any alignment: in one access where its alignment allows it, so that an interrupt sees the old or
// the new value. Numbers of 64 bits are so only on CPUs with accesses of 64 bits.
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
    value = static_cast<T>(value << 8U) | static_cast<const uint8_t*>(from)[offset_of_byte(n - 1, bytes)];
  }
  return value;
}

// Writes a number like load() reads it.
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
      static_cast<uint8_t*>(to)[offset_of_byte(n, bytes)] = static_cast<uint8_t>(value);
    }
  }
}

// Read and write a number of 1, 2 or 4 bytes in a variable that is aligned, in one access.
inline uint32_t load_aligned(const void* from, unsigned bytes) {
  return bytes == 4 ? as<uint32_t>(from) : bytes == 2 ? as<uint16_t>(from) : as<uint8_t>(from);
}
inline void store_aligned(void* to, uint32_t value, unsigned bytes) {
  if (bytes == 4) {
    as<uint32_t>(to) = value;
  } else if (bytes == 2) {
    as<uint16_t>(to) = static_cast<uint16_t>(value);
  } else {
    as<uint8_t>(to) = static_cast<uint8_t>(value);
  }
}

// Returns the address of an entry's value of storage bytes; with flag D the value is in the least significant bytes of
// Data.
inline void* address_of_value(CO_OBJ& obj, unsigned storage) {
  const size_t above = wire::host_is_little_endian || storage >= sizeof obj.Data ? 0 : sizeof obj.Data - storage;
  return CO_IS_DIRECT(obj.Key) != 0 ? reinterpret_cast<uint8_t*>(&obj.Data) + above : data_of<void>(obj);
}

// Returns the bytes of a number (1, 2 or 4) that load_aligned() reads as its type does; 0 for any other object. Its
// type also writes as store_aligned() does, unless the object has flag A or CO_NODE_EXT.Writable refuses.
inline unsigned plain_bytes(const CO_OBJ& obj) {
  constexpr uint32_t only_by_type = CO_OBJ_D_____ | CO_OBJ__N____;  // flags with which only the type can read the value
  const CO_OBJ_TYPE* const type = obj.Type;
  const unsigned bytes = type == &COTInt32 ? 4U : type == &COTInt16 ? 2U : type == &COTInt8 ? 1U : 0U;
  const uintptr_t address = obj.Data;
  return (obj.Key & only_by_type) == 0 && address != 0 && (address & (bytes - 1U)) == 0 ? bytes : 0;
}

// Returns the node-ID if the value is relative to it (flag N), else 0.
inline uint32_t node_id_of(const CO_OBJ& obj, const CO_NODE& node) {
  return CO_IS_NODEID(obj.Key) != 0 ? node.NodeId : 0U;
}

// Stores a value in the variable of an entry, at an address that address_of_value() has returned. With flag A
// (event-driven TPDOs) a value that is stored already is not written, and any other is reported as a change. With flag
// D all bytes of Data are written. storage: bytes of the variable, which may be more than those of the number.
template <class T>
inline CO_ERR set_value(CO_OBJ& obj, CO_NODE& node, void* address, T value, unsigned storage) {
  if (address == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!port::is_writable(node, address, storage)) {
    return CO_ERR_OBJ_ACC;
  }
  if (CO_IS_ASYNC(obj.Key) != 0 && load<T>(address, storage) == value) {
    return CO_ERR_NONE;
  }
  if (CO_IS_DIRECT(obj.Key) != 0) {
    obj.Data = static_cast<uintptr_t>(value);
  } else {
    store<T>(address, value, storage);
  }
  if (CO_IS_ASYNC(obj.Key) != 0) {
    event::change_object(node, obj);
  }
  return CO_ERR_NONE;
}

}  // namespace co::integer
