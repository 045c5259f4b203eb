// SPDX-License-Identifier: Apache-2.0
/// \file rate.hpp
/// Finds the bit rate of a bus by listening: nothing is sent, and nothing is acknowledged.
#pragma once

#include "bus/bus.hpp"
#include "host/interruption.hpp"

namespace lexican::program {

struct HeardRate {
  std::uint32_t bit_rate = 0;  ///< bit/s; 0: no frame was received at any rate
  unsigned frames = 0;         ///< valid frames at this rate
  host_bus::Micros time = 0;   ///< µs of listening at this rate
  bool is_refused = false;     ///< the adapter has refused a command, such as L
};

/// Listens at each bit rate in turn, until a valid frame is received. Each further round listens three times as long.
/// \a bus: an adapter, see Bus::configure(). \a options: the mode; the rates are set in turn. \a time: µs at each
/// rate in the first round. Ends early when the user interrupts the program.
HeardRate listen_for_rate(host_bus::Bus& bus, host_bus::BusOptions options, host_bus::Micros time, unsigned rounds,
                          const Interruption& interruption);

}  // namespace lexican::program
