// SPDX-License-Identifier: Apache-2.0
/// \file suppressions.hpp
/// What comments of an XML description ask to be passed over.
#pragma once

#include <cstddef>
#include <vector>

#include "text/suppression.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// In front of the root, for the whole file; else for the element that follows, and all that is in it.
std::vector<Suppression> suppressions(const Document& document);

/// Of any kind.
std::size_t number_of_comments(const Document& document);

}  // namespace lexican::codict::xdd
