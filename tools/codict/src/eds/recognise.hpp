// SPDX-License-Identifier: Apache-2.0
/// \file recognise.hpp
/// Whether a file is an EDS or DCF at all. Its ending says nothing: others use the same.
#pragma once

#include <string>

#include "eds/document.hpp"
#include "text/source.hpp"

namespace lexican::codict::eds {

/// Empty if the bytes may be an EDS or DCF; else what they are instead, as far as that shows before they are read.
std::string refusal(const Source& source);
/// The same for what its sections show.
std::string refusal(const Document& document);

}  // namespace lexican::codict::eds
