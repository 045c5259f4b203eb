// SPDX-License-Identifier: Apache-2.0
/// \file layer_setting.hpp
/// LSS frames in the words of CiA 305.
#pragma once

#include <optional>

#include "trace/decode.hpp"

namespace demo::trace {

/// Nothing if it is no LSS frame. What fastscan asks bit by bit is the middle of something long.
std::optional<Meaning> decode_layer_setting(const CO_IF_FRM& frame);

}  // namespace demo::trace
