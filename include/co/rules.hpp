// SPDX-License-Identifier: Apache-2.0
/// \file co/rules.hpp
/// What a dictionary must look like, written once for the compiler and for the node. [301:7.4]
///
/// Who applies which rule:
/// - check_entry(): needs no more than the table. CO_OD_CHECK() and CODictInit().
/// - check_type(): needs the rule of the entry's type. CO_OD_CHECK() finds it by the address of the type object, which
///   only the compiler may do: in the running program a list of all types would link them all into a firmware that
///   uses three. There a type that belongs to one place applies its rule in its Init function.
/// - Values against addresses, and what must not lie in read-only memory: CO_OD_CHECK() only (co/dictionary.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "co_cfg.h"
#include "co_dict.h"

namespace co::rules {

constexpr std::uint16_t index_of(std::uint32_t key) { return static_cast<std::uint16_t>(key >> 16); }
constexpr std::uint8_t sub_of(std::uint32_t key) { return static_cast<std::uint8_t>((key >> 8) & 0xFFu); }

/// Are the flags all set in the key?
constexpr bool has(std::uint32_t key, std::uint32_t flags) { return (key & flags) == flags; }

/// 0001h…001Fh stand for the static data types. They are mapped to skip bytes of a PDO, and hold nothing. [301:7.4.1]
constexpr bool is_static_type(std::uint32_t key) { return index_of(key) >= 0x0001 && index_of(key) <= 0x001F; }

/// Objects that exist once for each instance of a service.
struct Instances {
  std::uint16_t first;    // index
  std::uint16_t last;     // index
  std::uint8_t last_sub;  // entries above are the application's, wherever they stand
  std::uint16_t configured;
};

inline constexpr Instances instances[] = {
    {0x1200, 0x127F, 3, CO_SSDO_N},                      // SDO servers [301:7.5.2.33]
    {0x1280, 0x12FF, 3, USE_CSDO != 0 ? CO_CSDO_N : 0},  // SDO clients [301:7.5.2.34]
};

constexpr bool is_configured(std::uint32_t key) {
  const std::uint16_t index = index_of(key);
  for (const Instances& service : instances) {
    if (index >= service.first && index <= service.last && sub_of(key) <= service.last_sub) {
      return index - service.first < service.configured;
    }
  }
  return true;
}

/// The rules that hold whatever the type is. \a previous: the key of the entry before it, 0 for the first.
constexpr CO_DICT_FAULT check_entry(std::uint32_t previous, std::uint32_t key, bool has_type, bool has_data) {
  if (index_of(key) == 0 || (is_static_type(key) && has_data)) {
    return CO_DICT_RESERVED_INDEX;
  }
  if ((key >> 8) <= (previous >> 8)) {
    return CO_DICT_NOT_ASCENDING;
  }
  if (!has_type) {
    return CO_DICT_NO_TYPE;
  }
  return is_configured(key) ? CO_DICT_OK : CO_DICT_NOT_CONFIGURED;
}

/// What a type asks of its entries. 8 bytes of flash where it is used at run time.
struct Rule {
  std::uint16_t first_index;
  std::uint16_t last_index;
  std::uint8_t first_sub;
  std::uint8_t last_sub;
  std::uint8_t direct_width;  // bytes that a value takes in Data; 0: flag D is not allowed
  bool node_id_relative;      // flag N is allowed
};

constexpr Rule anywhere(std::uint8_t direct_width, bool node_id_relative) {
  return {0x0001, 0xFFFF, 0x00, 0xFF, direct_width, node_id_relative};
}

/// \a width: bytes of the variable, not of the value on the bus (UNSIGNED24 lies in four).
constexpr Rule integer(std::uint8_t width) { return anywhere(width, true); }

inline constexpr Rule boolean = anywhere(1, false);
inline constexpr Rule variable = anywhere(0, false);  // reals, times, strings, domains
inline constexpr Rule heartbeat_producer{0x1017, 0x1017, 0, 0, 2, false};
inline constexpr Rule sdo_cob_id{0x1200, 0x12FF, 1, 2, 4, true};

constexpr bool is_place(const Rule& rule, std::uint32_t key) {
  return index_of(key) >= rule.first_index && index_of(key) <= rule.last_index && sub_of(key) >= rule.first_sub &&
         sub_of(key) <= rule.last_sub;
}

constexpr bool may_be_direct(const Rule& rule) {
  return rule.direct_width != 0 && rule.direct_width <= sizeof(std::uintptr_t);
}

/// The rules of a type, for an entry that has passed check_entry().
constexpr CO_DICT_FAULT check_type(const Rule& rule, std::uint32_t key, bool has_data) {
  if (is_static_type(key)) {
    return CO_DICT_OK;
  }
  if (!is_place(rule, key)) {
    return CO_DICT_WRONG_PLACE;
  }
  if (has(key, CO_OBJ_D_____) && !may_be_direct(rule)) {
    return CO_DICT_DIRECT_TYPE;
  }
  if (has(key, CO_OBJ__N____) && !rule.node_id_relative) {
    return CO_DICT_NODEID_TYPE;
  }
  return (has_data || has(key, CO_OBJ_D_____)) ? CO_DICT_OK : CO_DICT_NO_DATA;
}

}  // namespace co::rules
