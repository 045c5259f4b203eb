// SPDX-License-Identifier: Apache-2.0
/// \file texts.hpp
/// The texts of a device, wherever in it they are.
#pragma once

#include <functional>
#include <string>

#include "model/device.hpp"

namespace lexican::codict::json {

/// In the order of the schema.
void for_each_text(const Device& device, const std::function<void(const std::string&)>& call);

}  // namespace lexican::codict::json
