// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// A device in another format.
#pragma once

#include <string>

#include "convert/losses.hpp"
#include "model/device.hpp"
#include "xdd/write.hpp"

namespace lexican::codict::convert {

/// The text of a device in any format but JSON; of an EDS or XDD, without what is configured. The file name in it is
/// file_name, or stays if that is empty.
std::string write(Device device, Target target, xdd::Edition edition, const std::string& file_name);

}  // namespace lexican::codict::convert
