// SPDX-License-Identifier: Apache-2.0
/// \file types.hpp
/// The data types of CiA 301, table 44, and what they are called elsewhere.
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
  time,  ///< of day, or a difference
  domain,
  structure,  ///< one of the records of CiA 301, 20h…25h
};

struct DataType {
  std::uint16_t code = 0;  ///< index of the type in the dictionary
  TypeKind kind = TypeKind::unknown;
  std::uint16_t bits = 0;  ///< 0: the length is not fixed
  std::string_view name;   ///< CiA 301
  std::string_view iec;    ///< CiA 311, from IEC 61131-3; empty where it has no name for it
  std::string_view c;      ///< empty where C has no such type
};

/// Types of a device of its own (40h…9Fh, or any other code) are found as its objects. Never null: kind unknown.
const DataType& data_type(std::uint16_t code);
/// By the name of CiA 301 or of CiA 311; null if it is neither.
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
