// SPDX-License-Identifier: Apache-2.0
/// \file product.hpp
/// Comparison of the products that two descriptions identify.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::convert {

/// Returns the difference of the products ("vendor number 0x12, the base has 0x13"), empty if there is none. An overlay
/// without object 1000h is a part of a description, which may change the numbers.
std::string other_product(const Device& base, const Device& overlay);

}  // namespace lexican::codict::convert
