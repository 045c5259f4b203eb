// SPDX-License-Identifier: Apache-2.0
/// \file lexican/rules.hpp
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

/// \name Rules of the types of the library
/// \{

/// BOOLEAN
inline constexpr Rule boolean = anywhere(1, false);
/// Reals, times of day, strings and domains
inline constexpr Rule variable = anywhere(0, false);
/// 1016h, sub 0: number of heartbeat consumers
inline constexpr Rule heartbeat_consumers{0x1016, 0x1016, 0, 0, 1, false, false};
/// 1016h, other sub-indices: a heartbeat consumer
inline constexpr Rule heartbeat_consumer{0x1016, 0x1016, 1, CO_HBCONS_N, 0, false, false};
/// 1017h: period of the heartbeat producer
inline constexpr Rule heartbeat_producer{0x1017, 0x1017, 0, 0, 2, false, false};
/// 1029h: error behaviour
inline constexpr Rule error_behaviour{0x1029, 0x1029, 0, 254, 1, false, false};
/// 1010h and 1011h, sub 0: number of parameter groups
inline constexpr Rule parameter_group_number{0x1010, 0x1011, 0, 0, 1, false, false};
/// 1010h and 1011h, other sub-indices: a parameter group
inline constexpr Rule parameter_group{0x1010, 0x1011, 1, 127, 0, false, false};
/// 1020h: date and time of the configuration
inline constexpr Rule verify_configuration{0x1020, 0x1020, 1, 2, 0, false, false};
/// 1F80h: NMT start-up
inline constexpr Rule nmt_startup{0x1F80, 0x1F80, 0, 0, 4, false, false};
/// 1003h, sub 0: number of errors in the history
inline constexpr Rule emcy_history_number{0x1003, 0x1003, 0, 0, 1, false, false};
/// 1003h, other sub-indices: an error
inline constexpr Rule emcy_history{0x1003, 0x1003, 1, 254, 0, false, false};
/// 1014h: COB-ID of the EMCY producer
inline constexpr Rule emcy_cob_id{0x1014, 0x1014, 0, 0, 4, true, false};
/// 1028h: COB-ID of an EMCY consumer
inline constexpr Rule emcy_consumer{0x1028, 0x1028, 1, 127, 4, false, false};
/// 1200h…12FFh, sub 1 and 2: COB-IDs of an SDO server or client
inline constexpr Rule sdo_cob_id{0x1200, 0x12FF, 1, 2, 4, true, false};
/// 1012h: COB-ID of TIME
inline constexpr Rule time_cob_id{0x1012, 0x1012, 0, 0, 4, true, false};
/// 1300h: global fail-safe command
inline constexpr Rule global_fail_safe{0x1300, 0x1300, 0, 0, 1, false, false};
/// 1301h…1340h, sub 1: direction of an SRDO
inline constexpr Rule srdo_direction{0x1301, 0x1340, 1, 1, 1, false, false};
/// 1301h…1340h, sub 2: refresh time or SCT
inline constexpr Rule srdo_cycle{0x1301, 0x1340, 2, 2, 2, false, false};
/// 1301h…1340h, sub 3 and 4: SRVT, and transmission type
inline constexpr Rule srdo_byte{0x1301, 0x1340, 3, 4, 1, false, false};
/// 1301h…1340h, sub 5 and 6: COB-IDs of an SRDO
inline constexpr Rule srdo_cob_id{0x1301, 0x1340, 5, 6, 4, false, false};
/// 1381h…13C0h, sub 0: number of mapped objects
inline constexpr Rule srdo_number{0x1381, 0x13C0, 0, 0, 1, false, false};
/// 1381h…13C0h, other sub-indices: a mapped object
inline constexpr Rule srdo_mapping{0x1381, 0x13C0, 1, 16, 4, false, false};
/// 13FEh: configuration valid, which the stack writes
inline constexpr Rule srdo_valid{0x13FE, 0x13FE, 0, 0, 1, false, false};
/// 13FFh: signature of an SRDO
inline constexpr Rule srdo_signature{0x13FF, 0x13FF, 1, 64, 2, false, false};
/// 1005h: COB-ID of SYNC
inline constexpr Rule sync_cob_id{0x1005, 0x1005, 0, 0, 4, true, false};
/// 1006h and 1007h: period of SYNC, and window of synchronous PDOs
inline constexpr Rule sync_cycle{0x1006, 0x1007, 0, 0, 4, false, false};
/// 1019h: overflow value of the SYNC counter
inline constexpr Rule sync_counter{0x1019, 0x1019, 0, 0, 1, false, false};
/// 1400h… and 1800h…, sub 1: COB-ID of a PDO
inline constexpr Rule pdo_cob_id{0x1400, 0x15FF, 1, 1, 4, true, true};
/// 1400h… and 1800h…, sub 2: transmission type
inline constexpr Rule pdo_type{0x1400, 0x15FF, 2, 2, 1, false, true};
/// 1400h… and 1800h…, sub 3: inhibit time
inline constexpr Rule pdo_inhibit{0x1400, 0x15FF, 3, 3, 2, false, true};
/// 1400h… and 1800h…, sub 5: event timer
inline constexpr Rule pdo_event{0x1400, 0x15FF, 5, 5, 2, false, true};
/// 1800h…, sub 6: SYNC start value
inline constexpr Rule pdo_start{0x1800, 0x19FF, 6, 6, 1, false, false};
/// 1600h… and 1A00h…, sub 0: number of mapped objects
inline constexpr Rule pdo_number{0x1600, 0x17FF, 0, 0, 1, false, true};
/// 1600h… and 1A00h…, other sub-indices: a mapped object
inline constexpr Rule pdo_mapping{0x1600, 0x17FF, 1, 64, 4, false, true};
/// 1FA0h…1FCFh: object scanner list
inline constexpr Rule pdo_scan{0x1FA0, 0x1FCF, 1, 254, 4, false, false};
/// 1FD0h…1FFFh: object dispatching list
inline constexpr Rule pdo_dispatch{0x1FD0, 0x1FFF, 1, 254, 8, false, false};
/// 1023h and 1025h, sub 1: command (1024h has no sub-indices)
inline constexpr Rule os_command{0x1023, 0x1025, 1, 1, 0, false, false};
/// 1023h and 1025h, sub 2: status
inline constexpr Rule os_status{0x1023, 0x1025, 2, 2, 0, false, false};
/// 1023h and 1025h, sub 3: reply
inline constexpr Rule os_reply{0x1023, 0x1025, 3, 3, 0, false, false};
/// 1024h: OS command mode
inline constexpr Rule os_mode{0x1024, 0x1024, 0, 0, 0, false, false};
/// 1026h, sub 1: StdIn
inline constexpr Rule os_input{0x1026, 0x1026, 1, 1, 0, false, false};
/// 1026h, sub 2 and 3: StdOut and StdErr
inline constexpr Rule os_output{0x1026, 0x1026, 2, 3, 0, false, false};
/// 1027h, sub 0: number of modules
inline constexpr Rule module_number{0x1027, 0x1027, 0, 0, 0, false, false};
/// 1027h, all sub-indices
inline constexpr Rule module_list{0x1027, 0x1027, 0, 254, 0, false, false};
/// 2000h…5FFFh, sub 1 and 2: points and axis of a recorder
inline constexpr Rule recorder_first{0x2000, 0x5FFF, 1, 2, 0, false, false};
/// 2000h…5FFFh, sub 4 to 10: other parameters of a recorder
inline constexpr Rule recorder_config{0x2000, 0x5FFF, 4, 10, 0, false, false};
/// 2000h…5FFFh, sub 1 to 4: points and values of a recorder
inline constexpr Rule recorder_data{0x2000, 0x5FFF, 1, 4, 0, false, false};
/// 2000h…5FFFh, sub 6: time of the trigger of a recorder
inline constexpr Rule recorder_trigger_time{0x2000, 0x5FFF, 6, 6, 0, false, false};
/// 2000h…5FFFh: plot of a recorder
inline constexpr Rule recorder_plot{0x2000, 0x5FFF, 0, 254, 0, false, false};
/// 2000h…5FFFh: enables all recorders
inline constexpr Rule recorder_enable{0x2000, 0x5FFF, 0, 254, 0, false, false};
/// \}

/// Returns whether an index is in the range of a rule; the indices of TPDOs are not considered.
constexpr bool is_index(const Rule& rule, std::uint16_t index) {
  return index >= rule.first_index && index <= rule.last_index;
}

/// Returns whether a rule allows the index and the sub-index of a key.
constexpr bool is_place(const Rule& rule, std::uint32_t key) {
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
