// SPDX-License-Identifier: Apache-2.0
/// \file layer_setting.hpp
/// Decodes LSS frames in terms of CiA 305.
#pragma once

#include <optional>

#include "trace/decode.hpp"

namespace lexican::trace {

/// Returns the meaning of an LSS frame, nothing for other frames. The bitwise requests of a fastscan are its middle.
std::optional<Meaning> decode_layer_setting(const CO_IF_FRM& frame);

}  // namespace lexican::trace
