// SPDX-License-Identifier: Apache-2.0
/// \file normal.hpp
/// Values in the words of CiA 306, whichever format they come from.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::eds {

/// The text of a value: as it is written if that is how CiA 306 writes it, or else what it means.
std::string text_of(const Value& value);

/// The same with all texts of fields as CiA 306 writes them.
Entry normal(const Device& device, const Entry& entry);
/// Without its objects.
Device normal_headers(const Device& device);

}  // namespace lexican::codict::eds
