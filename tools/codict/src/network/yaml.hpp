// SPDX-License-Identifier: Apache-2.0
/// \file yaml.hpp
/// A YAML document as a tree with places. What could make a small file large (anchors, aliases, tags) is refused, and
/// so are files that are too large or too deep: a plan of a network needs none of them.
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
  std::string text;         ///< of a scalar
  Span span;                ///< where it begins; of a scalar, all of it on its first line
  std::vector<Node> items;  ///< of a sequence; of a map: name, value, name, value …

  std::size_t members() const { return kind == Kind::map ? items.size() / 2 : 0; }
  const Node& name(std::size_t member) const { return items[2 * member]; }
  const Node& value(std::size_t member) const { return items[2 * member + 1]; }
};

constexpr std::size_t size_limit = std::size_t{1024} * 1024;  ///< in bytes
constexpr std::size_t depth_limit = 16;
constexpr std::size_t node_limit = 100000;

/// "a map", "a list", "nothing", "text"
std::string_view name_of(Node::Kind kind);

/// Returns false, with one finding that says why, if the source is not one such document. Names of a map are scalars,
/// each once.
bool read(const Source& source, Node& root, Findings& findings);

}  // namespace lexican::codict::network::yaml
