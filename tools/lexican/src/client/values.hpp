// SPDX-License-Identifier: Apache-2.0
/// \file values.hpp
/// Converts values of objects between text and bytes in the order of the bus. [301:7.1.4.8]
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lexican {

using Bytes = std::vector<std::uint8_t>;

struct ValueType {
  enum class Kind { unsigned_integer, integer, real, boolean, text, bytes };
  Kind kind;
  unsigned size;  // bytes; 0: variable

  bool operator==(const ValueType& other) const { return kind == other.kind && size == other.size; }
};

/// The names of all types, for --help.
constexpr const char* value_type_names =
    "u8, u16, u24 ... u64, i8, i16, i24 ... i64, r32, r64, bool, string, bytes (or domain)";

/// Returns the type with a name, nothing if it is unknown.
std::optional<ValueType> value_type(std::string_view name);

/// Bytes of a value, or the fault of the text.
struct Encoded {
  Bytes bytes;
  std::string fault;  // empty: none
};

/// Converts text to bytes. Integers: decimal, or hexadecimal with 0x; reals: C syntax; bool: 0, 1, false or true;
/// bytes: pairs of hex digits, spaces allowed. A value out of the type's range is a fault.
Encoded encode(ValueType type, const std::string& text);

/// Text of a value, or the fault of the bytes.
struct Shown {
  std::string text;
  std::string fault;  // empty: none
};

/// Converts bytes to text, the reverse of encode(). A boolean that is not 0 is shown as 1.
Shown show(ValueType type, const Bytes& bytes);

/// Returns the characters of a VISIBLE_STRING without trailing zeros; empty if any is not printable. [301:7.1.6]
std::string visible_text(const Bytes& bytes);

/// Returns bytes of unknown type as text: 1, 2, 4 and 8 bytes as a number in hex digits; others as a hex dump with the
/// printable characters.
std::string guess(const Bytes& bytes);

/// Returns an unsigned integer in little-endian order. \a bytes: at most 8.
std::uint64_t number_of(const Bytes& bytes);

}  // namespace lexican
