// SPDX-License-Identifier: Apache-2.0
/// \file yaml.hpp
/// Reader of YAML documents as trees with places. Features that can expand a small file to a large tree (anchors,
/// aliases, tags) are rejected, and so are files that are too large or too deeply nested: a plan needs none of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::network::yaml {

struct Node {
  enum class Kind : unsigned char { null, scalar, sequence, map };

  Kind kind = Kind::null;
  bool is_quoted = false;
  std::string text;         ///< text of a scalar
  Span span;                ///< place of its begin; of a scalar, all of it on its first line
  std::vector<Node> items;  ///< elements of a sequence; of a map: name, value, name, value …

  std::size_t members() const { return kind == Kind::map ? items.size() / 2 : 0; }
  const Node& name(std::size_t member) const { return items[2 * member]; }
  const Node& value(std::size_t member) const { return items[2 * member + 1]; }
};

constexpr std::size_t size_limit = std::size_t{1024} * 1024;  ///< in bytes
constexpr std::size_t depth_limit = 16;
constexpr std::size_t node_limit = 100000;

/// Returns "a map", "a list", "nothing" or "text".
std::string_view name_of(Node::Kind kind);

/// Reads one document. Returns false, with one finding, if the source is malformed or contains several documents. Names
/// in a map are unique scalars.
bool read(const Source& source, Node& root, Findings& findings);

}  // namespace lexican::codict::network::yaml
