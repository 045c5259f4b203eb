// SPDX-License-Identifier: Apache-2.0
/// \file frame_bits.hpp
/// How long a frame takes on the wire. [ISO 11898-1]
#ifndef CO_DRIVERS_FRAME_BITS_HPP_
#define CO_DRIVERS_FRAME_BITS_HPP_

#include "co_if_can.h"

namespace co {

/// Bits between two frames, in which nobody sends.
constexpr unsigned intermission_bits = 3;

/// Bits from the start of frame up to and including the end of frame, with all stuff bits of exactly this frame. Its
/// receivers have it then; the bus is free intermission_bits later.
unsigned frame_bits(const CO_IF_FRM& frame);

}  // namespace co

#endif
