// SPDX-License-Identifier: Apache-2.0
/// \file xdd_dump.hpp
/// Text of a device for comparison: all values, without their places in the source.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict {

std::string dump(const Device& device);

}  // namespace lexican::codict
