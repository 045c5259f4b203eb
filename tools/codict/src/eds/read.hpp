// SPDX-License-Identifier: Apache-2.0
/// \file read.hpp
/// EDS and DCF of CiA 306, as the standard has them and as they are found.
#pragma once

#include "eds/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::eds {

/// Everything that a document says; findings get what is off. Whether it is an EDS at all, refusal() says.
Description read(const Document& document, Findings& findings);

}  // namespace lexican::codict::eds
