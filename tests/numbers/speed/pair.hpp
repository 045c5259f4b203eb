// SPDX-License-Identifier: Apache-2.0
/// \file pair.hpp
/// A Lexican SDO client and server, alone on a paced bus. Processing takes no time.
#pragma once

#include <string>

#include "station.hpp"
#include "transfer.hpp"

namespace speed {

/// Properties of the bus and of the nodes' hardware.
struct Hardware {
  std::uint32_t bit_rate;  ///< bit/s
  std::size_t transmit;    ///< number of transmit buffers of each controller
  Time loop{0};            ///< period of the nodes' main loops; 0: a loop runs whenever a frame was received or sent
};

struct Result {
  Time time;           ///< from the request to the end of the last frame
  std::uint64_t bits;  ///< bits on the bus, with the intermissions
};

/// Executes the transfers. Throws std::runtime_error if one fails or transfers wrong data. For segmented transfers the
/// server refuses block transfers, which Lexican's client requests first: this costs two frames that the standard does
/// not require.
Result measure(const Hardware& hardware, const Transfers& transfers);

}  // namespace speed
