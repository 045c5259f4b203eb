// SPDX-License-Identifier: Apache-2.0
/// \file losses.hpp
/// What a device says that another format has no words for.
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
  json,  ///< has words for everything
};

struct Loss {
  std::string_view what;            ///< "descriptions"
  std::vector<std::string> places;  ///< "2000h:1 en", one for each; empty where it has none
};

/// Those that there are. What is written is the first device, but for JSON.
std::vector<Loss> losses(const Description& description, Target target);

/// The same without what is configured: an EDS or XDD describes all devices of a kind.
Device without_configuration(Device device);

}  // namespace lexican::codict::convert
