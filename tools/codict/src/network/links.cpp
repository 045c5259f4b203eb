// SPDX-License-Identifier: Apache-2.0
#include "network/links.hpp"

#include <cstdint>
#include <map>

namespace lexican::codict::network {

namespace {

// Adds the links from one TPDO to all RPDOs with its COB-ID.
void add_links(std::size_t producer, const std::vector<std::size_t>& pdos, Links& result) {
  for (const std::size_t consumer : pdos) {
    if (result.links.size() == link_limit) {
      return;
    }
    const ActivePdo& to = result.pdos[consumer];
    if (!to.pdo.is_transmit && to.node != result.pdos[producer].node) {
      result.links.push_back({producer, consumer});
      result.are_connected[producer] = true;
      result.are_connected[consumer] = true;
    }
  }
}

}  // namespace

Links links_of(const Network& network) {
  Links result;
  result.pdos = active_pdos(network);
  result.are_connected.resize(result.pdos.size());
  std::map<std::uint64_t, std::vector<std::size_t>> by_cob_id;
  for (std::size_t n = 0; n < result.pdos.size(); ++n) {
    by_cob_id[result.pdos[n].key()].push_back(n);
  }
  for (const auto& [cob_id, pdos] : by_cob_id) {
    for (const std::size_t producer : pdos) {
      if (result.pdos[producer].pdo.is_transmit) {
        add_links(producer, pdos, result);
      }
    }
  }
  return result;
}

}  // namespace lexican::codict::network
