// SPDX-License-Identifier: Apache-2.0
/// \file number.hpp
/// Parsing of numbers in the notations of device descriptions, with the exact fault of malformed ones. Independent of
/// the locale.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lexican::codict {

/// An integer of 64 bits, signed or unsigned.
struct Integer {
  std::uint64_t magnitude = 0;
  bool is_negative = false;

  constexpr Integer() = default;
  constexpr Integer(std::uint64_t value, bool negative = false)  // NOLINT(*-explicit-*): a number is an Integer
      : magnitude(value), is_negative(negative && value != 0) {}

  /// Returns the value in two's complement.
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

/// Returns the value of the lowest bits of `pattern`, read as a two's complement number. bits: 1…64.
Integer sign_extended(std::uint64_t pattern, unsigned bits);
/// Returns whether a value fits in a signed or unsigned integer. bits: 1…64.
bool fits_signed(const Integer& value, unsigned bits);
bool fits_unsigned(const Integer& value, unsigned bits);

enum class Base : unsigned char { decimal, hexadecimal, octal };

enum class NumberFault : unsigned char {
  none,
  empty,
  no_number,      ///< not a number, or followed by other text
  octal_digit,    ///< 08 and 09: a leading zero means octal
  too_large,      ///< exceeds 64 bits
  suffix,         ///< number with a suffix of C (10u, 0x1FLL) or the suffix h (80h)
  comment,        ///< "0x3ED ; why": a comment after the number
  fraction,       ///< 3.1
  zero_fraction,  ///< 3.0
  word,           ///< true, false
};

/// Result of parse_integer(). From the fault `suffix` on, `value` is the number that is probably meant; for `fraction`,
/// it is the part before the point.
struct ParsedInteger {
  Integer value;
  Base base = Base::decimal;
  NumberFault fault = NumberFault::none;
  std::size_t fault_at = 0;  ///< offset in the text

  bool is_number() const { return fault == NumberFault::none; }
  /// Returns whether `value` can be used in spite of a fault.
  bool is_meant() const { return is_number() || (fault >= NumberFault::suffix && fault != NumberFault::fraction); }
};

/// Parses a decimal, hexadecimal (0x) or octal (leading zero) integer with an optional sign. [CiA 306]
ParsedInteger parse_integer(std::string_view text);

/// Parses hexadecimal digits without 0x, the form of section names and of CiA 311 attributes. Returns false for any
/// other text and for numbers of more than 64 bits.
bool parse_hex(std::string_view digits, std::uint64_t& value);

/// A value that may depend on the node-ID: $NODEID first, then numbers that are added. [CiA 306]
struct ParsedFormula {
  ParsedInteger number;  ///< sum of all summands; its fault is that of the first malformed summand
  bool has_node_id = false;
  bool is_standard = true;  ///< false for the forms 0x180+$NODEID and $NodeId, and for blanks
};

ParsedFormula parse_formula(std::string_view text);

enum class RealForm : unsigned char { decimal, integer, bit_pattern, decimal_comma, no_number };

struct ParsedReal {
  double value = 0;
  RealForm form = RealForm::no_number;
};

/// Parses a REAL of 32 or 64 bits (`bits`). A bit pattern or number that exceeds this width is `no_number`.
ParsedReal parse_real(std::string_view text, unsigned bits);

/// Returns whether a character is a space, a tab, or a CR (which remains where a line end is irregular).
constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
std::string_view trimmed(std::string_view text);
/// Returns the text before a comment, which begins with a blank and one of ; # //; the whole text without a comment.
std::string_view without_comment(std::string_view text);
/// Returns bytes as pairs of hexadecimal digits: "0AFF".
std::string hexadecimal_octets(std::string_view octets);
/// Compares two texts; only ASCII letters are case-insensitive, whatever the locale.
bool equal_ignoring_case(std::string_view a, std::string_view b);

}  // namespace lexican::codict
