// SPDX-License-Identifier: Apache-2.0
/// \file concise.hpp
/// Concise DCF of a node: the values that a configuration manager writes by SDO. [CiA 302-3, object 1F22h]
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "network/network.hpp"

namespace lexican::codict::network {

struct Download {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string bytes;  ///< value as SDO transfers it
};

/// Returns a value as SDO transfers it; nothing if its data type has no fixed coding.
std::optional<std::string> sdo_bytes(const Device& device, const Entry& entry, const Value& value,
                                     std::uint8_t node_id);

/// Returns the configured values that can be written, in the order in which a device accepts them: by index, and each
/// PDO is disabled before its parameters and mapping change, and enabled at the end. 1010h and 1011h are left out.
std::vector<Download> downloads_of(const Network& network, std::size_t node, NetworkFindings& findings);

/// Encodes downloads as concise DCF: number of entries in 32 bits; for each entry index, sub-index, length in 32 bits,
/// value; all little-endian.
std::string concise_dcf(const std::vector<Download>& downloads);

}  // namespace lexican::codict::network
