// SPDX-License-Identifier: Apache-2.0
/// \file response.hpp
/// Worst-case response times of CAN frames on a bus without errors: the exact analysis of R. I. Davis, A. Burns,
/// R. J. Bril, J. J. Lukkien, "Controller Area Network (CAN) schedulability analysis: Refuted, revisited and revised",
/// Real-Time Systems 35 (2007), section 3.2.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace lexican::codict::network {

using Nanoseconds = std::int64_t;

/// Stream of frames. Vectors of streams are sorted by priority, highest first.
struct Stream {
  Nanoseconds transmission = 0;  ///< C: longest time on the bus
  Nanoseconds period = 0;        ///< T: shortest time between two frames; 0: unknown, the stream can only block others
  Nanoseconds jitter = 0;        ///< J: queuing jitter
};

/// Returns the worst-case response time of each stream: from the event until the frame has been received. Streams are
/// sorted by priority, highest first. Nothing is returned for streams without a period, and where frames of higher
/// or the same priority take the whole bus. bit_time: that of the bus, in nanoseconds.
std::vector<std::optional<Nanoseconds>> response_times(const std::vector<Stream>& streams, Nanoseconds bit_time);

}  // namespace lexican::codict::network
