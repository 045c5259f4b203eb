// SPDX-License-Identifier: Apache-2.0
#include "model/cob_id.hpp"

#include <string>
#include <utility>

#include "model/pdo.hpp"
#include "model/srdo.hpp"

namespace lexican::codict {

namespace {

CobId fixed(std::string service, std::uint32_t identifier) {
  CobId result;
  result.service = std::move(service);
  result.value = identifier;
  result.is_known = true;
  return result;
}

class Collector {
 public:
  Collector(const Device& device, std::uint8_t node_id) : device_(device), node_id_(node_id) {}

  void add(std::string service, std::uint16_t index, std::uint8_t sub_index, bool can_be_invalid = true) {
    const Entry* const entry = device_.find(index, sub_index);
    if (entry == nullptr) {
      return;
    }
    CobId cob_id;
    cob_id.service = std::move(service);
    cob_id.index = index;
    cob_id.sub_index = sub_index;
    cob_id.can_be_invalid = can_be_invalid;
    const Value& value = value_in_force(*entry);
    cob_id.is_known = value.is_integer();
    cob_id.value = static_cast<std::uint32_t>(value.integer_for(node_id_).bits());
    all_.push_back(std::move(cob_id));
  }

  // Adds the COB-IDs of objects first…last: sub-index 1, and for SDOs (`from` is not empty) sub-index 2.
  void add_range(const std::string& service, std::uint16_t first, std::uint16_t last, const char* to,
                 const char* from) {
    for (std::uint32_t index = first; index <= last; ++index) {
      const std::string name = service + " " + std::to_string(index - first + 1);
      add(name + to, static_cast<std::uint16_t>(index), 1);
      if (*from != '\0') {
        add(name + from, static_cast<std::uint16_t>(index), 2);
      }
    }
  }

  // Adds the GFC, whose CAN-ID is fixed, if 1300h is 1, and both frames of each SRDO. [EN 50325-5]
  void add_safety() {
    constexpr std::uint32_t global_fail_safe = 0x001;
    const Entry* const used = device_.find(srdo_index::global_fail_safe, 0);
    if (used != nullptr && value_in_force(*used).integer == Integer(1)) {
      CobId gfc = fixed("GFC", global_fail_safe);
      gfc.index = srdo_index::global_fail_safe;
      gfc.is_safety = true;
      all_.push_back(std::move(gfc));
    }
    for (const Srdo& srdo : srdos_of(device_)) {
      add_frame(srdo, 5, "plain");
      add_frame(srdo, 6, "inverse");
    }
  }

  std::vector<CobId> take_cob_ids() { return std::move(all_); }
  void add(CobId cob_id) { all_.push_back(std::move(cob_id)); }

 private:
  void add_frame(const Srdo& srdo, std::uint8_t sub_index, const char* frame) {
    const std::size_t before = all_.size();
    add("SRDO " + std::to_string(srdo.number) + (srdo.is_transmit() ? " transmitted, " : " received, ") + frame,
        srdo.communication->index, sub_index, false);
    if (all_.size() != before) {
      all_.back().is_safety = true;
    }
  }

  const Device& device_;
  std::uint8_t node_id_;
  std::vector<CobId> all_;
};

}  // namespace

std::vector<CobId> cob_ids_of(const Device& device, std::uint8_t node_id) {
  Collector collector(device, node_id);
  collector.add(fixed("NMT", 0));
  collector.add(fixed("Heartbeat", 0x700U + node_id));
  if (device.find(0x1200) == nullptr) {
    collector.add(fixed("SDO server 1, request", 0x600U + node_id));
    collector.add(fixed("SDO server 1, response", 0x580U + node_id));
  }
  collector.add("SYNC", 0x1005, 0, false);
  collector.add("TIME", 0x1012, 0, false);
  collector.add("EMCY", 0x1014, 0);
  collector.add_range("SDO server", 0x1200, 0x127F, ", request", ", response");
  collector.add_range("SDO client", 0x1280, 0x12FF, ", request", ", response");
  collector.add_safety();
  collector.add_range("RPDO", 0x1400, 0x15FF, "", "");
  collector.add_range("TPDO", 0x1800, 0x19FF, "", "");
  return collector.take_cob_ids();
}

}  // namespace lexican::codict
