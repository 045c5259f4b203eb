// SPDX-License-Identifier: Apache-2.0
#include "model/types.hpp"

#include <algorithm>
#include <array>

#include "text/number.hpp"

namespace lexican::codict {

namespace {

using K = TypeKind;

// Sorted by code. [301: 7.4.7.1]
constexpr std::array<DataType, 31> types = {{
    {0x01, K::boolean, 1, "BOOLEAN", "BOOL", "bool"},
    {0x02, K::signed_integer, 8, "INTEGER8", "SINT", "int8_t"},
    {0x03, K::signed_integer, 16, "INTEGER16", "INT", "int16_t"},
    {0x04, K::signed_integer, 32, "INTEGER32", "DINT", "int32_t"},
    {0x05, K::unsigned_integer, 8, "UNSIGNED8", "USINT", "uint8_t"},
    {0x06, K::unsigned_integer, 16, "UNSIGNED16", "UINT", "uint16_t"},
    {0x07, K::unsigned_integer, 32, "UNSIGNED32", "UDINT", "uint32_t"},
    {0x08, K::real, 32, "REAL32", "REAL", "float"},
    {0x09, K::visible_string, 0, "VISIBLE_STRING", "STRING", ""},
    {0x0A, K::octet_string, 0, "OCTET_STRING", "BITSTRING", ""},
    {0x0B, K::unicode_string, 0, "UNICODE_STRING", "WSTRING", ""},
    {0x0C, K::time, 48, "TIME_OF_DAY", "", ""},
    {0x0D, K::time, 48, "TIME_DIFFERENCE", "", ""},
    {0x0F, K::domain, 0, "DOMAIN", "", ""},
    {0x10, K::signed_integer, 24, "INTEGER24", "", "int32_t"},
    {0x11, K::real, 64, "REAL64", "LREAL", "double"},
    {0x12, K::signed_integer, 40, "INTEGER40", "", "int64_t"},
    {0x13, K::signed_integer, 48, "INTEGER48", "", "int64_t"},
    {0x14, K::signed_integer, 56, "INTEGER56", "", "int64_t"},
    {0x15, K::signed_integer, 64, "INTEGER64", "LINT", "int64_t"},
    {0x16, K::unsigned_integer, 24, "UNSIGNED24", "", "uint32_t"},
    {0x18, K::unsigned_integer, 40, "UNSIGNED40", "", "uint64_t"},
    {0x19, K::unsigned_integer, 48, "UNSIGNED48", "", "uint64_t"},
    {0x1A, K::unsigned_integer, 56, "UNSIGNED56", "", "uint64_t"},
    {0x1B, K::unsigned_integer, 64, "UNSIGNED64", "ULINT", "uint64_t"},
    {0x20, K::structure, 0, "PDO_COMMUNICATION_PARAMETER", "", ""},
    {0x21, K::structure, 0, "PDO_MAPPING", "", ""},
    {0x22, K::structure, 0, "SDO_PARAMETER", "", ""},
    {0x23, K::structure, 0, "IDENTITY", "", ""},
    {0x24, K::structure, 0, "DEBUGGER_PARAMETER", "", ""},
    {0x25, K::structure, 0, "COMMAND_PARAMETER", "", ""},
}};

struct OtherName {
  std::string_view name;
  std::uint16_t code;
};

// Names that CiA 311 defines for types that have another name in CiA 301.
constexpr std::array<OtherName, 5> other_names = {
    {{"CHAR", 0x02}, {"BYTE", 0x05}, {"WORD", 0x06}, {"DWORD", 0x07}, {"LWORD", 0x1B}}};

constexpr DataType unknown_type{};

}  // namespace

const DataType& data_type(std::uint16_t code) {
  const auto* const found = std::lower_bound(types.begin(), types.end(), code,
                                             [](const DataType& type, std::uint16_t key) { return type.code < key; });
  return found != types.end() && found->code == code ? *found : unknown_type;
}

const DataType* data_type_named(std::string_view name) {
  for (const DataType& type : types) {
    if (equal_ignoring_case(type.name, name) || (!type.iec.empty() && equal_ignoring_case(type.iec, name))) {
      return &type;
    }
  }
  for (const OtherName& other : other_names) {
    if (equal_ignoring_case(other.name, name)) {
      return &data_type(other.code);
    }
  }
  return nullptr;
}

}  // namespace lexican::codict
