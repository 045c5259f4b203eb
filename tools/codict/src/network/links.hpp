// SPDX-License-Identifier: Apache-2.0
/// \file links.hpp
/// Which TPDO reaches which RPDO.
#pragma once

#include <cstddef>
#include <vector>

#include "network/network.hpp"

namespace lexican::codict::network {

struct Link {
  std::size_t producer = 0;  ///< in Links::pdos
  std::size_t consumer = 0;
};

struct Links {
  std::vector<ActivePdo> pdos;
  std::vector<Link> links;          ///< by COB-ID, producer, consumer; at most link_limit
  std::vector<bool> are_connected;  ///< of pdos
};

constexpr std::size_t link_limit = 100000;

Links links_of(const Network& network);

}  // namespace lexican::codict::network
