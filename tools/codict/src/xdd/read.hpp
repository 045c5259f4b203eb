// SPDX-License-Identifier: Apache-2.0
/// \file read.hpp
/// XDD, XDC and XPD of CiA 311, 1.0 and 1.1, as the standard has them and as they are found.
#pragma once

#include "model/device.hpp"
#include "text/finding.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Everything that a document says; findings get what is off. Whether it is such a description at all, refusal() says.
Description read(const Document& document, Findings& findings);

}  // namespace lexican::codict::xdd
