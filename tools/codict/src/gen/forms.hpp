// SPDX-License-Identifier: Apache-2.0
/// \file forms.hpp
/// What a data type, and a place in the communication profile, is in this stack.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/types.hpp"
#include "model/value.hpp"

namespace lexican::codict::gen {

/// A data type as an object type of the stack, and as a variable.
struct Form {
  std::string_view type;       ///< "CO_TUNSIGNED16"; empty: the stack has none
  std::string_view variable;   ///< "uint16_t"; empty: memory of any length
  std::uint16_t code = 0;      ///< of CiA 301
  std::uint8_t size = 0;       ///< bytes of the variable, on every CPU
  std::uint8_t alignment = 0;  ///< of the variable, at most
  std::uint8_t bytes = 0;      ///< on the bus; 0: any number
};

/// Null: no such type.
const Form* form_of(std::uint16_t code);
/// UNSIGNED8, 16, 32 or 64.
const Form& unsigned_form(std::uint8_t bytes);

/// What the stack does with an entry of the communication profile.
enum class Service : std::uint8_t {
  value,     ///< it reads and writes the variable
  fixed,     ///< … which must not lie in the entry
  group,     ///< a parameter group
  consumer,  ///< a heartbeat consumer
};

struct Place {
  std::uint16_t first;
  std::uint16_t last;
  std::uint8_t first_sub;
  std::uint8_t last_sub;
  std::string_view type;  ///< "CO_THB_PROD"
  std::uint8_t bytes;     ///< of the value
  Service service;
  bool node_id_relative;
  std::string_view needs;  ///< macro of co_cfg.h that must not be 0; may be empty
};

/// Null: an object like any other.
const Place* place_of(std::uint16_t index, std::uint8_t sub_index, bool has_subs);

/// A number of C, of the width of a form; what is added for $NODEID is left out.
std::string literal(const Value& value, const Form& form);
std::string literal(const Integer& number, const Form& form);

/// Characters of a UNICODE_STRING.
std::u16string utf16(std::string_view utf8);

}  // namespace lexican::codict::gen
