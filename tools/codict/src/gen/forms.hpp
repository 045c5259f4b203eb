// SPDX-License-Identifier: Apache-2.0
/// \file forms.hpp
/// Object types of the stack for data types and for objects of the communication profile.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/types.hpp"
#include "model/value.hpp"

namespace lexican::codict::gen {

/// Object type of the stack and C variable for a data type.
struct Form {
  std::string_view type;       ///< "CO_TUNSIGNED16"; empty: the stack has no such type
  std::string_view variable;   ///< "uint16_t"; empty: memory of any length
  std::uint16_t code = 0;      ///< data type code of CiA 301
  std::uint8_t size = 0;       ///< size of the variable in bytes, on every CPU
  std::uint8_t alignment = 0;  ///< largest alignment of the variable on any CPU
  std::uint8_t bytes = 0;      ///< length in bytes on the bus; 0: variable
};

/// Returns the form of a data type code, null if the code is unknown.
const Form* form_of(std::uint16_t code);
/// Returns the form of UNSIGNED8, 16, 32 or 64.
const Form& unsigned_form(std::uint8_t bytes);

/// Use of an entry of the communication profile by the stack.
enum class Service : std::uint8_t {
  value,     ///< the stack reads and writes the variable
  fixed,     ///< like value, but the value must not be stored in the entry (flag D)
  group,     ///< the entry is a parameter group (CO_PARA)
  consumer,  ///< the entry is a heartbeat consumer (CO_HBCONS)
  eds,       ///< the entry is the device's own EDS (CO_OBJ_DOM_RO)
  shared,    ///< the entries of an object are a structure of the application (CO_OS_COMMAND, CO_OS_PROMPT,
             ///< CO_MODULE_LIST)
  none,      ///< not generated from a description
};

/// Entries of the communication profile that a service of the stack uses in one way.
struct Place {
  std::uint16_t first;
  std::uint16_t last;
  std::uint8_t first_sub;
  std::uint8_t last_sub;
  std::string_view type;  ///< "CO_THB_PROD"
  std::uint8_t bytes;     ///< length of the value in bytes; 0: OCTET_STRING or DOMAIN
  Service service;
  std::string_view flags;  ///< N: $NODEID is allowed; T: of RPDOs, and 400h higher of TPDOs
  std::string_view needs;  ///< setting of co_cfg.h that must not be 0; not only names with USE_

  bool is_node_id_relative() const { return flags.find('N') != std::string_view::npos; }
  bool contains(std::uint16_t index, std::uint8_t sub_index) const;
};

/// Returns the place of an entry in the communication profile, null for objects that no service uses.
const Place* place_of(std::uint16_t index, std::uint8_t sub_index, bool has_subs);

/// Returns a number as a C literal of the width of a form; the node-ID of $NODEID is not added.
std::string literal(const Value& value, const Form& form);
std::string literal(const Integer& number, const Form& form);

/// Converts UTF-8 to the characters of a UNICODE_STRING.
std::u16string utf16(std::string_view utf8);

}  // namespace lexican::codict::gen
