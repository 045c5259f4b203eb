// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// Writer of a device as a new EDS or DCF. To change an existing file, edit its Document, which preserves the rest of
/// it.
#pragma once

#include <string>
#include <string_view>

#include "model/device.hpp"

namespace lexican::codict::eds {

struct WriteOptions {
  bool as_dcf = false;  ///< writes the configuration, too: ParameterValue, Denotation, DeviceComissioning
  std::string_view line_end = "\r\n";
};

/// Returns the text in UTF-8: sections in the order of CiA 306, objects by list and index. Omits parts that CiA 306
/// cannot express. A number keeps its original text if CiA 306 allows it.
std::string write(const Device& device, const WriteOptions& options);

}  // namespace lexican::codict::eds
