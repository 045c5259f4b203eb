// SPDX-License-Identifier: Apache-2.0
/// \file commission.hpp
/// Sets node-ID, bit rate and name of a node in its DCF or XDC.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "eds/document.hpp"
#include "model/device.hpp"

namespace lexican::codict::convert {

struct NodeSettings {
  std::optional<std::uint8_t> node_id;
  std::optional<std::uint32_t> bit_rate;  ///< in kbit/s; 0: automatic detection
  std::optional<std::string> node_name;   ///< one line of text

  bool is_any() const { return node_id || bit_rate || node_name; }
};

/// Returns the fault of the node's name, empty if the name is one line without control characters.
std::string fault_of(const NodeSettings& settings);

/// Sets the commissioning of a device.
void commission(const NodeSettings& settings, Device& device);

/// Sets the commissioning in a DCF without changing other bytes. Returns false if its encoding lacks a character of the
/// name.
bool commission(const NodeSettings& settings, const eds::Document& dcf, std::string& bytes);

}  // namespace lexican::codict::convert
