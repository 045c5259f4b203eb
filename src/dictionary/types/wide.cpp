// SPDX-License-Identifier: Apache-2.0
// Numbers of 24, 40, 48, 56 and 64 bits, and REAL64: values in a variable of 4 or 8 bytes, or in the entry.
#include "co_number.h"
#include "co_time_of_day.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/number.hpp"
#include "hal/port.hpp"
#include "wire/time.hpp"

namespace co::integer {
namespace {

// Format of a number whose variable is wider than the number, or wider than 32 bits.
struct Format {
  uint8_t bytes;    // on the bus
  uint8_t storage;  // bytes of the variable
  bool is_signed;   // sign bit is extended to the variable
};

constexpr uint64_t modulo(uint64_t value, unsigned bytes) { return value & (UINT64_MAX >> (64U - 8U * bytes)); }

// Returns the value modulo its width, with its sign extended to the width of the variable.
constexpr uint64_t extend(uint64_t value, const Format& format) {
  const uint64_t sign = format.is_signed ? uint64_t{1} << (8U * format.bytes - 1U) : 0;
  return modulo((modulo(value, format.bytes) ^ sign) - sign, format.storage);
}

inline CO_ERR read_wide(CO_OBJ& obj, const CO_NODE& node, void* buffer, const Format& format) {
  const void* const address = address_of_value(obj, format.storage);
  if (address == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  store(buffer, load<uint64_t>(address, format.storage) + node_id_of(obj, node), format.bytes);
  return CO_ERR_NONE;
}

inline CO_ERR write_wide(CO_OBJ& obj, CO_NODE& node, const void* buffer, const Format& format) {
  const uint64_t value = load<uint64_t>(buffer, format.bytes) - node_id_of(obj, node);
  return set_value<uint64_t>(obj, node, address_of_value(obj, format.storage), extend(value, format), format.storage);
}

template <uint8_t bytes, uint8_t storage, bool is_signed = false>
struct Wide {
  static constexpr Format format = {bytes, storage, is_signed};
  static constexpr rules::Rule rule = rules::integer(storage);

  static uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) {
    return address_of_value(*obj, storage) == nullptr ? 0 : bytes;
  }
  static CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return size == bytes ? read_wide(*obj, *node, buffer, format) : CO_ERR_BAD_ARG;
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
    return size == bytes ? write_wide(*obj, *node, buffer, format) : CO_ERR_BAD_ARG;
  }
  static constexpr CO_OBJ_TYPE table = {size, dict::checked_by<rule>, read, write, nullptr};
};

using Real64 = Wide<8, 8>;

}  // namespace
}  // namespace co::integer

extern "C" {

const CO_OBJ_TYPE COTInt64 = co::integer::Wide<8, 8>::table;
const CO_OBJ_TYPE COTUnsigned24 = co::integer::Wide<3, 4>::table;
const CO_OBJ_TYPE COTUnsigned40 = co::integer::Wide<5, 8>::table;
const CO_OBJ_TYPE COTUnsigned48 = co::integer::Wide<6, 8>::table;
const CO_OBJ_TYPE COTUnsigned56 = co::integer::Wide<7, 8>::table;
const CO_OBJ_TYPE COTSigned24 = co::integer::Wide<3, 4, true>::table;
const CO_OBJ_TYPE COTSigned40 = co::integer::Wide<5, 8, true>::table;
const CO_OBJ_TYPE COTSigned48 = co::integer::Wide<6, 8, true>::table;
const CO_OBJ_TYPE COTSigned56 = co::integer::Wide<7, 8, true>::table;
// The rule of this type refuses flag N, which has no meaning for it.
const CO_OBJ_TYPE COTReal64 = {co::integer::Real64::size, co::dict::checked_by<co::rules::variable>,
                               co::integer::Real64::read, co::integer::Real64::write, nullptr};

}  // extern "C"

namespace co::time_of_day {
namespace {

constexpr uint32_t bytes = wire::time_bytes;

uint32_t size(CO_OBJ* obj, CO_NODE*, uint32_t) { return data_of<CO_TIME_OF_DAY>(*obj) == nullptr ? 0 : bytes; }

CO_ERR read(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t size) {
  const auto* const time = data_of<const CO_TIME_OF_DAY>(*obj);
  if (size != bytes || time == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  auto* const to = static_cast<uint8_t*>(buffer);
  wire::put_time(to, *time);
  wire::swap_host(to, bytes);
  return CO_ERR_NONE;
}

CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  auto* const time = data_of<CO_TIME_OF_DAY>(*obj);
  if (size != bytes || time == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!port::is_writable(*node, time, sizeof *time)) {
    return CO_ERR_OBJ_ACC;
  }
  uint8_t from[bytes];
  __builtin_memcpy(from, buffer, bytes);
  wire::swap_host(from, bytes);
  *time = wire::get_time(from);
  return CO_ERR_NONE;
}

}  // namespace
}  // namespace co::time_of_day

extern "C" const CO_OBJ_TYPE COTTimeOfDay = {co::time_of_day::size, co::dict::checked_by<co::rules::variable>,
                                             co::time_of_day::read, co::time_of_day::write, nullptr};
