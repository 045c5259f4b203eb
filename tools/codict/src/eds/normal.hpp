// SPDX-License-Identifier: Apache-2.0
/// \file normal.hpp
/// Values in the notation of CiA 306, for devices of any format.
#pragma once

#include <string>

#include "model/device.hpp"
#include "model/parse.hpp"

namespace lexican::codict::eds {

/// Returns the text of a value: the original text if CiA 306 allows it, else its meaning in the notation of CiA 306.
std::string value_text(const Value& value);

/// Returns 0 or 1; the original text if it is not a flag.
template <typename T>
std::string flag_text(const Field<T>& flag) {
  return flag.value != T{} ? "1" : flag.is_empty() || is_understood(flag) ? "0" : flag.text;
}

/// Returns a copy of an entry whose texts are in the notation of CiA 306.
Entry normal(const Device& device, const Entry& entry);
/// Returns a copy of a device whose texts are in the notation of CiA 306, without its objects.
Device normal_headers(const Device& device);

}  // namespace lexican::codict::eds
