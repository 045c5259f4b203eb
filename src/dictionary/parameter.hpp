// SPDX-License-Identifier: Apache-2.0
// Definition of the types of parameters: objects that hold one number, which the stack checks and applies.
#pragma once

#include "base/timer.hpp"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "dictionary/types/integer.hpp"

namespace co::integer {

// Functions of a parameter. value: the one that is written; before: the one that it replaces; both as the network sees
// them
struct Parameter {
  // Returns the error of a value, CO_ERR_NONE if it may be written.
  CO_ERR (*may)(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before);
  // Applies a value that was written, also if it is equal to the one before. May be null.
  void (*apply)(CO_NODE& node, CO_OBJ& obj, uint32_t value, uint32_t before);
};

// Checks, stores and applies a value. parameter: null if every value may be written. obj, node, buffer and size: those
// of a type's Write function. Returns CO_ERR_BAD_ARG if size is another than that of the format.
[[nodiscard]] CO_ERR write(CO_OBJ* obj, CO_NODE* node, const void* buffer, uint32_t size, unsigned format,
                           const Parameter* parameter);

template <uint8_t format, decltype(Parameter::may) may, decltype(Parameter::apply) apply>
CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t size) {
  static constexpr Parameter parameter = {may, apply};
  return write(obj, node, buffer, size, format, &parameter);
}

}  // namespace co::integer

namespace co {

// Permissions of parameters: values up to highest; times in units of 1/unit seconds that the timer can count.
template <uint32_t highest>
CO_ERR at_most(CO_NODE&, CO_OBJ&, uint32_t value, uint32_t) {
  return value > highest ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}
template <uint32_t unit>
CO_ERR fits_timer(CO_NODE& node, CO_OBJ&, uint32_t value, uint32_t) {
  return value != 0 && tmr::ticks(node, value, unit) == 0 ? CO_ERR_OBJ_RANGE : CO_ERR_NONE;
}

// Type of a parameter. format: width in bytes (1, 2 or 4) or integer::cob_id; rule: that of the entry
template <uint8_t format, const rules::Rule& rule, decltype(integer::Parameter::may) may,
          decltype(integer::Parameter::apply) apply = nullptr>
inline constexpr CO_OBJ_TYPE parameter = {integer::Number<integer::bytes_of(format)>::size, dict::checked_by<rule>,
                                          integer::Number<format>::read, integer::write<format, may, apply>, nullptr};

}  // namespace co
