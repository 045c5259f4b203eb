// SPDX-License-Identifier: Apache-2.0
/// \file suppressions.hpp
/// Comments of an XML description that suppress rules.
#pragma once

#include <cstddef>
#include <vector>

#include "text/suppression.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Finds the suppressions of a document, whose elements must exist. In front of the root, a comment applies to the
/// whole file; else to the next element with its content.
std::vector<Suppression> find_suppressions(const Document& document);

/// Returns the suppressions that were found when the document was parsed.
inline const std::vector<Suppression>& suppressions(const Document& document) { return document.suppressions(); }

/// Returns the number of all comments.
std::size_t number_of_comments(const Document& document);

}  // namespace lexican::codict::xdd
