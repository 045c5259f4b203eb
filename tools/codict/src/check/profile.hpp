// SPDX-License-Identifier: Apache-2.0
/// \file profile.hpp
/// Objects of device profiles, against what everybody who knows the profile takes for granted.
#pragma once

#include <cstdint>
#include <vector>

#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::check {

/// The number in the lower half of object 1000h; 0 where there is none.
std::uint16_t profile_of(const Device& device);

/// Of a profile that is not known (401 and 402 are), nothing is found. Of a drive, the first axis is looked at.
void check_profile(const Device& device, std::uint16_t profile, Findings& findings);

namespace rules {
extern const Rule profile_object_missing;
extern const Rule profile_kind;
extern const Rule profile_type;
extern const Rule profile_access;
}  // namespace rules

const std::vector<const Rule*>& profile_rules();

}  // namespace lexican::codict::check
