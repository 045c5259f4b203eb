// SPDX-License-Identifier: Apache-2.0
/// \file parse.hpp
/// Interpretation of the text of a value according to its data type, equal for all formats.
#pragma once

#include <cstdint>
#include <vector>

#include "model/rare.hpp"
#include "model/types.hpp"
#include "model/value.hpp"
#include "text/finding.hpp"

namespace lexican::codict {

/// Sets kind and value from the text, which a reader has set. Reports each fault of the text as a finding.
void interpret(Value& value, const DataType& type, Findings& findings);
inline void interpret(Rare<Value>& value, const DataType& type, Findings& findings) {
  if (Value* const given = value.if_any()) {
    interpret(*given, type, findings);
  }
}

/// Sets the value of a field from its text, which a reader has set. Reports a text that is not a number, or a number
/// above `largest`, and leaves field.value unchanged then.
template <typename T>
void interpret_number(Field<T>& field, std::uint64_t largest, Findings& findings);
template <typename T>
void interpret_number(Rare<Field<T>>& field, std::uint64_t largest, Findings& findings) {
  if (Field<T>* const given = field.if_any()) {
    interpret_number(*given, largest, findings);
  }
}

/// Sets a flag from its text: 0 or 1 in any notation of a number, or true and false (reported).
void interpret_flag(Field<bool>& field, Findings& findings);

/// Returns whether the value of a number, flag or the like is the meaning of its text, and not the 0 of a malformed
/// text. Writers write a malformed text unchanged.
template <typename T>
bool is_understood(const Field<T>& field) {
  const ParsedInteger written = parse_integer(field.text);
  return field.value != T{} || (written.is_meant() && written.value == 0U);
}

namespace rules {
extern const Rule value_number;
extern const Rule value_octal_digit;
extern const Rule value_suffix;
extern const Rule value_comment;
extern const Rule value_fraction;
extern const Rule value_word;
extern const Rule value_octal;
extern const Rule value_range;
extern const Rule value_bit_pattern;
extern const Rule value_node_id_form;
extern const Rule value_node_id_type;
extern const Rule value_real_bits;
extern const Rule value_real_integer;
extern const Rule value_decimal_comma;
extern const Rule value_octets;
extern const Rule value_time;
extern const Rule value_quotes;
}  // namespace rules

/// Returns the rules that this file reports.
const std::vector<const Rule*>& value_rules();

}  // namespace lexican::codict
