// SPDX-License-Identifier: Apache-2.0
/// \file texts.hpp
/// Iteration over all texts of a device.
#pragma once

#include <functional>
#include <string>

#include "model/device.hpp"

namespace lexican::codict::json {

/// Calls `call` for each text, in the order of the schema.
void for_each_text(const Device& device, const std::function<void(const std::string&)>& call);

}  // namespace lexican::codict::json
