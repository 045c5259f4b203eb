// SPDX-License-Identifier: Apache-2.0
/// \file document.hpp
/// JSON as a tree of values with their positions in the source. Limits the depth and the number of values.
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

std::string_view name_of(Kind kind);  ///< for messages: "a string"

struct Node {
  Kind kind = Kind::null;
  bool boolean = false;
  Integer integer;
  double real = 0;  ///< also set for an integer
  std::string text;
  Span span;              ///< of a string: without its quotes; of an array or object: its opening bracket
  std::uint32_t end = 0;  ///< of an array or object: offset behind its closing bracket
  std::string name;
  Span name_span;
  std::vector<Node> children;

  /// Returns the first member with a name; null if there is none.
  const Node* find(std::string_view member) const;
};

class Document {
 public:
  static constexpr std::size_t most_levels = 200;
  static constexpr std::size_t most_values = 1000000;

  /// Parses any bytes; fault() returns whether they are JSON.
  explicit Document(Source source);

  const Source& source() const { return source_; }
  Encoding encoding() const { return Encoding::utf8; }
  const Node& root() const { return root_; }
  const std::string& fault() const { return fault_; }  ///< one line; empty if the whole text is JSON

 private:
  Source source_;
  Node root_;
  std::string fault_;
};

/// Returns JSON text, indented by two blanks per level. A value without arrays and objects in it is written in one
/// line.
std::string print(const Node& node);

}  // namespace lexican::codict::json
