// SPDX-License-Identifier: Apache-2.0
/// \file profile.hpp
/// Checks of objects against device profiles.
#pragma once

#include <cstdint>
#include <vector>

#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::check {

/// Returns the profile number in the lower half of 1000h, 0 if there is none.
std::uint16_t profile_of(const Device& device);

/// Checks the objects of CiA 401 and 402; other profiles have no findings. Of a drive, only the first axis is checked.
void check_profile(const Device& device, std::uint16_t profile, Findings& findings);

namespace rules {
extern const Rule profile_object_missing;
extern const Rule profile_kind;
extern const Rule profile_type;
extern const Rule profile_access;
}  // namespace rules

const std::vector<const Rule*>& profile_rules();

}  // namespace lexican::codict::check
