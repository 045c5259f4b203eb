// SPDX-License-Identifier: Apache-2.0
/// \file ideal.hpp
/// What physics allows: the frames that a transfer cannot do without, one after the other without a gap.
#pragma once

#include "transfer.hpp"

namespace speed {

/// Bits on the wire, each frame with its own stuff bits and its intermission. Blocks have 127 segments, no frame is
/// lost. [301:7.2.4.3]
std::uint64_t ideal_bits(const Transfers& transfers);

}  // namespace speed
