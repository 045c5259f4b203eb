// SPDX-License-Identifier: Apache-2.0
/// \file write.hpp
/// A description as JSON, schema codict-device-1: all of the model but the places in its source, in an order that
/// stays.
#pragma once

#include <string>

#include "model/device.hpp"

namespace lexican::codict::json {

std::string write(const Description& description);

}  // namespace lexican::codict::json
