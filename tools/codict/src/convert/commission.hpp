// SPDX-License-Identifier: Apache-2.0
/// \file commission.hpp
/// Node-ID, bit rate and name of one node, for its DCF or XDC.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "eds/document.hpp"
#include "model/device.hpp"

namespace lexican::codict::convert {

struct NodeSettings {
  std::optional<std::uint8_t> node_id;
  std::optional<std::uint32_t> bit_rate;  ///< kbit/s; 0: the device detects it
  std::optional<std::string> node_name;   ///< one line

  bool is_any() const { return node_id || bit_rate || node_name; }
};

/// Empty if the name is one line without control characters; else the fault.
std::string fault_of(const NodeSettings& settings);

/// Sets the commissioning of a device.
void commission(const NodeSettings& settings, Device& device);

/// Sets the commissioning in a DCF, all other bytes of which stay. False if its encoding lacks a letter of the name.
bool commission(const NodeSettings& settings, const eds::Document& dcf, std::string& bytes);

}  // namespace lexican::codict::convert
