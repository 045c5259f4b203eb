// SPDX-License-Identifier: Apache-2.0
/// \file concise.hpp
/// Concise DCF of a node: the values that a configuration manager writes by SDO. [CiA 302-3, object 1F22h]
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "model/downloads.hpp"
#include "network/network.hpp"

namespace lexican::codict::network {

/// Returns the configured values of a node, as codict::downloads_of() does, and reports those without coding.
std::vector<Download> downloads_of(const Network& network, std::size_t at, NetworkFindings& findings);

/// Encodes downloads as concise DCF: number of entries in 32 bits; for each entry index, sub-index, length in 32 bits,
/// value; all little-endian.
std::string concise_dcf(const std::vector<Download>& downloads);

}  // namespace lexican::codict::network
