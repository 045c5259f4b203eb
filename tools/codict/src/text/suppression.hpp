// SPDX-License-Identifier: Apache-2.0
/// \file suppression.hpp
/// Comments in a description that ask for a rule to be passed over: "codict: ignore RULE… -- reason".
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "text/source.hpp"

namespace lexican::codict {

struct Suppression {
  Span rule;                  ///< its id, in the comment
  std::optional<Span> scope;  ///< findings that begin in it are meant; none if nothing follows the comment
};

/// One for each rule that a comment names; none if it is about something else. The scope is up to the format.
/// comment: without the signs around it.
std::vector<Suppression> suppressions_in(const Source& source, Span comment);

}  // namespace lexican::codict
