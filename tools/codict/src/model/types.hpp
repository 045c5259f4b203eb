// SPDX-License-Identifier: Apache-2.0
/// \file types.hpp
/// The data types of CiA 301, table 44, and their names in CiA 311 and C.
#pragma once

#include <cstdint>
#include <string_view>

namespace lexican::codict {

enum class TypeKind : unsigned char {
  unknown,
  boolean,
  signed_integer,
  unsigned_integer,
  real,
  visible_string,
  octet_string,
  unicode_string,
  time,  ///< TIME_OF_DAY or TIME_DIFFERENCE
  domain,
  structure,  ///< one of the records of CiA 301, 20h…25h
};

struct DataType {
  std::uint16_t code = 0;  ///< index of the type in the dictionary
  TypeKind kind = TypeKind::unknown;
  std::uint16_t bits = 0;  ///< 0: the length is not fixed
  std::string_view name;   ///< name in CiA 301
  std::string_view iec;    ///< name in CiA 311, from IEC 61131-3; empty if there is none
  std::string_view c;      ///< type in C; empty if there is none
};

/// Returns a data type of CiA 301, else a type of kind unknown. Types that a device defines are in its dictionary: see
/// data_type_of().
const DataType& data_type(std::uint16_t code);
/// Returns the type with a name of CiA 301 or CiA 311, in any case; null if there is none.
const DataType* data_type_named(std::string_view name);

constexpr bool is_integer(TypeKind kind) {
  return kind == TypeKind::signed_integer || kind == TypeKind::unsigned_integer;
}
constexpr bool is_string(TypeKind kind) {
  return kind == TypeKind::visible_string || kind == TypeKind::octet_string || kind == TypeKind::unicode_string;
}

namespace type_code {
constexpr std::uint16_t boolean = 0x01;
constexpr std::uint16_t integer8 = 0x02;
constexpr std::uint16_t unsigned8 = 0x05;
constexpr std::uint16_t unsigned16 = 0x06;
constexpr std::uint16_t unsigned32 = 0x07;
constexpr std::uint16_t visible_string = 0x09;
constexpr std::uint16_t octet_string = 0x0A;
constexpr std::uint16_t domain = 0x0F;
}  // namespace type_code

}  // namespace lexican::codict
