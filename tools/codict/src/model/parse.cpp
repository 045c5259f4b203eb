// SPDX-License-Identifier: Apache-2.0
#include "model/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <type_traits>

namespace lexican::codict {

namespace rules {

const Rule value_number{"od-value-number", Severity::error, "value is not a number"};
const Rule value_octal_digit{"od-value-octal-digit", Severity::error, "octal number with digit 8 or 9"};
const Rule value_suffix{"od-value-suffix", Severity::error, "number with a suffix of C"};
const Rule value_comment{"od-value-comment", Severity::error, "text after a number"};
const Rule value_fraction{"od-value-fraction", Severity::error, "decimal point in an integer"};
const Rule value_word{"od-value-word", Severity::error, "true or false instead of 1 or 0"};
const Rule value_octal{"od-value-octal", Severity::warning, "octal number"};
const Rule value_range{"od-value-range", Severity::error, "value does not fit its data type"};
const Rule value_bit_pattern{"od-value-bit-pattern", Severity::note, "bit pattern of a negative number"};
const Rule value_node_id_form{"od-value-nodeid-form", Severity::warning, "unusual form of $NODEID+number"};
const Rule value_node_id_type{"od-value-nodeid-type", Severity::warning, "$NODEID in a value that is not an integer"};
const Rule value_real_bits{"od-value-real-bits", Severity::warning, "hexadecimal value of a REAL, read as bit pattern"};
const Rule value_real_integer{"od-value-real-integer", Severity::note,
                              "REAL value without decimal point, read as number"};
const Rule value_decimal_comma{"od-value-decimal-comma", Severity::warning, "decimal comma"};
const Rule value_octets{"od-value-octets", Severity::error, "malformed octet string"};
const Rule value_time{"od-value-time", Severity::warning, "time written as days and milliseconds"};
const Rule value_quotes{"od-value-quotes", Severity::note, "quotes around a string"};

}  // namespace rules

const std::vector<const Rule*>& value_rules() {
  using namespace rules;
  static const std::vector<const Rule*> all = {
      &value_number,       &value_octal_digit, &value_suffix,       &value_comment,       &value_fraction,
      &value_word,         &value_octal,       &value_range,        &value_bit_pattern,   &value_node_id_form,
      &value_node_id_type, &value_real_bits,   &value_real_integer, &value_decimal_comma, &value_octets,
      &value_time,         &value_quotes};
  return all;
}

namespace {

Span from(const Text& text, std::size_t offset) {
  const auto at = static_cast<std::uint32_t>(offset);
  return at < text.span.size() ? Span{text.span.begin + at, text.span.end} : text.span;
}

void report_word(const Text& text, Findings& findings) {
  const bool is_true = !text.text.empty() && to_lower(text.text.front()) == 't';
  findings.add(rules::value_word, text.span, fmt::format("{} instead of a number", in_quotes(text.text)),
               is_true ? "write 1" : "write 0");
}

// Reports the fault of a number. Returns false if the text has no meaning.
bool accept_number(const ParsedInteger& number, const Text& text, Findings& findings) {
  const Span rest = from(text, number.fault_at);
  switch (number.fault) {
    case NumberFault::none: return true;
    case NumberFault::empty:
    case NumberFault::no_number:
      findings.add(rules::value_number, rest, fmt::format("{} is not a number", in_quotes(text.text)),
                   "write a decimal number, or a hexadecimal one with 0x");
      return false;
    case NumberFault::octal_digit:
      findings.add(rules::value_octal_digit, rest,
                   fmt::format("{} begins with 0, but is not an octal number", in_quotes(text.text)),
                   "remove the leading 0, or write 0x");
      return false;
    case NumberFault::too_large:
      findings.add(rules::value_range, text.span, fmt::format("{} is larger than 64 bits", in_quotes(text.text)),
                   "write a smaller number");
      return false;
    case NumberFault::suffix:
      findings.add(rules::value_suffix, rest, fmt::format("suffix in {} is ignored", in_quotes(text.text)),
                   "remove it");
      return true;
    case NumberFault::comment:
      findings.add(rules::value_comment, rest, "text after the number is ignored",
                   "move it to a line that begins with ;");
      return true;
    case NumberFault::fraction:
      findings.add(rules::value_fraction, rest, fmt::format("decimal point in integer {}", in_quotes(text.text)),
                   "write an integer, or use REAL32");
      return false;
    case NumberFault::zero_fraction:
      findings.add(rules::value_fraction, rest, fmt::format("fraction of integer {} is ignored", in_quotes(text.text)),
                   "remove it");
      return true;
    case NumberFault::word: report_word(text, findings); return true;
  }
  return false;
}

void warn_of_octal(const ParsedInteger& number, const Text& text, Findings& findings) {
  if (number.base == Base::octal) {
    findings.add(rules::value_octal, text.span,
                 fmt::format("{} is octal, read as {}", in_quotes(text.text), number.value.magnitude),
                 "write it without the leading 0, or with 0x");
  }
}

// Returns the range of an integer type: "0 to 255".
std::string range_of(const DataType& type) {
  const std::uint64_t all = ~std::uint64_t{0} >> (64U - type.bits);
  return type.kind == TypeKind::signed_integer ? fmt::format("-{} to {}", all / 2 + 1, all / 2)
                                               : fmt::format("0 to {}", all);
}

// Returns whether a number fits its type. Converts the hexadecimal bit pattern of a negative number to that number,
// with a note.
bool fit(Integer& number, Base base, const DataType& type, const Value& value, Findings& findings) {
  const bool is_signed = type.kind == TypeKind::signed_integer;
  if (is_signed ? fits_signed(number, type.bits) : fits_unsigned(number, type.bits)) {
    return true;
  }
  const bool is_pattern = is_signed && fits_unsigned(number, type.bits);
  const Integer extended = sign_extended(number.magnitude, type.bits);
  const std::string meaning = fmt::format("-{}", extended.magnitude);
  if (is_pattern && base == Base::hexadecimal) {
    number = extended;
    findings.add(rules::value_bit_pattern, value.span,
                 fmt::format("{} is read as the bit pattern of {}", in_quotes(value.text), meaning),
                 "write " + meaning);
    return true;
  }
  findings.add(rules::value_range, value.span,
               fmt::format("{} does not fit {} ({})", in_quotes(value.text), type.name, range_of(type)),
               is_pattern && !value.adds_node_id
                   ? fmt::format("write 0x{:X} for the bit pattern of {}, or correct the value or data type",
                                 number.magnitude, meaning)
                   : "correct the value, or use a larger data type");
  return false;
}

void interpret_integer(Value& value, const DataType& type, Findings& findings) {
  const ParsedFormula formula = parse_formula(value.text);
  value.kind = Value::Kind::malformed;
  if (!accept_number(formula.number, value, findings)) {
    return;
  }
  warn_of_octal(formula.number, value, findings);
  if (formula.has_node_id && !formula.is_standard) {
    findings.add(rules::value_node_id_form, value.span,
                 fmt::format("{} is not in the form $NODEID+number", in_quotes(value.text)),
                 "write $NODEID first, in capitals and without blanks");
  }
  value.adds_node_id = formula.has_node_id;
  value.integer = formula.number.value;
  if (fit(value.integer, formula.number.base, type, value, findings)) {
    value.kind = Value::Kind::integer;
  }
}

void interpret_real(Value& value, const DataType& type, Findings& findings) {
  const ParsedReal real = parse_real(value.text, type.bits);
  value.real = real.value;
  value.kind = real.form == RealForm::no_number ? Value::Kind::malformed : Value::Kind::real;
  switch (real.form) {
    case RealForm::decimal: break;
    case RealForm::integer:
      findings.add(rules::value_real_integer, value.span,
                   fmt::format("{} has no decimal point, read as a number", in_quotes(value.text)),
                   "write a decimal point");
      break;
    case RealForm::bit_pattern:
      findings.add(rules::value_real_bits, value.span,
                   fmt::format("{} is read as the bit pattern of {}", in_quotes(value.text), value.real),
                   "write a decimal number");
      break;
    case RealForm::decimal_comma:
      findings.add(rules::value_decimal_comma, value.span, fmt::format("decimal comma in {}", in_quotes(value.text)),
                   "write a decimal point");
      break;
    case RealForm::no_number:
      findings.add(rules::value_number, value.span,
                   fmt::format("{} is not a number of type {}", in_quotes(value.text), type.name),
                   "write a decimal number");
      break;
  }
}

// Parses pairs of hexadecimal digits, with or without blanks between them.
bool read_octets(std::string_view text, std::string& octets) {
  while (!(text = trimmed(text)).empty()) {
    std::uint64_t octet = 0;
    if (text.size() < 2 || !parse_hex(text.substr(0, 2), octet)) {
      return false;
    }
    octets += static_cast<char>(octet);
    text.remove_prefix(2);
  }
  return true;
}

void interpret_octets(Value& value, Findings& findings) {
  value.kind = Value::Kind::octets;
  if (!read_octets(value.text, value.octets.edit())) {
    value.kind = Value::Kind::malformed;
    value.octets.reset();
    findings.add(rules::value_octets, value.span, fmt::format("{} is not an octet string", in_quotes(value.text)),
                 "write pairs of hexadecimal digits: 01 2A");
  }
}

void interpret_text(Value& value, Findings& findings) {
  value.kind = Value::Kind::text;
  if (value.text.size() > 1 && value.text.front() == '"' && value.text.back() == '"') {
    findings.add(rules::value_quotes, value.span, "quotes around the string are part of it", "remove them");
  }
}

// Interprets "365 43200000" as days and milliseconds.
void interpret_time(Value& value, Findings& findings) {
  const std::string_view text = value.text;
  const std::size_t blank = text.find(' ');
  const ParsedInteger days = parse_integer(text.substr(0, blank));
  const ParsedInteger milliseconds = parse_integer(trimmed(text.substr(std::min(blank, text.size()))));
  if (!days.is_number() || !milliseconds.is_number() || !fits_unsigned(days.value, 16) ||
      !fits_unsigned(milliseconds.value, 28)) {
    return;
  }
  value.kind = Value::Kind::integer;
  value.integer = days.value.magnitude << 32 | milliseconds.value.magnitude;
  findings.add(rules::value_time, value.span,
               fmt::format("{} are two numbers, read as days and milliseconds", in_quotes(text)),
               fmt::format("write {}", value.integer.magnitude));
}

void interpret_unknown(Value& value, Findings& findings) {
  const ParsedFormula formula = parse_formula(value.text);
  value.kind = Value::Kind::text;
  if (formula.number.is_number() && (formula.has_node_id || !value.text.empty())) {
    warn_of_octal(formula.number, value, findings);
    value.kind = Value::Kind::integer;
    value.adds_node_id = formula.has_node_id;
    value.integer = formula.number.value;
  }
}

}  // namespace

void interpret(Value& value, const DataType& type, Findings& findings) {
  value.kind = Value::Kind::none;
  if (value.text.empty()) {
    return;
  }
  switch (type.kind) {
    case TypeKind::boolean:
    case TypeKind::signed_integer:
    case TypeKind::unsigned_integer: interpret_integer(value, type, findings); return;
    case TypeKind::real: interpret_real(value, type, findings); break;
    case TypeKind::octet_string:
    case TypeKind::domain: interpret_octets(value, findings); break;
    case TypeKind::visible_string:
    case TypeKind::unicode_string: interpret_text(value, findings); break;
    case TypeKind::time:
      interpret_unknown(value, findings);
      if (value.kind == Value::Kind::text) {
        interpret_time(value, findings);
      }
      return;
    case TypeKind::structure:
    case TypeKind::unknown: interpret_unknown(value, findings); return;
  }
  if (equal_ignoring_case(value.text.substr(0, 7), "$nodeid")) {
    findings.add(rules::value_node_id_type, value.span, fmt::format("$NODEID in a value of type {}", type.name),
                 "remove $NODEID, or use an integer type");
  }
}

template <typename T>
void interpret_number(Field<T>& field, std::uint64_t largest, Findings& findings) {
  if (field.text.empty()) {
    return;
  }
  const ParsedInteger number = parse_integer(field.text);
  if (!accept_number(number, field, findings)) {
    return;
  }
  warn_of_octal(number, field, findings);
  if (number.value.is_negative || number.value.magnitude > largest) {
    findings.add(rules::value_range, field.span,
                 fmt::format("{} is not in the range 0 to {}", in_quotes(field.text), largest), "correct the number");
    return;
  }
  field.value = static_cast<T>(number.value.magnitude);
}

template void interpret_number(Field<bool>&, std::uint64_t, Findings&);
template void interpret_number(Field<std::uint8_t>&, std::uint64_t, Findings&);
template void interpret_number(Field<std::uint16_t>&, std::uint64_t, Findings&);
template void interpret_number(Field<std::uint32_t>&, std::uint64_t, Findings&);

void interpret_flag(Field<bool>& field, Findings& findings) {
  const bool is_word = equal_ignoring_case(field.text, "true") || equal_ignoring_case(field.text, "false");
  if (is_word) {
    report_word(field, findings);
    field.value = to_lower(field.text.front()) == 't';
    return;
  }
  interpret_number(field, 1, findings);
}

}  // namespace lexican::codict
