// SPDX-License-Identifier: Apache-2.0
/// \file suppressions.hpp
/// Comments of an XML description that suppress rules.
#pragma once

#include <cstddef>
#include <vector>

#include "text/suppression.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Returns the suppressions of a document. In front of the root, a comment applies to the whole file; else to the next
/// element with its content.
std::vector<Suppression> suppressions(const Document& document);

/// Returns the number of all comments.
std::size_t number_of_comments(const Document& document);

}  // namespace lexican::codict::xdd
