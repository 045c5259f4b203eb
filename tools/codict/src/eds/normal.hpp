// SPDX-License-Identifier: Apache-2.0
/// \file normal.hpp
/// Values in the words of CiA 306, whichever format they come from.
#pragma once

#include <string>

#include "model/device.hpp"
#include "model/parse.hpp"

namespace lexican::codict::eds {

/// The text of a value: as it is written if that is how CiA 306 writes it, or else what it means.
std::string text_of(const Value& value);

/// 0 or 1; what is neither true nor false stays as it is written.
template <typename T>
std::string flag_text(const Field<T>& flag) {
  return flag.value != T{} ? "1" : flag.is_empty() || is_understood(flag) ? "0" : flag.text;
}

/// The same with all texts of fields as CiA 306 writes them.
Entry normal(const Device& device, const Entry& entry);
/// Without its objects.
Device normal_headers(const Device& device);

}  // namespace lexican::codict::eds
