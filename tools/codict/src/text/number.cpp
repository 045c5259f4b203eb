// SPDX-License-Identifier: Apache-2.0
#include "text/number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <system_error>

namespace lexican::codict {

namespace {

constexpr std::string_view node_id_word = "$nodeid";

constexpr std::uint64_t ones(unsigned bits) {
  return bits >= 64 ? std::numeric_limits<std::uint64_t>::max() : (std::uint64_t{1} << bits) - 1;
}

struct Digits {
  std::uint64_t value = 0;
  std::size_t size = 0;
  bool is_too_large = false;
};

Digits read_digits(std::string_view text, int base) {
  Digits digits;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, digits.value, base);
  digits.size = static_cast<std::size_t>(stop - text.data());
  digits.is_too_large = error == std::errc::result_out_of_range;
  return digits;
}

bool is_suffix(std::string_view rest) {
  constexpr std::array<std::string_view, 5> suffixes = {"u", "l", "ul", "ll", "ull"};
  return std::any_of(suffixes.begin(), suffixes.end(),
                     [rest](std::string_view suffix) { return equal_ignoring_case(rest, suffix); });
}

// Parses the notation 0080h of manuals as hexadecimal, with the fault `suffix`. Returns false for other texts.
bool read_with_h(std::string_view text, ParsedInteger& parsed) {
  std::uint64_t value = 0;
  const bool has_form = text.size() > 1 && is_digit(text.front()) && to_lower(text.back()) == 'h';
  if (!has_form || !parse_hex(text.substr(0, text.size() - 1), value)) {
    return false;
  }
  parsed = {Integer(value), Base::hexadecimal, NumberFault::suffix, text.size() - 1};
  return true;
}

NumberFault fault_of_rest(std::string_view rest, const ParsedInteger& parsed) {
  if (rest.empty()) {
    return NumberFault::none;
  }
  if (is_suffix(rest)) {
    return NumberFault::suffix;
  }
  if (without_comment(rest).empty()) {
    return NumberFault::comment;
  }
  if (rest.front() == '.' && parsed.base != Base::hexadecimal && rest.size() > 1 &&
      std::all_of(rest.begin() + 1, rest.end(), is_digit)) {
    const bool is_zero = rest.find_first_not_of('0', 1) == std::string_view::npos;
    return is_zero ? NumberFault::zero_fraction : NumberFault::fraction;
  }
  return parsed.base == Base::octal && is_digit(rest.front()) ? NumberFault::octal_digit : NumberFault::no_number;
}

bool starts_with_node_id(std::string_view text) {
  return equal_ignoring_case(text.substr(0, node_id_word.size()), node_id_word);
}

void add(ParsedInteger& sum, const ParsedInteger& summand, std::size_t offset) {
  if (sum.fault == NumberFault::none && summand.fault != NumberFault::none) {
    sum.fault = summand.fault;
    sum.fault_at = offset + summand.fault_at;
  }
  sum.base = summand.base;
  const Integer& a = sum.value;
  const Integer& b = summand.value;
  if (a.is_negative == b.is_negative) {
    if (a.magnitude > std::numeric_limits<std::uint64_t>::max() - b.magnitude && sum.fault == NumberFault::none) {
      sum.fault = NumberFault::too_large;
    }
    sum.value = Integer(a.magnitude + b.magnitude, a.is_negative);
  } else if (a.magnitude >= b.magnitude) {
    sum.value = Integer(a.magnitude - b.magnitude, a.is_negative);
  } else {
    sum.value = Integer(b.magnitude - a.magnitude, b.is_negative);
  }
}

// Returns 0 as the summand $NODEID, with a fault if other text follows it.
ParsedInteger behind_node_id(std::string_view rest) {
  ParsedInteger nothing;
  if (!rest.empty()) {
    nothing.fault = without_comment(rest).empty() ? NumberFault::comment : NumberFault::no_number;
  }
  return nothing;
}

double from_pattern(std::uint64_t pattern, unsigned bits) {
  if (bits == 32) {
    const auto narrow = static_cast<std::uint32_t>(pattern);
    float value = 0;
    std::memcpy(&value, &narrow, sizeof value);
    return static_cast<double>(value);
  }
  double value = 0;
  std::memcpy(&value, &pattern, sizeof value);
  return value;
}

// Parses the whole text as a number with a decimal point. Returns false if it is not one.
bool read_decimal(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

Integer sign_extended(std::uint64_t pattern, unsigned bits) {
  const std::uint64_t value = pattern & ones(bits);
  const bool is_negative = ((value >> (bits - 1)) & 1U) != 0;
  return is_negative ? Integer((~value & ones(bits)) + 1, true) : Integer(value);
}

bool fits_signed(const Integer& value, unsigned bits) {
  return value.magnitude <= ones(bits - 1) + (value.is_negative ? 1U : 0U);
}

bool fits_unsigned(const Integer& value, unsigned bits) { return !value.is_negative && value.magnitude <= ones(bits); }

ParsedInteger parse_integer(std::string_view text) {
  ParsedInteger parsed;
  if (text.empty()) {
    parsed.fault = NumberFault::empty;
    return parsed;
  }
  if (equal_ignoring_case(text, "true") || equal_ignoring_case(text, "false")) {
    parsed.fault = NumberFault::word;
    parsed.value = to_lower(text.front()) == 't' ? 1U : 0U;
    return parsed;
  }
  if (read_with_h(text, parsed)) {
    return parsed;
  }
  std::size_t at = text.front() == '-' || text.front() == '+' ? 1 : 0;
  int base = 10;
  if (text.size() > at + 1 && text[at] == '0') {
    if (to_lower(text[at + 1]) == 'x') {
      parsed.base = Base::hexadecimal;
      base = 16;
      at += 2;
    } else if (is_digit(text[at + 1])) {
      parsed.base = Base::octal;
      base = 8;
    }
  }
  const Digits digits = read_digits(text.substr(at), base);
  parsed.value = Integer(digits.value, text.front() == '-');
  parsed.fault_at = digits.size == 0 ? 0 : at + digits.size;
  if (digits.size == 0) {
    parsed.fault = NumberFault::no_number;
  } else {
    parsed.fault = digits.is_too_large ? NumberFault::too_large : fault_of_rest(text.substr(at + digits.size), parsed);
  }
  return parsed;
}

bool parse_hex(std::string_view digits, std::uint64_t& value) {
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
  return error == std::errc() && stop == end && digits.front() != '-';
}

ParsedFormula parse_formula(std::string_view text) {
  ParsedFormula formula;
  if (text.find('$') == std::string_view::npos) {
    formula.number = parse_integer(text);
    return formula;
  }
  formula.is_standard = text.substr(0, node_id_word.size()) == "$NODEID" && text.find(' ') == std::string_view::npos;
  // Text after a comment sign belongs to the last summand, even if it contains a plus.
  for (std::size_t at = 0; at <= text.size() && formula.number.fault != NumberFault::comment;) {
    const std::size_t plus = std::min(text.find('+', at), text.size());
    const std::string_view part = trimmed(text.substr(at, plus - at));
    const std::size_t offset = part.empty() ? at : static_cast<std::size_t>(part.data() - text.data());
    if (!formula.has_node_id && starts_with_node_id(part)) {
      formula.has_node_id = true;
      add(formula.number, behind_node_id(part.substr(node_id_word.size())), offset + node_id_word.size());
    } else {
      add(formula.number, parse_integer(part), offset);
    }
    at = plus + 1;
  }
  if (!formula.has_node_id && formula.number.fault == NumberFault::none) {
    formula.number.fault = NumberFault::no_number;
  }
  return formula;
}

ParsedReal parse_real(std::string_view text, unsigned bits) {
  const ParsedInteger integer = parse_integer(text);
  if (integer.is_number() && integer.base == Base::hexadecimal) {
    if (!fits_unsigned(integer.value, bits)) {
      return {};
    }
    return {from_pattern(integer.value.magnitude, bits), RealForm::bit_pattern};
  }
  ParsedReal real;
  if (read_decimal(text, real.value)) {
    real.form =
        text.find_first_not_of("+-0123456789") == std::string_view::npos ? RealForm::integer : RealForm::decimal;
  } else if (const std::size_t comma = text.find(','); comma != std::string_view::npos && text.size() < 64) {
    std::string pointed(text);
    pointed[comma] = '.';
    real.form = read_decimal(pointed, real.value) ? RealForm::decimal_comma : RealForm::no_number;
  }
  if (bits == 32 && std::isfinite(real.value) &&
      std::abs(real.value) > static_cast<double>(std::numeric_limits<float>::max())) {
    return {};
  }
  return real;
}

std::string_view without_comment(std::string_view text) {
  for (std::size_t n = 0; n + 1 < text.size(); ++n) {
    const std::string_view rest = text.substr(n + 1);
    if (is_blank(text[n]) && (rest.front() == ';' || rest.front() == '#' || rest.substr(0, 2) == "//")) {
      return trimmed(text.substr(0, n));
    }
  }
  return text;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_blank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

std::string hexadecimal_octets(std::string_view octets) {
  std::string text;
  for (const char octet : octets) {
    const auto byte = static_cast<unsigned char>(octet);
    text += "0123456789ABCDEF"[byte >> 4U];
    text += "0123456789ABCDEF"[byte & 0xFU];
  }
  return text;
}

bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) { return to_lower(x) == to_lower(y); });
}

}  // namespace lexican::codict
