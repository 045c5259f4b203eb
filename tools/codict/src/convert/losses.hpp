// SPDX-License-Identifier: Apache-2.0
/// \file losses.hpp
/// Losses of a conversion: data that the other format cannot express.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/device.hpp"

namespace lexican::codict::convert {

enum class Target : unsigned char {
  eds,
  dcf,
  xdd,
  xdc,
  json,  ///< can express everything
};

struct Loss {
  std::string_view what;            ///< kind of the lost data: "descriptions"
  std::vector<std::string> places;  ///< "2000h:1 en", one for each loss; empty for data without a place
  bool is_minor = false;            ///< not counted by --strict-loss
};

/// Returns the losses of a conversion. All formats but JSON contain the first device only.
std::vector<Loss> losses(const Description& description, Target target);

/// Returns the device without its configuration, as EDS and XDD describe all devices of a type.
Device without_configuration(Device device);

}  // namespace lexican::codict::convert
