// SPDX-License-Identifier: Apache-2.0
/// \file traffic.hpp
/// Traffic of a network in normal operation: bus load and response times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "network/frame.hpp"
#include "network/links.hpp"
#include "network/network.hpp"
#include "network/response.hpp"

namespace lexican::codict::network {

/// Frames with one identifier and service.
struct Message {
  std::string service;   ///< "TPDO 1", "SYNC", "heartbeat"
  std::size_t node = 0;  ///< index of the transmitting node
  Frame frame;
  unsigned longest = 0;             ///< largest length in bits
  double mean = 0;                  ///< mean length in bits
  Nanoseconds shortest_period = 0;  ///< 0: unknown
  Nanoseconds usual_period = 0;     ///< 0: transmitted on events only
  Nanoseconds deadline = 0;         ///< 0: none
  std::optional<Nanoseconds> response;

  double worst_load(std::uint32_t bit_rate) const;  ///< Returns the bus load in percent; bit_rate in kbit/s.
  double average_load(std::uint32_t bit_rate) const;
};

struct Traffic {
  std::uint32_t bit_rate = 0;     ///< in kbit/s
  std::vector<Message> messages;  ///< by priority
  double worst_load = 0;          ///< in percent
  double average_load = 0;
};

/// Returns the traffic of a network, without response times and loads if its bit rate is unknown. Frames of SDO, NMT,
/// TIME and, without inhibit time, EMCY have no period: they only block others.
Traffic traffic_of(const Network& network, const Links& links, NetworkFindings& findings);

}  // namespace lexican::codict::network
