// SPDX-License-Identifier: Apache-2.0
/// \file format.hpp
/// The normal form of an EDS or DCF.
#pragma once

#include <string>

#include "eds/document.hpp"

namespace lexican::codict::eds {

/// The same device and all comments: sections in the order of CiA 306, one empty line between them, names and numbers
/// as the standard writes them, counts that are right. Comments stay with the section, or the key, in front of which
/// they stand; line ends and encoding are those of the source. The normal form of it is itself.
std::string formatted(const Document& document);

}  // namespace lexican::codict::eds
