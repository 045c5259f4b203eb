// SPDX-License-Identifier: Apache-2.0
/// \file downloads.hpp
/// The configured values of a device (DCF, XDC) as SDO transfers them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict {

struct Download {
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  std::string bytes;                ///< value as SDO transfers it
  std::uint16_t communication = 0;  ///< of a PDO: index of its communication parameter; 0: no part of a PDO
  bool is_intermediate = false;     ///< a later download sets the configured value
};

/// Returns a value as SDO transfers it; nothing if its data type has no fixed coding, or the sum with
/// the node-ID does not fit it.
std::optional<std::string> sdo_bytes(const Device& device, const Entry& entry, const Value& value,
                                     std::uint8_t node_id);

/// Returns the configured values that can be written, in the order in which a device accepts them: by index, and each
/// PDO is disabled before its parameters and mapping change, and enabled at the end. 1010h and 1011h are left out.
/// \a uncoded: called for each value that sdo_bytes() does not code; its PDO is then left out.
std::vector<Download> downloads_of(const Device& device, std::uint8_t node_id,
                                   const std::function<void(std::uint16_t, std::uint8_t, const Entry&)>& uncoded);

}  // namespace lexican::codict
