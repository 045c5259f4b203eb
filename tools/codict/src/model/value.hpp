// SPDX-License-Identifier: Apache-2.0
/// \file value.hpp
/// What a description says at one place: as it is written, as it is meant, and where.
#pragma once

#include <cstdint>
#include <string>

#include "text/number.hpp"
#include "text/source.hpp"

namespace lexican::codict {

/// UTF-8, without the blanks at its ends. What is not given has no place.
struct Text {
  std::string text;
  Span span;              ///< of the text in the source
  bool is_given = false;  ///< the source says it, even if with nothing ("DefaultValue=")

  bool is_empty() const { return text.empty(); }
};

/// With a meaning. `value` is what holds, also where nothing is given and a standard says what that means.
template <typename T>
struct Field : Text {
  T value{};
};

/// DefaultValue, ParameterValue, LowLimit, and so on: its meaning depends on the data type of its object.
struct Value : Text {
  enum class Kind : unsigned char {
    none,       ///< nothing is given, or nothing stands there (in a description of CANopenNode: no memory for it)
    integer,    ///< integer; also BOOLEAN
    real,       ///< real
    text,       ///< text: VISIBLE_STRING, UNICODE_STRING, and types that have no known form
    octets,     ///< octets: OCTET_STRING, DOMAIN
    malformed,  ///< text, which is no value of the type
  };

  Kind kind = Kind::none;
  bool adds_node_id = false;  ///< of an integer: $NODEID + integer
  Integer integer;
  double real = 0;
  std::string octets;

  bool is_integer() const { return kind == Kind::integer; }
  /// Of an integer, as CiA 306 writes it: "$NODEID+0x180", "-5".
  std::string written_integer() const;
  /// With a node-ID put in.
  Integer integer_for(std::uint8_t node_id) const;
};

}  // namespace lexican::codict
