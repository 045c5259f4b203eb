// SPDX-License-Identifier: Apache-2.0
/// \file profile.hpp
/// Descriptions of new devices from device profiles.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lexican::codict::project {

/// Returns an EDS with the mandatory objects of a profile, 301, 401 or 402, and one RPDO and one TPDO. name: product
/// name. file_name: value of FileName.
std::string profile_eds(std::uint16_t profile, std::string_view name, std::string_view file_name);

}  // namespace lexican::codict::project
