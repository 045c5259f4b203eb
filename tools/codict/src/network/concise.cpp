// SPDX-License-Identifier: Apache-2.0
#include "network/concise.hpp"

#include <fmt/format.h>

#include "network/rules.hpp"

namespace lexican::codict::network {

namespace {

void append_number(std::string& bytes, std::uint64_t value, unsigned size) {
  for (unsigned n = 0; n < size; ++n) {
    bytes += static_cast<char>(value >> (8 * n) & 0xFFU);
  }
}

}  // namespace

std::vector<Download> downloads_of(const Network& network, std::size_t at, NetworkFindings& findings) {
  const Node& node = network.nodes[at];
  const auto report = [&](std::uint16_t index, std::uint8_t sub_index, const Entry& entry) {
    findings.add(rules::concise, at, &entry,
                 fmt::format("{}: {:04X}h:{} = {} is not in the concise DCF: unknown coding of its data type",
                             node.title(), index, sub_index, shortened(entry.actual_value->text)),
                 "write the value by the application");
  };
  return codict::downloads_of(node.device, node.node_id, report);
}

std::string concise_dcf(const std::vector<Download>& downloads) {
  std::string bytes;
  append_number(bytes, downloads.size(), 4);
  for (const Download& download : downloads) {
    append_number(bytes, download.index, 2);
    append_number(bytes, download.sub_index, 1);
    append_number(bytes, download.bytes.size(), 4);
    bytes += download.bytes;
  }
  return bytes;
}

}  // namespace lexican::codict::network
