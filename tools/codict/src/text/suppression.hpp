// SPDX-License-Identifier: Apache-2.0
/// \file suppression.hpp
/// Comments in a description that suppress rules: "codict: ignore RULE… -- reason".
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "text/source.hpp"

namespace lexican::codict {

struct Suppression {
  Span rule;                  ///< the rule's id in the comment
  std::optional<Span> scope;  ///< suppresses findings that begin in it; none if nothing follows the comment
};

/// Returns one suppression for each rule that a comment names; none if the comment has another subject. The format's
/// reader sets the scopes. comment: without its delimiters.
std::vector<Suppression> suppressions_in(const Source& source, Span comment);

}  // namespace lexican::codict
