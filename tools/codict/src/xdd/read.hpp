// SPDX-License-Identifier: Apache-2.0
/// \file read.hpp
/// Reader of XDD, XDC and XPD of CiA 311 1.0 and 1.1, tolerant of deviations from the standard.
#pragma once

#include "model/device.hpp"
#include "text/finding.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

/// Reads a document, and adds a finding for each fault. refusal() checks beforehand whether it is such a description.
/// Frees the elements of the document while it reads them, because elements and model together would need much memory.
Description read(Document& document, Findings& findings);

}  // namespace lexican::codict::xdd
