// SPDX-License-Identifier: Apache-2.0
/// \file eds.hpp
/// The device's own EDS in the dictionary: 1021h and 1022h. [301: 7.5.2.24, 7.5.2.25]
#pragma once

#include <cstdint>

#include "gen/plan.hpp"

namespace lexican::codict::gen {

/// Returns the value of 1022h.
std::uint64_t format_of(EmbeddedEds embedded);

/// Adds 1021h and 1022h to a device that does not describe them.
void add_eds_objects(Device& device);

/// Sets the bytes of 1021h to the EDS of a device as described(), compressed if the options say so. \a file_name: name
/// of the EDS in the EDS.
void embed_eds(Device device, const std::string& file_name, const Options& options, Plan& plan);

}  // namespace lexican::codict::gen
