// SPDX-License-Identifier: Apache-2.0
/// \file ideal.hpp
/// Lower bound of the duration of SDO transfers: only the necessary frames, back to back.
#pragma once

#include "transfer.hpp"

namespace speed {

/// Returns the number of bits on the wire, each frame with its stuff bits and intermission. Blocks have 127 segments,
/// no frame is lost. [301:7.2.4.3]
std::uint64_t ideal_bits(const Transfers& transfers);

}  // namespace speed
