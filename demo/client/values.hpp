// SPDX-License-Identifier: Apache-2.0
/// \file values.hpp
/// Values of objects as people write them, and as bytes in the order of the bus. [301:7.1.4.8]
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace demo {

using Bytes = std::vector<std::uint8_t>;

struct ValueType {
  enum class Kind { unsigned_integer, integer, real, boolean, text, bytes };
  Kind kind;
  unsigned size;  // bytes; 0: any number of them

  bool operator==(const ValueType& other) const { return kind == other.kind && size == other.size; }
};

/// The names of all types, for --help.
constexpr const char* value_type_names =
    "u8, u16, u24 ... u64, i8, i16, i24 ... i64, r32, r64, bool, string, bytes (or domain)";

/// The type of that name; nothing if it is none of the above.
std::optional<ValueType> value_type(std::string_view name);

/// The bytes of a value, or what is wrong with the text.
struct Encoded {
  Bytes bytes;
  std::string fault;  // empty: nothing
};

/// Integers: decimal, or hexadecimal with 0x; reals: as C writes them; bool: 0, 1, false or true; bytes: pairs of hex
/// digits, spaces between them allowed. A value that the type does not hold is a fault.
Encoded encode(ValueType type, const std::string& text);

/// The text of a value, or what is wrong with the bytes.
struct Shown {
  std::string text;
  std::string fault;  // empty: nothing
};

/// The reverse of encode(). A boolean that is not 0 is shown as 1.
Shown show(ValueType type, const Bytes& bytes);

/// The characters of a VISIBLE_STRING without the zeros at its end; empty if others are among them than printable ones.
/// [301:7.1.6]
std::string visible_text(const Bytes& bytes);

/// Bytes of which nothing is known but their number: 1, 2, 4 and 8 as a number in hex digits; others as the lines of a
/// hex dump, with the characters that can be read.
std::string guess(const Bytes& bytes);

}  // namespace demo
