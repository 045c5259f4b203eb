// SPDX-License-Identifier: Apache-2.0
/// \file read.hpp
/// Reader of EDS and DCF of CiA 306, tolerant of deviations from the standard.
#pragma once

#include "eds/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::eds {

/// Reads a document, and adds a finding for each fault. refusal() checks beforehand whether it is an EDS or DCF at all.
Description read(const Document& document, Findings& findings);

}  // namespace lexican::codict::eds
