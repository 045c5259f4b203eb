// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// Writer of a description as JSON, schema codict-device-1: the whole model except the positions in its source, in a
/// constant order.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::json {

std::string write(const Description& description);

}  // namespace lexican::codict::json
