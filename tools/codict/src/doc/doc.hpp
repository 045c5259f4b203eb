// SPDX-License-Identifier: Apache-2.0
/// \file doc.hpp
/// Writes the documentation of a device from its description.
#pragma once

#include <cstdint>
#include <string>

#include "model/device.hpp"

namespace lexican::codict::doc {

struct Options {
  std::string language = "en";  ///< language of labels and descriptions, if the description has several
  std::uint8_t node_id = 1;     ///< node-ID for which COB-IDs are shown
};

/// Returns one Markdown document (CommonMark with tables).
std::string markdown(const Device& device, const Options& options);

/// Returns one self-contained HTML page with styles, pictures and search.
std::string html(const Device& device, const Options& options);

}  // namespace lexican::codict::doc
