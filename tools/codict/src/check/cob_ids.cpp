// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "check/network.hpp"
#include "model/cob_id.hpp"
#include "model/pdo.hpp"
#include "model/subject.hpp"

namespace lexican::codict::check {

namespace {

struct Range {
  std::uint32_t first;
  std::uint32_t last;
  const char* use;
};

// Restricted COB-IDs, which no configurable service may use. [301: table 40]
constexpr std::array<Range, 7> restricted = {{{0x000, 0x000, "NMT"},
                                              {0x001, 0x07F, "reserved"},
                                              {0x101, 0x180, "reserved"},
                                              {0x581, 0x5FF, "default SDO"},
                                              {0x601, 0x67F, "default SDO"},
                                              {0x6E0, 0x6FF, "reserved"},
                                              {0x701, 0x7FF, "NMT error control"}}};

// Returns the restricted range of a COB-ID, null if it is free.
const Range* restriction_of(const CobId& cob_id) {
  const std::uint32_t identifier = cob_id.identifier();
  const auto* const range = std::find_if(restricted.begin(), restricted.end(), [identifier](const Range& each) {
    return identifier >= each.first && identifier <= each.last;
  });
  return cob_id.is_extended() || range == restricted.end() ? nullptr : range;
}

// Returns "COB-ID 181h" or "COB-ID 181h with node-ID 1".
std::string title_of(const Device& device, const CobId& cob_id) {
  const bool adds_node_id = value_in_force(*device.find(cob_id.index, cob_id.sub_index)).adds_node_id;
  return fmt::format("COB-ID {:03X}h{}", cob_id.identifier(), adds_node_id ? " with node-ID 1" : "");
}

bool is_default_sdo(const CobId& cob_id) { return cob_id.index == 0x1200; }
bool is_sdo_client(const CobId& cob_id) { return cob_id.index >= 0x1280 && cob_id.index < 0x1300; }

Span span_of(const Device& device, const CobId& cob_id) {
  return value_in_force(*device.find(cob_id.index, cob_id.sub_index)).span;
}

void check_one(const Device& device, const CobId& cob_id, Findings& findings) {
  constexpr std::uint32_t flags = 0xE0000000U;
  const std::uint32_t bits = cob_id.is_extended() ? 0x1FFFFFFFU : 0x7FFU;
  const Range* const range = restriction_of(cob_id);
  if ((cob_id.value & ~flags & ~bits) != 0) {
    findings.add(rules::cob_id_form, span_of(device, cob_id),
                 fmt::format("COB-ID {:X}h has more than 11 bits, but bit 29 is 0", cob_id.value),
                 "set bit 29, or use an 11-bit identifier");
  } else if (range != nullptr && !cob_id.is_safety && !is_default_sdo(cob_id) && !is_sdo_client(cob_id)) {
    // SRDOs and the GFC have COB-IDs that CiA 301 reserves; check_srdos() checks them. SDO clients are excluded because
    // they may use the COB-IDs of a default SDO server, or 0 while unconfigured.
    findings.add(rules::cob_id_restricted, span_of(device, cob_id),
                 fmt::format("{} is restricted by CiA 301 ({})", title_of(device, cob_id), range->use),
                 "choose another COB-ID, or disable the service by bit 31");
  }
}

}  // namespace

// Compares all COB-IDs for node-ID 1. COB-IDs with and without $NODEID can be equal for one node-ID only by chance.
void check_cob_ids(const Device& device, Findings& findings) {
  std::map<std::uint64_t, std::string> seen;
  for (const CobId& cob_id : cob_ids_of(device, 1)) {
    if (cob_id.index == 0) {
      seen.emplace(cob_id.identifier(), cob_id.service);
      continue;
    }
    if (!cob_id.is_valid()) {
      continue;
    }
    check_one(device, cob_id, findings);
    const std::uint64_t key = cob_id.identifier() | (cob_id.is_extended() ? 1ULL << 32 : 0);
    const auto [place, is_new] = seen.emplace(key, cob_id.service);
    if (!is_new && !is_sdo_client(cob_id)) {
      findings.add(rules::cob_id_twice, span_of(device, cob_id),
                   fmt::format("{} is also that of {}", title_of(device, cob_id), place->second),
                   "choose another COB-ID for one of them");
    }
  }
}

}  // namespace lexican::codict::check
