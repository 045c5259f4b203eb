// SPDX-License-Identifier: Apache-2.0
/// \file doc.hpp
/// A device's documentation for people, from its description.
#pragma once

#include <cstdint>
#include <string>

#include "model/device.hpp"

namespace lexican::codict::doc {

struct Options {
  std::string language = "en";  ///< of labels and descriptions, where the description has several
  std::uint8_t node_id = 1;     ///< with which COB-IDs are shown
};

/// One Markdown document (CommonMark with tables).
std::string markdown(const Device& device, const Options& options);

/// One HTML page which needs nothing else: styles, pictures and search are in it.
std::string html(const Device& device, const Options& options);

}  // namespace lexican::codict::doc
