// SPDX-License-Identifier: Apache-2.0
/// \file format.hpp
/// The normal form of an EDS or DCF.
#pragma once

#include <string>

#include "eds/document.hpp"

namespace lexican::codict::eds {

/// Returns the normal form of a document, which describes the same device and has all comments: sections in the order
/// of CiA 306, separated by one empty line, names and numbers in the notation of the standard, correct counts. Comments
/// stay in front of their section or key; an empty line separates those above the first section from it. Line ends and
/// encoding are those of the source. Idempotent.
std::string formatted(const Document& document);

}  // namespace lexican::codict::eds
