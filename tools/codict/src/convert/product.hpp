// SPDX-License-Identifier: Apache-2.0
/// \file product.hpp
/// Whether two descriptions are of one product.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::convert {

/// Empty if the overlay may be of the product that the base describes; else what differs: "vendor number 0x12, the base
/// has 0x13". An overlay that does not describe object 1000h is a part of a description, which may change the numbers.
std::string other_product(const Device& base, const Device& overlay);

}  // namespace lexican::codict::convert
