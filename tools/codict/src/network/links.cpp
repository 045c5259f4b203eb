// SPDX-License-Identifier: Apache-2.0
#include "network/links.hpp"

#include <cstdint>
#include <map>

namespace lexican::codict::network {

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
      for (const std::size_t consumer : pdos) {
        const ActivePdo& from = result.pdos[producer];
        const ActivePdo& to = result.pdos[consumer];
        const bool is_link = from.pdo.is_transmit && !to.pdo.is_transmit && from.node != to.node;
        if (is_link && result.links.size() < link_limit) {
          result.links.push_back({producer, consumer});
          result.are_connected[producer] = true;
          result.are_connected[consumer] = true;
        }
      }
    }
  }
  return result;
}

}  // namespace lexican::codict::network
