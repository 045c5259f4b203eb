// SPDX-License-Identifier: Apache-2.0
/// \file links.hpp
/// Links from TPDOs to RPDOs.
#pragma once

#include <cstddef>
#include <vector>

#include "network/network.hpp"

namespace lexican::codict::network {

struct Link {
  std::size_t producer = 0;  ///< index in Links::pdos
  std::size_t consumer = 0;
};

struct Links {
  std::vector<ActivePdo> pdos;
  std::vector<Link> links;          ///< by COB-ID, producer, consumer; at most link_limit
  std::vector<bool> are_connected;  ///< for each element of pdos, whether it has a link
};

constexpr std::size_t link_limit = 100000;

Links links_of(const Network& network);

}  // namespace lexican::codict::network
