// SPDX-License-Identifier: Apache-2.0
/// \file parse.hpp
/// What the text of a value means for a data type, which is the same in all formats.
#pragma once

#include <cstdint>
#include <vector>

#include "model/types.hpp"
#include "model/value.hpp"
#include "text/finding.hpp"

namespace lexican::codict {

/// Gives the text of a value, which a reader has set, its meaning. Every doubt is a finding.
/// width: bits of the type, where the type does not say it itself.
void interpret(Value& value, const DataType& type, Findings& findings);

/// The number of a field whose text a reader has set. What is none, or larger than `largest`, is a finding and leaves
/// what field.value was.
template <typename T>
void interpret_number(Field<T>& field, std::uint64_t largest, Findings& findings);

/// 0 or 1, in any way that numbers are written, or true and false.
void interpret_flag(Field<bool>& field, Findings& findings);

/// Whether a number, a flag or the like is what its text says: not the 0 of a text that is none. Writers leave other
/// texts as they are.
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

/// All rules of this room.
const std::vector<const Rule*>& value_rules();

}  // namespace lexican::codict
