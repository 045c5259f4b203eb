// SPDX-License-Identifier: Apache-2.0
/// \file pair.hpp
/// An SDO client and an SDO server, both ours, alone on a paced bus. Processing takes no time.
#pragma once

#include <string>

#include "station.hpp"
#include "transfer.hpp"

namespace speed {

/// The hardware around both nodes.
struct Hardware {
  std::uint32_t bit_rate;  ///< bit/s
  std::size_t transmit;    ///< buffers of the controllers
  Time loop{0};            ///< the loops of the nodes come round so often; 0: whenever something was received or sent
};

struct Result {
  Time time;           ///< from the request to the end of the last frame
  std::uint64_t bits;  ///< that were on the bus, with the intermissions
};

/// Carries the transfers out. A transfer that fails or carries wrong data throws std::runtime_error. For segments the
/// server refuses block transfers, which our client asks for first: two frames that the standard does not need.
Result measure(const Hardware& hardware, const Transfers& transfers);

}  // namespace speed
