// SPDX-License-Identifier: Apache-2.0
/// \file number.hpp
/// Numbers as descriptions write them, with what exactly is wrong about the others. No locale has a say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lexican::codict {

/// Any integer of 64 bits, with or without sign.
struct Integer {
  std::uint64_t magnitude = 0;
  bool is_negative = false;

  constexpr Integer() = default;
  constexpr Integer(std::uint64_t value, bool negative = false)  // NOLINT(*-explicit-*): a number is an Integer
      : magnitude(value), is_negative(negative && value != 0) {}

  /// Two's complement.
  constexpr std::uint64_t bits() const { return is_negative ? 0 - magnitude : magnitude; }
  constexpr bool operator==(const Integer& other) const {
    return magnitude == other.magnitude && is_negative == other.is_negative;
  }
  constexpr bool operator!=(const Integer& other) const { return !(*this == other); }
  constexpr bool operator<(const Integer& other) const {
    if (is_negative != other.is_negative) {
      return is_negative;
    }
    return is_negative ? magnitude > other.magnitude : magnitude < other.magnitude;
  }
};

/// What the lowest bits of a two's complement number mean, bits: 1…64.
Integer sign_extended(std::uint64_t pattern, unsigned bits);
/// Whether a number fits, bits: 1…64.
bool fits_signed(const Integer& value, unsigned bits);
bool fits_unsigned(const Integer& value, unsigned bits);

enum class Base : unsigned char { decimal, hexadecimal, octal };

enum class NumberFault : unsigned char {
  none,
  empty,
  no_number,      ///< nothing at its beginning is one
  octal_digit,    ///< 08 and 09: a leading zero means octal
  too_large,      ///< for 64 bits
  suffix,         ///< a number of C: 10u, 0x1FLL
  comment,        ///< "0x3ED ; why": what follows the number is no part of it
  fraction,       ///< 3.1
  zero_fraction,  ///< 3.0
  word,           ///< true, false
};

/// value is what is meant even where there is a fault, from `suffix` on; `fraction` gives what is before the point.
struct ParsedInteger {
  Integer value;
  Base base = Base::decimal;
  NumberFault fault = NumberFault::none;
  std::size_t fault_at = 0;  ///< offset in the text

  bool is_number() const { return fault == NumberFault::none; }
  /// Whether it can be taken for one.
  bool is_meant() const { return is_number() || (fault >= NumberFault::suffix && fault != NumberFault::fraction); }
};

/// Decimal, 0x hexadecimal, or octal with a leading zero, each with an optional sign. [CiA 306]
ParsedInteger parse_integer(std::string_view text);

/// Hexadecimal digits without 0x, as section names and CiA 311 attributes have them; false if it is anything else, or
/// too large for 64 bits.
bool parse_hex(std::string_view digits, std::uint64_t& value);

/// A value that may depend on the node-ID: $NODEID at its beginning, and numbers added. [CiA 306]
struct ParsedFormula {
  ParsedInteger number;  ///< of all summands; its fault is that of the first bad one
  bool has_node_id = false;
  bool is_standard = true;  ///< false: 0x180+$NODEID, $NodeId, blanks
};

ParsedFormula parse_formula(std::string_view text);

enum class RealForm : unsigned char { decimal, integer, bit_pattern, decimal_comma, no_number };

struct ParsedReal {
  double value = 0;
  RealForm form = RealForm::no_number;
};

/// bits: 32 or 64, the width of a bit pattern and of what is too large (which is no_number).
ParsedReal parse_real(std::string_view text, unsigned bits);

/// Blanks: space and tab, and the CR of a line whose end is not where it should be.
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
std::string_view trimmed(std::string_view text);
/// What is in front of a blank and one of ; # //
std::string_view without_comment(std::string_view text);
/// "0AFF" of any bytes.
std::string hexadecimal_octets(std::string_view octets);
/// Of ASCII letters, whatever the locale.
bool equal_ignoring_case(std::string_view a, std::string_view b);

}  // namespace lexican::codict
