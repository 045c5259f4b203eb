// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/rules.hpp
/// The rules for a dictionary, used by the compiler and by the node. [CiA 301, 7.4]
///
/// - check_entry() needs the table only. Called by CO_OD_CHECK() and CODictInit(). The latter does not check the
///   data of static data types; check_type() does.
/// - check_type() needs the rule of the entry's type. CO_OD_CHECK() finds the rule by the address of the type object,
///   which only the compiler may do: at run time, a list of all types would link all of them into a firmware that uses
///   three. At run time a type that is restricted to certain indices checks its rule in its Init function.
/// - Checks of values against addresses, of writable data in read-only memory, of mandatory objects, lengths and
///   mappings are done by CO_OD_CHECK() only (lexican/dictionary.hpp).
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#include <cstddef>
#include <cstdint>

#include "co_cfg.h"
#include "co_dict.h"
#include "lexican/detail/objects.h"

/// Rules for the entries of a dictionary. Not for applications: CO_OD_CHECK() and CODictInit() apply them.
namespace co::rules {

/// Returns the index in the key of an entry.
constexpr std::uint16_t index_of(std::uint32_t key) { return static_cast<std::uint16_t>(key >> 16); }
/// Returns the sub-index in the key of an entry.
constexpr std::uint8_t sub_of(std::uint32_t key) { return static_cast<std::uint8_t>((key >> 8) & 0xFFu); }

/// Returns whether all \a flags are set in the key.
constexpr bool has(std::uint32_t key, std::uint32_t flags) { return (key & flags) == flags; }

/// Returns whether the key is a static data type, 0001h…001Fh. They are mapped to skip bytes of a PDO and have no data.
/// [CiA 301, 7.4.1]
constexpr bool is_static_type(std::uint32_t key) { return index_of(key) >= 0x0001 && index_of(key) <= 0x001F; }

/// Index range of a parameter object that exists once for each instance of a service.
struct Instances {
  std::uint16_t first;       ///< first index
  std::uint16_t last;        ///< last index
  std::uint8_t last_sub;     ///< sub-indices above belong to the application and are not checked
  std::uint16_t configured;  ///< instances that co_cfg.h provides; the objects of others are refused
};

/// Services with several instances.
inline constexpr Instances instances[] = {
    {0x1200, 0x127F, 3, CO_SSDO_N},                      // SDO servers [CiA 301, 7.5.2.33]
    {0x1280, 0x12FF, 3, USE_CSDO != 0 ? CO_CSDO_N : 0},  // SDO clients [CiA 301, 7.5.2.34]
    {0x1301, 0x1340, 6, CO_SRDO_N},                      // SRDOs [EN 50325-5]
    {0x1381, 0x13C0, 16, CO_SRDO_N},                     // their mapping [EN 50325-5]
    {0x1400, 0x15FF, 6, CO_RPDO_N},                      // RPDOs [CiA 301, 7.5.2.35]
    {0x1600, 0x17FF, 64, CO_RPDO_N},                     // their mapping [CiA 301, 7.5.2.36]
    {0x1800, 0x19FF, 6, CO_TPDO_N},                      // TPDOs [CiA 301, 7.5.2.37]
    {0x1A00, 0x1BFF, 64, CO_TPDO_N},                     // their mapping [CiA 301, 7.5.2.38]
};

/// Returns false for a key beyond the configured last sub-index of an array (1016h, 1028h, 13FFh).
constexpr bool is_in_array(std::uint32_t key) {
  constexpr struct {
    std::uint16_t index;
    std::uint8_t last_sub;
  } arrays[] = {{0x1016, CO_HBCONS_N}, {0x1028, CO_EMCY_CONS_N}, {0x13FF, CO_SRDO_N}};
  for (const auto& array : arrays) {
    if (index_of(key) == array.index && sub_of(key) > array.last_sub) {
      return false;
    }
  }
  return true;
}

/// Returns false for an object of a service instance, or an element of an array, that co_cfg.h does not provide.
constexpr bool is_configured(std::uint32_t key) {
  const std::uint16_t index = index_of(key);
  for (const Instances& service : instances) {
    if (index >= service.first && index <= service.last && sub_of(key) <= service.last_sub) {
      return index - service.first < service.configured;
    }
  }
  return is_in_array(key);
}

/// Checks the rules that apply to entries of every type. \a previous: key of the previous entry, 0 for the first.
/// \retval CO_DICT_OK              no fault
/// \retval CO_DICT_RESERVED_INDEX  index 0000h, or a static data type with data
/// \retval CO_DICT_NOT_ASCENDING   the index and sub-index are not above those of \a previous
/// \retval CO_DICT_NO_TYPE         Type is null
/// \retval CO_DICT_NOT_CONFIGURED  co_cfg.h does not provide the service instance or the element of the array
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

/// Requirements of a type on its entries. Costs 10 bytes of flash if it is used at run time.
struct Rule {
  std::uint16_t first_index;  ///< lowest allowed index
  std::uint16_t last_index;   ///< highest allowed index
  std::uint8_t first_sub;     ///< lowest allowed sub-index
  std::uint8_t last_sub;      ///< highest allowed sub-index
  std::uint8_t direct_width;  ///< bytes of a value in Data; 0: flag D is not allowed
  bool node_id_relative;      ///< flag N is allowed
  bool of_pdo;                ///< the indices are those of RPDOs; those of TPDOs, 400h higher, are allowed, too
};

/// Returns the rule of a type that is allowed at every index. \a direct_width and \a node_id_relative: see Rule.
constexpr Rule anywhere(std::uint8_t direct_width, bool node_id_relative) {
  return {0x0001, 0xFFFF, 0x00, 0xFF, direct_width, node_id_relative, false};
}

/// Returns the rule of an integer type. \a width: bytes of the variable, not of the value on the bus (UNSIGNED24 is
/// stored in four).
constexpr Rule integer(std::uint8_t width) { return anywhere(width, true); }

/// BOOLEAN
inline constexpr Rule boolean = anywhere(1, false);
/// Reals, times of day, strings and domains
inline constexpr Rule variable = anywhere(0, false);

/// Returns whether the flags of a row of CO_OBJECTS() contain a letter.
constexpr bool has_letter(const char* flags, char letter) {
  while (*flags != 0 && *flags != letter) {
    ++flags;
  }
  return *flags != 0;
}

/// \cond internal
#define CO_OBJECT_RULE(rule, type, functions, first, last, first_sub, last_sub, bytes, flags, ...) \
  inline constexpr Rule rule{first,                                                                \
                             last,                                                                 \
                             first_sub,                                                            \
                             last_sub,                                                             \
                             (bytes) * (has_letter(#flags, 'D') ? 1 : 0),                          \
                             has_letter(#flags, 'N'),                                              \
                             has_letter(#flags, 'T')};
CO_OBJECTS(CO_OBJECT_RULE)
#undef CO_OBJECT_RULE
/// \endcond

/// Returns the rule that allows all entries of two rules, for types with several rows: the node checks them together.
constexpr Rule joined(Rule first, const Rule& last) {
  first.last_index = last.last_index;
  first.last_sub = last.last_sub;
  return first;
}

/// 1006h and 1007h
inline constexpr Rule sync_cycle = joined(sync_period, sync_window);
/// 1010h and 1011h, sub 0
inline constexpr Rule parameter_group_number = joined(store_number, restore_number);
/// 1010h and 1011h, other sub-indices
inline constexpr Rule parameter_group = joined(store, restore);
/// Sub 1 and 2 of the configuration of a recorder
inline constexpr Rule recorder_first = joined(recorder_size, recorder_axis);
/// Sub 4 to 10
inline constexpr Rule recorder_config = joined(recorder_colours, recorder_period);

/// Returns whether an index is in the range of a rule; the indices of TPDOs are not considered.
constexpr bool is_index(const Rule& rule, std::uint16_t index) {
  return index >= rule.first_index && index <= rule.last_index;
}

/// Returns whether a rule allows the index and the sub-index of a key.
constexpr bool allows(const Rule& rule, std::uint32_t key) {
  constexpr std::uint16_t from_rpdo_to_tpdo = 0x0400;
  const bool of_tpdo = rule.of_pdo && is_index(rule, static_cast<std::uint16_t>(index_of(key) - from_rpdo_to_tpdo));
  return (is_index(rule, index_of(key)) || of_tpdo) && sub_of(key) >= rule.first_sub && sub_of(key) <= rule.last_sub;
}

/// Returns whether a rule allows flag D on this CPU: the value has to fit into a pointer.
constexpr bool may_be_direct(const Rule& rule) {
  return rule.direct_width != 0 && rule.direct_width <= sizeof(std::uintptr_t);
}

/// Checks the rules of a type, for an entry that has passed check_entry().
/// \retval CO_DICT_OK              no fault
/// \retval CO_DICT_RESERVED_INDEX  a static data type with data
/// \retval CO_DICT_WRONG_PLACE     the type is not allowed at this index and sub-index
/// \retval CO_DICT_DIRECT_TYPE     flag D is not allowed
/// \retval CO_DICT_NODEID_TYPE     flag N is not allowed
/// \retval CO_DICT_NO_DATA         Data is null, without flag D
constexpr CO_DICT_FAULT check_type(const Rule& rule, std::uint32_t key, bool has_data) {
  if (is_static_type(key)) {
    return has_data ? CO_DICT_RESERVED_INDEX : CO_DICT_OK;
  }
  if (!allows(rule, key)) {
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

/// Returns whether the key ends the table: CO_OBJ_DICT_ENDMARK, or CO_DEFAULTS_KEY of CO_OBJ_DICT_DEFAULTS().
constexpr bool is_end(std::uint32_t key) { return key == 0 || key == 0xFF; }

/// Returns whether a fault that check_type() has found stops the node. Only faults that break memory safety do: types
/// compute the number of a service from the index of their entry, and use Data as an address. Other faults affect one
/// entry.
constexpr bool stops_node(CO_DICT_FAULT fault) {
  return fault != CO_DICT_OK && fault != CO_DICT_NO_DATA && fault != CO_DICT_NODEID_TYPE &&
         fault != CO_DICT_RESERVED_INDEX && fault != CO_DICT_PARA_OVERLAP;
}

}  // namespace co::rules

}  // extern "C++"
