// SPDX-License-Identifier: Apache-2.0
/// \file frame_bits.hpp
/// Length of a frame on the wire. [ISO 11898-1]
#ifndef CO_DRIVERS_FRAME_BITS_HPP_
#define CO_DRIVERS_FRAME_BITS_HPP_

#include "co_if_can.h"

namespace co {

/// Recessive bits between two frames.
constexpr unsigned intermission_bits = 3;

/// Returns the number of bits from the start of frame up to and including the end of frame, with the stuff bits of this
/// frame. After them the receivers have the frame; the bus is idle intermission_bits later.
unsigned frame_bits(const CO_IF_FRM& frame);

}  // namespace co

#endif
