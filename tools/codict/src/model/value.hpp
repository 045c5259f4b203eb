// SPDX-License-Identifier: Apache-2.0
/// \file value.hpp
/// Values of a description: the text, its meaning, and its place in the source.
#pragma once

#include <cstdint>
#include <string>

#include "model/rare.hpp"
#include "text/number.hpp"
#include "text/source.hpp"

namespace lexican::codict {

/// A text in UTF-8, without leading and trailing blanks. Its span is empty if it is not given.
struct Text {
  std::string text;
  Span span;              ///< of the text in the source
  bool is_given = false;  ///< present in the source, even if empty ("DefaultValue=")

  bool is_empty() const { return text.empty(); }
};

/// A text with its meaning. If the text is not given, `value` is the default of the standard.
template <typename T>
struct Field : Text {
  T value{};
};

/// The text of DefaultValue, ParameterValue, LowLimit and others. Its meaning depends on the data type of the object.
struct Value : Text {
  enum class Kind : unsigned char {
    none,       ///< not given, or empty (in a description of CANopenNode: no memory for it)
    integer,    ///< `integer`; also for BOOLEAN
    real,       ///< `real`
    text,       ///< `text`: VISIBLE_STRING, UNICODE_STRING, and types of unknown form
    octets,     ///< `octets`: OCTET_STRING, DOMAIN
    malformed,  ///< `text`, which is not a value of the type
  };

  Kind kind = Kind::none;
  bool adds_node_id = false;  ///< the value is $NODEID + integer
  Integer integer;
  double real = 0;
  Rare<std::string> octets;

  bool is_integer() const { return kind == Kind::integer; }
  /// Returns the integer as CiA 306 writes it: "$NODEID+0x180", "-5".
  std::string written_integer() const;
  /// Returns the integer for a node-ID, which is added if adds_node_id is set.
  Integer integer_for(std::uint8_t node_id) const;
};

}  // namespace lexican::codict
