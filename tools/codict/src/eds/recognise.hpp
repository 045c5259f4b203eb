// SPDX-License-Identifier: Apache-2.0
/// \file recognise.hpp
/// Recognition of EDS and DCF by their contents. The file name extension is ambiguous: other networks use it, too.
#pragma once

#include <string>

#include "eds/document.hpp"
#include "text/source.hpp"

namespace lexican::codict::eds {

/// Returns an empty text if the bytes may be an EDS or DCF; else a message that says what they are.
std::string refusal(const Source& source);
/// Returns an empty text if the sections are those of an EDS or DCF; else a message that says what the file is.
std::string refusal(const Document& document);

}  // namespace lexican::codict::eds
