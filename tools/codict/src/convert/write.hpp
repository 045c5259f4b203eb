// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// Writes a device in another format.
#pragma once

#include <string>

#include "convert/losses.hpp"
#include "model/device.hpp"
#include "xdd/write.hpp"

namespace lexican::codict::convert {

/// Returns the text of a device in any format but JSON, for EDS and XDD without configuration. file_name: name to write
/// into the file; empty: unchanged.
std::string write(Device device, Target target, xdd::Edition edition, const std::string& file_name);

}  // namespace lexican::codict::convert
