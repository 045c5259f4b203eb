// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// A device as a fresh EDS or DCF. Whoever changes one that is there edits its Document instead, which keeps the rest.
#pragma once

#include <string>
#include <string_view>

#include "model/device.hpp"

namespace lexican::codict::eds {

struct WriteOptions {
  bool as_dcf = false;  ///< with what is configured: ParameterValue, Denotation, DeviceComissioning
  std::string_view line_end = "\r\n";
};

/// In the order of CiA 306, objects by their lists and indexes, UTF-8. What CiA 306 has no words for is left out;
/// numbers stay as the description wrote them where that is a number of CiA 306.
std::string write(const Device& device, const WriteOptions& options);

}  // namespace lexican::codict::eds
