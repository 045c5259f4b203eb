// SPDX-License-Identifier: Apache-2.0
/// \file xdd_dump.hpp
/// All that a device means as lines of text, to be compared: without the places where it is said.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict {

std::string dump(const Device& device);

}  // namespace lexican::codict
