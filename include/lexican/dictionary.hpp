// SPDX-License-Identifier: Apache-2.0
/// \file lexican/dictionary.hpp
/// Compile-time checks of a constexpr dictionary, and compile-time lookup of its entries.
///
///     constexpr CO_OBJ od[] = {
///         {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
///         {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register)},
///         {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
///         {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
///         CO_OBJ_DICT_ENDMARK};
///     CO_OD_CHECK(od);
///
/// A fault is a compile error. The message contains the CO_DICT_FAULT of co_dict.h, index and sub-index in hexadecimal
/// digits, for example:
///
///     Dictionary<CO_DICT_NOT_ASCENDING, co::Index<'1', '0', '0', '1'>, co::Sub<'0', '0'>>
///
/// This file adds no code or data to the program. It is tested with gcc 11 and 12 and with clang 14 to 19. A table of
/// more than about a thousand entries may need a higher limit of the compiler (clang: -fconstexpr-steps, gcc:
/// -fconstexpr-ops-limit).
#pragma once

extern "C++" {  // co_core.h may be included inside extern "C" { }

#ifdef CO_DATA_INTEGER
#error "lexican/dictionary.hpp: with CO_DATA_INTEGER the compiler cannot look into a dictionary"
#endif

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "co_domain.h"
#include "co_emcy.h"
#include "co_gfc.h"
#include "co_heartbeat.h"
#include "co_module_list.h"
#include "co_nmt.h"
#include "co_number.h"
#include "co_obj.h"
#include "lexican/detail/needs.h"
#include "lexican/detail/rules.hpp"
#if USE_OD
#include "co_od.h"
#endif
#include "co_os.h"
#include "co_para.h"
#include "co_pdo_types.h"
#include "co_recorder.h"
#include "co_sdo.h"
#include "co_srdo.h"
#include "co_string.h"
#include "co_sync.h"
#include "co_time.h"
#include "co_time_of_day.h"

/// Checks at compile time that \a od, a constexpr array of CO_OBJ with static storage, is a dictionary without faults.
/// For namespace and function scope. Mandatory objects must exist, frequent objects of CiA 301 and those for which the
/// library has a type must have the right length, and constant mappings of PDOs that are not switched off must name
/// objects with flag P of the same length, together at most 64 bits. Rights of mapped objects and static data types are
/// not checked. Entries with types of the application are checked only for the rules of all types. An object that
/// constant mappings of an SRDO and of an ordinary PDO contain causes a warning (-Wdeprecated-declarations, omitted if
/// this header is a system header).
#define CO_OD_CHECK(od) static_assert(::co::dictionary::is_proved<od, true>(), "see Dictionary<...> above")

/// Like CO_OD_CHECK(), for a part of a table, or one that codict has generated: mandatory objects, the lengths of
/// objects of CiA 301, and targets and lengths of mappings are not checked.
#define CO_OD_CHECK_PART(od) static_assert(::co::dictionary::is_proved<od, false>(), "see Dictionary<...> above")

namespace co {

/// An index as hexadecimal digits, for messages of the compiler: 1000h is ``Index<'1', '0', '0', '0'>``.
template <char... HexDigits>
struct Index {};

/// A sub-index as hexadecimal digits, for messages of the compiler: 0Ah is ``Sub<'0', 'A'>``.
template <char... HexDigits>
struct Sub {};

/// Compiles only for dictionaries without fault; the template arguments name the fault.
template <CO_DICT_FAULT Fault, class Index, class Sub>
struct Dictionary {
  static_assert(Fault == CO_DICT_OK,
                "Dictionary<fault, index, sub-index>: this entry is wrong; CO_DICT_FAULT in co_dict.h says why");
  static constexpr bool proved = true;  ///< used in an expression, it makes the compiler check the assertion
};

/// Compiles only for entries that exist in their dictionary; the template arguments name the entry.
template <class Index, class Sub, bool Exists>
struct Entry {
  static_assert(Exists, "Entry<index, sub-index, false>: the dictionary has no such entry");
  static constexpr bool proved = true;  ///< used in an expression, it makes the compiler check the assertion
};

/// Checks of a table by the compiler, called by CO_OD_CHECK(), entry() and object(). Not for applications.
namespace dictionary {

/// Returns the number of elements of a table, including the end mark.
template <std::size_t Length>
constexpr std::size_t length(const CO_OBJ (&)[Length]) {
  return Length;
}

/// Returns the lower four bits of a number as an upper-case hexadecimal digit.
constexpr char hex(unsigned number) { return "0123456789ABCDEF"[number & 0xFu]; }

/// The Index of a number.
template <std::uint16_t Number>
using IndexOf = Index<hex(Number >> 12), hex(Number >> 8), hex(Number >> 4), hex(Number)>;
/// The Sub of a number.
template <std::uint8_t Number>
using SubOf = Sub<hex(Number >> 4), hex(Number)>;

/// Kind of the C++ type for the values of an object type.
enum class Value : std::uint8_t {
  integer,           ///< signed or unsigned integer
  unsigned_integer,  ///< unsigned integer
  signed_integer,    ///< signed integer
  boolean,           ///< bool
  real,              ///< float or double
  bytes,             ///< string, domain, or time of day: no C++ type
  of_application     ///< defined by the application
};

/// Properties of an object type of the library.
struct Type {
  const CO_OBJ_TYPE* type;  ///< functions of the type; null: excluded by the configuration
  rules::Rule rule;         ///< indices, sub-indices and flags that the type allows
  Value value;              ///< kind of the values
  std::uint8_t width;       ///< bytes on the bus, 0: varies
};

/// \cond internal
// An element of types for a row of CO_OBJECTS(). The type is null if the configuration excludes it.
#define CO_OBJECT_TYPE(rule, type, functions, first, last, first_sub, last_sub, bytes, flags, value, use, setting) \
  {CO_IF_ZERO(setting, nullptr, &functions), rules::rule, Value::value, bytes},

// clang-format off
// X(name, rule, value, width): an element of types for COTname, and of extensible for ODTname
#define CO_PLAIN_TYPES(X) \
  X(Boolean,       boolean,           boolean,          1) \
  X(Int8,          integer(1),        integer,          1) \
  X(Int16,         integer(2),        integer,          2) \
  X(Int32,         integer(4),        integer,          4) \
  X(Int64,         integer(8),        integer,          8) \
  X(Unsigned24,    integer(4),        unsigned_integer, 3) \
  X(Unsigned40,    integer(8),        unsigned_integer, 5) \
  X(Unsigned48,    integer(8),        unsigned_integer, 6) \
  X(Unsigned56,    integer(8),        unsigned_integer, 7) \
  X(Signed24,      integer(4),        signed_integer,   3) \
  X(Signed40,      integer(8),        signed_integer,   5) \
  X(Signed48,      integer(8),        signed_integer,   6) \
  X(Signed56,      integer(8),        signed_integer,   7) \
  X(Real32,        variable,          real,             4) \
  X(Real64,        variable,          real,             8) \
  X(TimeOfDay,     variable,          bytes,            6) \
  X(String,        variable,          bytes,            0) \
  X(VisibleString, variable,          bytes,            0) \
  X(OctetString,   variable,          bytes,            0) \
  X(UnicodeString, variable,          bytes,            0) \
  X(Domain,        variable,          bytes,            0)
// clang-format on
#define CO_PLAIN_TYPE(name, rule, value, width) {&COT##name, rules::rule, Value::value, width},
#define CO_EXTENSIBLE_TYPE(name, rule, value, width) {&ODT##name.Ex.Type, &COT##name},
/// \endcond

/// Object types of the library. A type whose rules or values depend on the sub-index has several elements.
inline constexpr Type types[] = {
    CO_PLAIN_TYPES(CO_PLAIN_TYPE)  //
    {&COTDomainRo, rules::variable, Value::bytes, 0},
    CO_OBJECTS(CO_OBJECT_TYPE)
#if USE_EMCY
        {&COTEmcyBits, rules::variable, Value::bytes, 0},
#endif
};
#undef CO_OBJECT_TYPE
#undef CO_PLAIN_TYPE

/// Returns whether two addresses are known to be equal. If the compiler has to consider symbols at address 0
/// (-fno-delete-null-pointer-checks, sanitizers of gcc), it can only prove that an address is equal to itself. That is
/// sufficient: addresses that are not provably equal are different.
constexpr bool is_same(const CO_OBJ_TYPE* a, const CO_OBJ_TYPE* b) { return __builtin_constant_p(a == b) && a == b; }

#if USE_OD
/// A type of extensible entries (co_od.h), and the type whose rules it follows.
struct Extensible {
  const CO_OBJ_TYPE* type;      ///< type of extensible entries
  const CO_OBJ_TYPE* original;  ///< type of the library with the same values
};

/// All types of extensible entries.
inline constexpr Extensible extensible[] = {CO_PLAIN_TYPES(CO_EXTENSIBLE_TYPE)};
#endif
#undef CO_EXTENSIBLE_TYPE
#undef CO_PLAIN_TYPES

/// Returns the type whose rules a type follows: the original type of an extensible type; for COTParaRestore
/// COTParaStore, because the index decides; otherwise the type itself.
constexpr const CO_OBJ_TYPE* original(const CO_OBJ_TYPE* type) {
#if USE_PARA
  if (is_same(type, &COTParaRestore)) {
    return &COTParaStore;
  }
#endif
#if USE_OD
  for (const Extensible& known : extensible) {
    if (is_same(known.type, type)) {
      return known.original;
    }
  }
#endif
  return type;
}

/// Returns the properties of an entry's type. If the type has several, those whose rule allows the entry's index and
/// sub-index are returned, or the last ones if none does.
constexpr Type type_of(const CO_OBJ& entry) {
  const CO_OBJ_TYPE* const type = original(entry.Type);
  Type found{type, rules::variable, Value::of_application, 0};
  for (const Type& known : types) {
    if (!is_same(known.type, type)) {
      continue;
    }
    found = known;
    if (rules::allows(known.rule, entry.Key)) {
      break;
    }
  }
  return found;
}

/// Kind of the initialiser of Data. The compiler can distinguish the kinds only by an expression that names the table
/// itself: reading a value from the initialiser is a constant expression, reading an address as a number is not.
enum class Content : std::uint8_t {
  null,    ///< 0 or a null pointer
  value,   ///< a number other than 0
  address  ///< the address of a variable or function
};

/// Returns the kind of the initialiser of Data in the element of the table at \a position.
template <const auto& Od>
constexpr Content content(std::size_t position) {
  if (__builtin_constant_p(Od[position].Data.value())) {
    return Od[position].Data.value() == 0 ? Content::null : Content::value;
  }
  if (__builtin_constant_p(Od[position].Data.address() == nullptr)) {
    return Od[position].Data.address() == nullptr ? Content::null : Content::address;
  }
  return Content::address;
}

/// Checks the rules that need the kind of the initialiser, which is not available at run time.
constexpr CO_DICT_FAULT check_content(std::uint32_t key, Content content) {
  const bool direct = rules::has(key, CO_OBJ_D_____);
  if (content == (direct ? Content::address : Content::value)) {
    return CO_DICT_DIRECT_ADDRESS;
  }
  return direct && rules::has(key, CO_OBJ______W) ? CO_DICT_DIRECT_CONST : CO_DICT_OK;
}

/// Checks types of the application. For OD_TNUMBER and OD_TSTREAM, whose objects only an extension
/// provides, Data is a length.
constexpr CO_DICT_FAULT check_unknown([[maybe_unused]] const CO_OBJ_TYPE* type, [[maybe_unused]] Content content) {
#if USE_OD
  const bool is_number = is_same(type, OD_TNUMBER);
  if (is_number && content == Content::null) {
    return CO_DICT_NO_DATA;
  }
  if ((is_number || is_same(type, OD_TSTREAM)) && content == Content::address) {
    return CO_DICT_DIRECT_ADDRESS;
  }
#endif
  return CO_DICT_OK;
}

/// Frequent objects of CiA 301 with plain types, whose number has a certain width. [CiA 301, 7.5.2]
struct Standard {
  std::uint16_t first;     ///< first index
  std::uint16_t last;      ///< last index
  std::uint8_t first_sub;  ///< first sub-index
  std::uint8_t last_sub;   ///< last sub-index
  std::uint8_t width;      ///< bytes of the value
};

/// The frequent objects.
inline constexpr Standard standard[] = {
    {0x1000, 0x1000, 0, 0, 4}, {0x1001, 0x1001, 0, 0, 1}, {0x1002, 0x1002, 0, 0, 4}, {0x100C, 0x100C, 0, 0, 2},
    {0x100D, 0x100D, 0, 0, 1}, {0x1013, 0x1013, 0, 0, 4}, {0x1015, 0x1015, 0, 0, 2}, {0x1018, 0x1018, 0, 0, 1},
    {0x1018, 0x1018, 1, 4, 4}, {0x1200, 0x12FF, 0, 0, 1}, {0x1200, 0x12FF, 3, 3, 1}, {0x1400, 0x15FF, 0, 0, 1},
    {0x1800, 0x19FF, 0, 0, 1},
};

/// Returns whether an entry of a type of the library has the width that CiA 301 defines for its object.
constexpr bool has_standard_width(std::uint32_t key, std::uint8_t width) {
  constexpr std::uint16_t behind = 0x2000;  // the communication profile
  if (rules::index_of(key) >= behind) {
    return true;
  }
  for (const Type& known : types) {
    if (known.rule.last_index < behind && rules::allows(known.rule, key)) {
      return known.width == 0 || width == known.width;
    }
  }
  for (const Standard& object : standard) {
    if (rules::index_of(key) >= object.first && rules::index_of(key) <= object.last &&
        rules::sub_of(key) >= object.first_sub && rules::sub_of(key) <= object.last_sub) {
      return width == object.width;
    }
  }
  return true;
}

/// Checks all rules of the entry at \a position, except whether a PDO may map it. \a previous: key of the previous
/// entry, 0 for the first. An entry with a type of the application is checked by check_entry() and check_unknown()
/// only.
template <const auto& Od, bool Complete>
constexpr CO_DICT_FAULT check(std::uint32_t previous, std::size_t position) {
  const CO_OBJ& entry = Od[position];
  const Content data = content<Od>(position);
  const bool has_data = data != Content::null;
  const CO_DICT_FAULT fault = rules::check_entry(previous, entry.Key, !is_same(entry.Type, nullptr), has_data);
  const Type type = type_of(entry);
  if (fault != CO_DICT_OK || type.value == Value::of_application) {
    return fault != CO_DICT_OK ? fault : check_unknown(entry.Type, data);
  }
  const CO_DICT_FAULT of_type = rules::check_type(type.rule, entry.Key, has_data);
  if (of_type != CO_DICT_OK) {
    return of_type;
  }
  return !Complete || has_standard_width(entry.Key, type.width) ? check_content(entry.Key, data) : CO_DICT_WRONG_PLACE;
}

/// Returns the position of an entry, or the length of the table.
template <std::size_t Length>
constexpr std::size_t position(const CO_OBJ (&od)[Length], std::uint32_t key) {
  for (std::size_t i = 0; i < Length && !rules::is_end(od[i].Key); ++i) {
    if ((od[i].Key >> 8) == (key >> 8)) {
      return i;
    }
  }
  return Length;
}

/// Returns the number of entries before the end mark.
template <std::size_t Length>
constexpr std::size_t entries(const CO_OBJ (&od)[Length]) {
  std::size_t number = 0;
  while (number < Length && !rules::is_end(od[number].Key)) {
    ++number;
  }
  return number;
}

/// Like position(), for a table of \a number entries in ascending order: a binary search.
template <std::size_t Length>
constexpr std::size_t sorted_position(const CO_OBJ (&od)[Length], std::size_t number, std::uint32_t key) {
  std::size_t from = 0;
  std::size_t to = number;
  while (from < to) {
    const std::size_t middle = (from + to) / 2;
    if ((od[middle].Key >> 8) < (key >> 8)) {
      from = middle + 1;
    } else {
      to = middle;
    }
  }
  return from < number && (od[from].Key >> 8) == (key >> 8) ? from : Length;
}

/// Returns the key of an entry, without flags.
constexpr std::uint32_t key_of(std::uint16_t index, std::uint8_t sub) {
  return std::uint32_t{index} << 16 | std::uint32_t{sub} << 8;
}

/// Returns the number of mapped objects if it is a constant of the table, otherwise the maximum.
template <const auto& Od>
constexpr std::uintptr_t mapped_number(std::uint16_t index) {
  constexpr std::uintptr_t highest = 64;
  const std::size_t number = position(Od, key_of(index, 0));
  if (number == length(Od) || !rules::has(Od[number].Key, CO_OBJ_D_____)) {
    return highest;
  }
  return content<Od>(number) == Content::address ? highest : Od[number].Data.value();
}

/// Returns the value of the mapping entry at \a position if it is a constant of the table and one of the first \a
/// number entries, otherwise 0. The value of a mapping in a variable is unknown to the compiler. Static data types,
/// which skip bytes, and multiplex PDOs (FEh and FFh), which do not use their mapping entries, are 0, too. \a rule:
/// PDOs or SRDOs
template <const auto& Od>
constexpr std::uint32_t mapped_by(const rules::Rule& rule, std::size_t position, std::uintptr_t number) {
  const std::uint32_t key = Od[position].Key;
  const bool is_mapping = rules::allows(rule, key) && rules::has(key, CO_OBJ_D_____);
  if (!is_mapping || number > rules::pdo_mapping.last_sub || rules::sub_of(key) > number ||
      content<Od>(position) != Content::value) {
    return 0;
  }
  const auto mapping = static_cast<std::uint32_t>(Od[position].Data.value());
  return rules::is_static_type(mapping) ? 0 : mapping;
}

/// Like the function above, with the number that the table has.
template <const auto& Od>
constexpr std::uint32_t mapped_by(const rules::Rule& rule, std::size_t position) {
  return rules::allows(rule, Od[position].Key)
             ? mapped_by<Od>(rule, position, mapped_number<Od>(rules::index_of(Od[position].Key)))
             : 0;
}

/// Returns whether a constant mapping of an ordinary PDO contains the object of a mapping value.
template <const auto& Od>
constexpr bool is_in_pdo(std::uint32_t mapping) {
  for (std::size_t position = 0; position < length(Od); ++position) {
    if ((mapped_by<Od>(rules::pdo_mapping, position) >> 8) == (mapping >> 8)) {
      return true;
    }
  }
  return false;
}

/// Returns the mapping value of the first object that constant mappings of an SRDO and of an ordinary PDO contain; 0:
/// none.
template <const auto& Od>
constexpr std::uint32_t find_shared() {
  for (std::size_t position = 0; position < length(Od); ++position) {
    const std::uint32_t mapping = mapped_by<Od>(rules::srdo_mapping, position);
    if (mapping != 0 && is_in_pdo<Od>(mapping)) {
      return mapping;
    }
  }
  return 0;
}

/// Causes a warning of the compiler whose template arguments name an object.
template <class Index, class Sub>
[[deprecated("a PDO and an SRDO map this object; map a copy of it into the PDO")]] constexpr bool
safety_object_in_pdo() {
  return true;
}

/// Result of a check.
struct Finding {
  CO_DICT_FAULT fault;  ///< CO_DICT_OK: no fault
  std::uint32_t key;    ///< key of the faulty entry, 0 without fault
};

/// Returns whether an entry of the table has a constant value with these bits.
template <const auto& Od>
constexpr bool has_constant(std::uint32_t key, std::uintptr_t bits) {
  const std::size_t found = position(Od, key);
  return found < length(Od) && rules::has(Od[found].Key, CO_OBJ_D_____) && content<Od>(found) == Content::value &&
         (Od[found].Data.value() & bits) == bits;
}

/// Returns whether an entry can be mapped with so many bits. Types of the application may have any length.
template <const auto& Od>
constexpr bool has_bits(std::size_t position, unsigned bits, bool is_srdo) {
  const Type type = type_of(Od[position]);
  const bool is_bit = bits == 1 && USE_PDO_BITS != 0 && !is_srdo && is_same(Od[position].Type, &COTBoolean);
  if (type.value == Value::of_application || is_bit) {
    return true;
  }
  return type.width != 0 ? bits == type.width * 8u : bits != 0 && bits % 8u == 0;
}

/// State of the check of a mapping, kept from entry to entry.
struct MappingState {
  std::size_t entries = 0;      ///< of the table
  std::uint16_t index = 0;      ///< index of the mapping
  std::uintptr_t number = 0;    ///< mapped objects
  bool is_ignored = false;      ///< the PDO is switched off by a constant COB-ID
  bool is_counted = false;      ///< the number of objects is constant
  unsigned bits[2] = {0u, 0u};  ///< bits so far; of an SRDO those of both frames: odd and even sub-indices
};

/// Returns the state at the first entry of a mapping.
template <const auto& Od>
constexpr MappingState mapping_state(std::size_t entries, std::uint16_t index) {
  constexpr std::uint16_t to_communication = 0x200;
  constexpr std::uintptr_t off = 0x80000000u;
  MappingState state;
  state.entries = entries;
  state.index = index;
  state.number = mapped_number<Od>(index);
  const bool is_pdo = rules::allows(rules::pdo_mapping, key_of(index, 1));
  state.is_ignored = is_pdo && has_constant<Od>(key_of(static_cast<std::uint16_t>(index - to_communication), 1), off);
  state.is_counted = has_constant<Od>(key_of(index, 0), 0);
  return state;
}

/// Checks the mapping entry at \a position, if it is constant and the PDO is not switched off.
template <const auto& Od, bool Complete>
constexpr Finding check_mapping(std::size_t position, MappingState& state) {
  const std::uint32_t key = Od[position].Key;
  const bool is_srdo = rules::allows(rules::srdo_mapping, key);
  if (!is_srdo && !rules::allows(rules::pdo_mapping, key)) {
    return {CO_DICT_OK, 0};
  }
  if (state.index != rules::index_of(key)) {
    state = mapping_state<Od>(state.entries, rules::index_of(key));
  }
  const std::uint32_t mapping =
      mapped_by<Od>(is_srdo ? rules::srdo_mapping : rules::pdo_mapping, position, state.number);
  if (mapping == 0 || state.is_ignored) {
    return {CO_DICT_OK, 0};
  }
  const std::size_t mapped = sorted_position(Od, state.entries, mapping);
  if (mapped == length(Od)) {
    return {Complete ? CO_DICT_MAP_TARGET : CO_DICT_OK, Complete ? key : 0};
  }
  if (!rules::has(Od[mapped].Key, CO_OBJ____P__)) {
    return {CO_DICT_NOT_MAPPABLE, Od[mapped].Key};
  }
  constexpr unsigned most = 64;
  unsigned& sum = state.bits[is_srdo ? rules::sub_of(key) & 1u : 0u];
  sum += mapping & 0xFFu;
  const bool fits = !Complete || (has_bits<Od>(mapped, mapping & 0xFFu, is_srdo) && (!state.is_counted || sum <= most));
  return {fits ? CO_DICT_OK : CO_DICT_MAP_LENGTH, fits ? 0 : key};
}

/// Checks whether all objects of constant mappings exist, have flag P and have the mapped length. Returns the first
/// mapped object without flag P, or the first wrong mapping entry.
template <const auto& Od, bool Complete>
constexpr Finding check_mappings() {
  MappingState state;
  state.entries = entries(Od);
  for (std::size_t position = 0; position < length(Od); ++position) {
    const Finding finding = check_mapping<Od, Complete>(position, state);
    if (finding.fault != CO_DICT_OK) {
      return finding;
    }
  }
  return {CO_DICT_OK, 0};
}

/// Returns the first mandatory entry that the table does not have. [CiA 301, 7.5.1]
template <const auto& Od>
constexpr Finding check_mandatory() {
  constexpr std::uint32_t mandatory[] = {CO_DEV(0x1000u, 0u), CO_DEV(0x1001u, 0u), CO_DEV(0x1018u, 0u),
                                         CO_DEV(0x1018u, 1u)};
  for (const std::uint32_t key : mandatory) {
    if (position(Od, key) == length(Od)) {
      return {CO_DICT_MISSING, key};
    }
  }
  return {CO_DICT_OK, 0};
}

/// Checks the table. Returns its first fault. \a Complete: as CO_OD_CHECK(), otherwise as CO_OD_CHECK_PART()
template <const auto& Od, bool Complete = true>
constexpr Finding check() {
  std::uint32_t previous = 0;
  bool ended = false;
  for (std::size_t position = 0; position < length(Od); ++position) {
    const std::uint32_t key = Od[position].Key;
    if (rules::is_end(key)) {
      ended = true;
      continue;
    }
    const CO_DICT_FAULT fault = ended ? CO_DICT_NOT_ASCENDING : check<Od, Complete>(previous, position);
    if (fault != CO_DICT_OK) {
      return {fault, key};
    }
    previous = key;
  }
  const Finding finding = check_mappings<Od, Complete>();
  return finding.fault != CO_DICT_OK || !Complete ? finding : check_mandatory<Od>();
}

/// Returns true, or causes a compile error that names the first fault of the table. Causes a warning if an SRDO and an
/// ordinary PDO map the same object.
template <const auto& Od, bool Complete>
constexpr bool is_proved() {
  constexpr Finding finding = check<Od, Complete>();
  constexpr std::uint32_t shared = find_shared<Od>();
  if constexpr (shared != 0) {
    (void)safety_object_in_pdo<IndexOf<rules::index_of(shared)>, SubOf<rules::sub_of(shared)>>();
  }
  return Dictionary<finding.fault, IndexOf<rules::index_of(finding.key)>, SubOf<rules::sub_of(finding.key)>>::proved;
}

}  // namespace dictionary

/// Finds an entry of a constexpr table. \a key: CO_DEV(index, sub); flags are ignored. A linear search, for constant
/// expressions.
/// \retval null  there is no such entry
template <std::size_t Length>
constexpr const CO_OBJ* find(const CO_OBJ (&od)[Length], std::uint32_t key) {
  const std::size_t position = dictionary::position(od, key);
  return position < Length ? &od[position] : nullptr;
}

/// Returns an entry of a constexpr dictionary. The compiler finds it: the address is a constant, and an entry that does
/// not exist is a compile error. The result is for COObjRdValue() and similar functions; the entry itself is constant
/// and must not be written.
///
///     CO_OBJ *const speed = co::entry<od, 0x2100, 1>();
template <const auto& Od, std::uint16_t Index, std::uint8_t Sub>
constexpr CO_OBJ* entry() {
  constexpr std::size_t position = dictionary::position(Od, dictionary::key_of(Index, Sub));
  constexpr bool exists = position < dictionary::length(Od);
  static_assert(Entry<dictionary::IndexOf<Index>, dictionary::SubOf<Sub>, exists>::proved);
  return const_cast<CO_OBJ*>(&Od[exists ? position : 0]);
}

}  // namespace co

}  // extern "C++"
