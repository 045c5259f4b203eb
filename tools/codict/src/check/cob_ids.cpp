// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "check/network.hpp"
#include "model/cob_id.hpp"
#include "model/pdo.hpp"

namespace lexican::codict::check {

namespace {

struct Range {
  std::uint32_t first;
  std::uint32_t last;
};

// Identifiers that no configurable service may have. [301: table 40]
constexpr std::array<Range, 7> restricted = {
    {{0x000, 0x000}, {0x001, 0x07F}, {0x101, 0x180}, {0x581, 0x5FF}, {0x601, 0x67F}, {0x6E0, 0x6FF}, {0x701, 0x7FF}}};

bool is_restricted(std::uint32_t identifier) {
  return std::any_of(restricted.begin(), restricted.end(), [identifier](const Range& range) {
    return identifier >= range.first && identifier <= range.last;
  });
}

bool is_default_sdo(const CobId& cob_id) { return cob_id.index == 0x1200; }
bool is_sdo_client(const CobId& cob_id) { return cob_id.index >= 0x1280 && cob_id.index < 0x1300; }

Span span_of(const Device& device, const CobId& cob_id) {
  return value_in_force(*device.find(cob_id.index, cob_id.sub_index)).span;
}

void check_one(const Device& device, const CobId& cob_id, Findings& findings) {
  constexpr std::uint32_t flags = 0xE0000000U;
  const std::uint32_t bits = cob_id.is_extended() ? 0x1FFFFFFFU : 0x7FFU;
  if ((cob_id.value & ~flags & ~bits) != 0) {
    findings.add(rules::cob_id_form, span_of(device, cob_id), "more than 11 bits, without bit 29");
  } else if (!cob_id.is_extended() && !is_default_sdo(cob_id) && is_restricted(cob_id.identifier()) &&
             // A client's server may have the identifiers of the default SDO, and 0 is not configured yet.
             !is_sdo_client(cob_id)) {
    findings.add(rules::cob_id_restricted, span_of(device, cob_id), "an identifier that CiA 301 keeps for others",
                 "an object with bit 31 has none");
  }
}

}  // namespace

// With node-ID 1: what is free of it and what is not may meet by chance only.
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
      findings.add(rules::cob_id_twice, span_of(device, cob_id), "the identifier of " + place->second + ", too");
    }
  }
}

}  // namespace lexican::codict::check
