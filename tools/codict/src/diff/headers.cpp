// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "diff/recorder.hpp"
#include "model/date.hpp"

namespace lexican::codict::diff {

namespace {

void compare_identity(const Identity& before, const Identity& after, const Recorder& recorder) {
  recorder.field(Kind::breaking, "vendor number", before.vendor_number, after.vendor_number);
  recorder.field(Kind::breaking, "product number", before.product_number, after.product_number);
  recorder.field(Kind::compatible, "revision number", before.revision_number, after.revision_number);
  recorder.text(Kind::text, "vendor name", before.vendor_name, after.vendor_name);
  recorder.text(Kind::text, "product name", before.product_name, after.product_name);
  recorder.text(Kind::text, "vendor text", before.vendor_text, after.vendor_text);
  recorder.text(Kind::text, "product text", before.product_text, after.product_text);
  recorder.text(Kind::text, "product family", before.product_family, after.product_family);
}

// Returns false for a malformed rate of an XDD, which is read as 0 (automatic) and not supported.
bool is_rate(const BitRate& rate) { return rate.kbit != 0 || rate.supported.value; }

const BitRate* find_rate(const std::vector<BitRate>& rates, std::uint32_t kbit) {
  const auto place = std::find_if(rates.begin(), rates.end(),
                                  [kbit](const BitRate& rate) { return rate.kbit == kbit && is_rate(rate); });
  return place != rates.end() ? &*place : nullptr;
}

void compare_rate(std::uint32_t kbit, const BitRate* before, const BitRate* after, const Recorder& recorder) {
  static const BitRate unsupported;
  const std::string what = kbit == 0 ? "automatic bit rate" : std::to_string(kbit) + " kbit/s";
  recorder.ability(what, (before != nullptr ? *before : unsupported).supported,
                   (after != nullptr ? *after : unsupported).supported);
}

void compare_rates(const std::vector<BitRate>& before, const std::vector<BitRate>& after, const Recorder& recorder) {
  for (const BitRate& rate : before) {
    if (is_rate(rate)) {
      compare_rate(rate.kbit, &rate, find_rate(after, rate.kbit), recorder);
    }
  }
  for (const BitRate& rate : after) {
    if (is_rate(rate) && find_rate(before, rate.kbit) == nullptr) {
      compare_rate(rate.kbit, nullptr, &rate, recorder);
    }
  }
}

// Compares the PDO granularity: 0 means no mapping, otherwise smaller is better.
void compare_granularity(const Field<std::uint8_t>& before, const Field<std::uint8_t>& after,
                         const Recorder& recorder) {
  const bool is_coarser = before.value != 0 && (after.value == 0 || after.value > before.value);
  recorder.field(is_coarser ? Kind::breaking : Kind::compatible, "granularity", before, after);
}

void compare_features(const Features& before, const Features& after, const Recorder& recorder) {
  compare_rates(before.bit_rates, after.bit_rates, recorder);
  compare_granularity(before.granularity, after.granularity, recorder);
  recorder.ability("boot-up master", before.boot_up_master, after.boot_up_master);
  recorder.ability("boot-up slave", before.boot_up_slave, after.boot_up_slave);
  recorder.ability("dynamic channels", before.dynamic_channels, after.dynamic_channels);
  recorder.ability("group messaging", before.group_messaging, after.group_messaging);
  recorder.ability("RPDOs", before.rx_pdos, after.rx_pdos);
  recorder.ability("TPDOs", before.tx_pdos, after.tx_pdos);
  recorder.ability("LSS slave", before.lss_slave, after.lss_slave);
  recorder.ability("LSS master", before.lss_master, after.lss_master);
  recorder.ability("node guarding slave", before.node_guarding_slave, after.node_guarding_slave);
  recorder.ability("node guarding master", before.node_guarding_master, after.node_guarding_master);
  recorder.ability("guarded nodes", before.guarded_nodes, after.guarded_nodes);
  recorder.field(Kind::breaking, "self-starting", before.self_starting, after.self_starting);
  recorder.ability("SDO requests", before.sdo_requesting, after.sdo_requesting);
  recorder.ability("flying master", before.flying_master, after.flying_master);
  recorder.ability("SDO manager", before.sdo_manager, after.sdo_manager);
  recorder.ability("configuration manager", before.configuration_manager, after.configuration_manager);
}

const Dummy* find_dummy(const std::vector<Dummy>& dummies, std::uint16_t type) {
  const auto place =
      std::find_if(dummies.begin(), dummies.end(), [type](const Dummy& dummy) { return dummy.type == type; });
  return place != dummies.end() ? &*place : nullptr;
}

void compare_dummies(const std::vector<Dummy>& before, const std::vector<Dummy>& after, const Recorder& recorder) {
  static const Dummy unsupported;
  for (std::uint16_t type = 1; type <= 7; ++type) {
    const Dummy* const old_dummy = find_dummy(before, type);
    const Dummy* const new_dummy = find_dummy(after, type);
    recorder.ability("dummy of type " + std::to_string(type),
                     (old_dummy != nullptr ? *old_dummy : unsupported).supported,
                     (new_dummy != nullptr ? *new_dummy : unsupported).supported);
  }
}

void compare_commissioning(const Commissioning& before, const Commissioning& after, const Recorder& recorder) {
  recorder.field(Kind::configuration, "node-ID", before.node_id, after.node_id);
  recorder.text(Kind::configuration, "node name", before.node_name, after.node_name);
  recorder.field(Kind::configuration, "bit rate", before.bit_rate, after.bit_rate);
  recorder.field(Kind::configuration, "network number", before.network_number, after.network_number);
  recorder.text(Kind::configuration, "network name", before.network_name, after.network_name);
  recorder.field(Kind::configuration, "manager", before.is_manager, after.is_manager);
  recorder.field(Kind::configuration, "serial number", before.serial_number, after.serial_number);
}

// Compares channels in pairs by position, as they have no names.
void compare_channels(const std::vector<DynamicChannel>& before, const std::vector<DynamicChannel>& after,
                      const Recorder& recorder) {
  static const DynamicChannel nothing;
  for (std::size_t at = 0; at < std::max(before.size(), after.size()); ++at) {
    const DynamicChannel& old_channel = at < before.size() ? before[at] : nothing;
    const DynamicChannel& new_channel = at < after.size() ? after[at] : nothing;
    const std::string channel = "dynamic channel " + std::to_string(at + 1);
    recorder.field(Kind::breaking, channel + ": data type", old_channel.data_type, new_channel.data_type);
    recorder.field(Kind::breaking, channel + ": access", old_channel.access, new_channel.access);
    recorder.field(Kind::breaking, channel + ": first index", old_channel.first_index, new_channel.first_index);
    recorder.ability(channel + ": last index", old_channel.last_index, new_channel.last_index);
    recorder.ability(channel + ": number", old_channel.max_number, new_channel.max_number);
  }
}

// Compares dates or times of different notations: 12-31-2020 in an EDS equals 2020-12-31 in an XDD.
void compare_moment(std::string_view what, const Text& before, const Text& after,
                    std::string (*as_schema)(const std::string&), const Recorder& recorder) {
  if (as_schema(before.text) != as_schema(after.text)) {
    recorder.add(Kind::file, what, before, after);
  }
}

void compare_files(const FileInfo& before, const FileInfo& after, const Recorder& recorder) {
  recorder.text(Kind::file, "file name", before.file_name, after.file_name);
  if (before.version.text != after.version.text) {  // compares the text first: in XML, the version may be any text
    recorder.field(Kind::file, "file version", before.version, after.version);
  }
  recorder.field(Kind::file, "file revision", before.revision, after.revision);
  recorder.text(Kind::file, "version of the format", before.eds_version, after.eds_version);
  recorder.text(Kind::file, "description", before.description, after.description);
  recorder.text(Kind::file, "author", before.created_by, after.created_by);
  compare_moment("date of creation", before.creation_date, after.creation_date, schema_date, recorder);
  compare_moment("time of creation", before.creation_time, after.creation_time, schema_time, recorder);
  recorder.text(Kind::file, "last author", before.modified_by, after.modified_by);
  compare_moment("date of change", before.modification_date, after.modification_date, schema_date, recorder);
  compare_moment("time of change", before.modification_time, after.modification_time, schema_time, recorder);
  recorder.text(Kind::file, "EDS it was made of", before.last_eds, after.last_eds);
}

}  // namespace

void compare_headers(const Recorder& recorder) {
  const Device& before = recorder.before;
  const Device& after = recorder.after;
  compare_identity(before.identity, after.identity, recorder);
  compare_features(before.features, after.features, recorder);
  compare_dummies(before.dummies, after.dummies, recorder);
  compare_channels(before.dynamic_channels, after.dynamic_channels, recorder);
  compare_commissioning(before.commissioning, after.commissioning, recorder);
  compare_files(before.file, after.file, recorder);
}

}  // namespace lexican::codict::diff
