// SPDX-License-Identifier: Apache-2.0
/// \file document.hpp
/// JSON as a tree of values that know their places. Depth and number of the values are bounded.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/encoding.hpp"
#include "text/number.hpp"
#include "text/source.hpp"

namespace lexican::codict::json {

enum class Kind : unsigned char { null, boolean, integer, real, string, array, object };

std::string_view name_of(Kind kind);  ///< "a string"

struct Node {
  Kind kind = Kind::null;
  bool boolean = false;
  Integer integer;
  double real = 0;  ///< of an integer, too
  std::string text;
  Span span;              ///< of a string without its quotes, of arrays and objects the bracket that opens
  std::uint32_t end = 0;  ///< of arrays and objects, behind the bracket that closes
  std::string name;
  Span name_span;
  std::vector<Node> children;

  /// The first member of a name; null if there is none.
  const Node* find(std::string_view member) const;
};

class Document {
 public:
  static constexpr std::size_t most_levels = 200;
  static constexpr std::size_t most_values = 1000000;

  /// Takes any bytes.
  explicit Document(Source source);

  const Source& source() const { return source_; }
  Encoding encoding() const { return Encoding::utf8; }
  const Node& root() const { return root_; }
  const std::string& fault() const { return fault_; }  ///< empty if all of it is JSON; else one line

 private:
  Source source_;
  Node root_;
  std::string fault_;
};

/// Two blanks for each level; what has no arrays and objects in it is one line.
std::string print(const Node& node);

}  // namespace lexican::codict::json
