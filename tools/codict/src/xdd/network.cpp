// SPDX-License-Identifier: Apache-2.0
// Reads the communication features of a device. [311: ApplicationLayers, TransportLayers, NetworkManagement]
#include <fmt/format.h>

#include <limits>
#include <string>
#include <utility>

#include "model/parse.hpp"
#include "xdd/parts.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::uint64_t u8 = std::numeric_limits<std::uint8_t>::max();
constexpr std::uint64_t u16 = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t u32 = std::numeric_limits<std::uint32_t>::max();

// The last three are attributes of CANopenEditor.
constexpr std::array<Slot<Features>, 12> general_slots = {{
    {"groupMessaging", [](Features& f) -> Text& { return f.group_messaging; }},
    {"dynamicChannels", [](Features& f) -> Text& { return f.dynamic_channels; }},
    {"selfStartingDevice", [](Features& f) -> Text& { return f.self_starting; }},
    {"SDORequestingDevice", [](Features& f) -> Text& { return f.sdo_requesting; }},
    {"granularity", [](Features& f) -> Text& { return f.granularity; }},
    {"nrOfRxPDO", [](Features& f) -> Text& { return f.rx_pdos; }},
    {"nrOfTxPDO", [](Features& f) -> Text& { return f.tx_pdos; }},
    {"bootUpSlave", [](Features& f) -> Text& { return f.boot_up_slave; }},
    {"layerSettingServiceSlave", [](Features& f) -> Text& { return f.lss_slave; }},
    {"ngSlave", [](Features& f) -> Text& { return f.node_guarding_slave; }},
    {"ngMaster", [](Features& f) -> Text& { return f.node_guarding_master; }},
    {"NrOfNG_MonitoredNodes", [](Features& f) -> Text& { return f.guarded_nodes; }},
}};

constexpr std::array<Slot<Features>, 5> master_slots = {{
    {"bootUpMaster", [](Features& f) -> Text& { return f.boot_up_master; }},
    {"flyingMaster", [](Features& f) -> Text& { return f.flying_master; }},
    {"SDOManager", [](Features& f) -> Text& { return f.sdo_manager; }},
    {"configurationManager", [](Features& f) -> Text& { return f.configuration_manager; }},
    {"layerSettingServiceMaster", [](Features& f) -> Text& { return f.lss_master; }},
}};

constexpr std::array<Slot<Commissioning>, 6> commissioning_slots = {{
    {"nodeID", [](Commissioning& c) -> Text& { return c.node_id; }},
    {"nodeName", [](Commissioning& c) -> Text& { return c.node_name; }},
    {"actualBaudRate", [](Commissioning& c) -> Text& { return c.bit_rate; }},
    {"networkNumber", [](Commissioning& c) -> Text& { return c.network_number; }},
    {"networkName", [](Commissioning& c) -> Text& { return c.network_name; }},
    {"CANopenManager", [](Commissioning& c) -> Text& { return c.is_manager; }},
}};

constexpr std::array<Slot<DynamicChannel>, 7> channel_slots = {{
    {"dataType", [](DynamicChannel& c) -> Text& { return c.data_type; }},
    {"accessType", [](DynamicChannel& c) -> Text& { return c.access; }},
    {"startIndex", [](DynamicChannel& c) -> Text& { return c.first_index; }},
    {"endIndex", [](DynamicChannel& c) -> Text& { return c.last_index; }},
    {"maxNumber", [](DynamicChannel& c) -> Text& { return c.max_number; }},
    {"addressOffset", [](DynamicChannel& c) -> Text& { return c.offset; }},
    {"bitAlignment", [](DynamicChannel& c) -> Text& { return c.bit_alignment; }},
}};

constexpr auto no_child = [](pugi::xml_node) { return false; };

// Reads a bit rate in kbit/s: "125 Kbps", and the deviations 125 and 125000. Returns false if it is not a bit rate.
bool read_bit_rate(const Text& text, std::uint32_t& kbit, const Reader& reader) {
  constexpr std::string_view unit = " Kbps";
  if (equal_ignoring_case(text.text, "auto-baudRate")) {
    kbit = 0;
    return true;
  }
  const std::size_t end = std::min(text.text.find_first_not_of("0123456789"), text.text.size());
  const ParsedInteger number = parse_integer(std::string_view(text.text).substr(0, end));
  const std::string_view suffix = trimmed(std::string_view(text.text).substr(end));
  const bool is_kbit = suffix.empty() || equal_ignoring_case(suffix, "Kbps") || equal_ignoring_case(suffix, "kbit/s");
  if (!number.is_number() || !is_kbit || number.value.magnitude > u32) {
    reader.findings.add(rules::bit_rate, text.span, fmt::format("{} is not a bit rate", in_quotes(text.text)),
                        "write 125 Kbps");
    return false;
  }
  const auto value = static_cast<std::uint32_t>(number.value.magnitude);
  const bool is_in_bits = suffix.empty() && value >= 10000;
  kbit = is_in_bits ? value / 1000 : value;
  if (text.text.substr(end) != unit) {
    reader.findings.add(rules::bit_rate, text.span, fmt::format("{} is read as {} kbit/s", in_quotes(text.text), kbit),
                        fmt::format("write {}{}", kbit, unit));
  }
  return true;
}

void read_supported_rate(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  BitRate rate;
  static_cast<Text&>(rate.supported) = text_of(element, "value", others, reader);
  rate.supported.value = read_bit_rate(rate.supported, rate.kbit, reader);
  reader.device.features.bit_rates.push_back(std::move(rate));
}

void read_bit_rates(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  constexpr std::array<Slot<Features>, 1> slots = {
      {{"defaultValue", [](Features& f) -> Text& { return f.default_bit_rate; }}}};
  std::vector<OpaquePart> opaque;
  Features& features = reader.device.features;
  read_element(features, element, slots, opaque, reader, [&](pugi::xml_node child) {
    if (local_name(child) != "supportedBaudRate") {
      return false;
    }
    read_supported_rate(child, opaque, reader);
    return true;
  });
  store_remainder(element, std::move(opaque), others, reader);
  if (!features.default_bit_rate.is_empty()) {
    read_bit_rate(features.default_bit_rate, features.default_bit_rate.value, reader);
  }
}

void interpret_general(Features& features, Findings& findings) {
  for (Field<bool>* flag :
       {&features.group_messaging, &features.self_starting, &features.sdo_requesting, &features.boot_up_slave,
        &features.lss_slave, &features.node_guarding_slave, &features.node_guarding_master}) {
    interpret_boolean(*flag, findings);
  }
  interpret_number(features.dynamic_channels, u32, findings);
  interpret_number(features.granularity, u8, findings);
  for (Field<std::uint16_t>* number : {&features.rx_pdos, &features.tx_pdos, &features.guarded_nodes}) {
    interpret_number(*number, u16, findings);
  }
}

void read_commissioning(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  Commissioning& commissioning = reader.device.commissioning;
  commissioning.is_given = true;
  read_element(commissioning, element, commissioning_slots, opaque, reader, no_child);
  store_remainder(element, std::move(opaque), others, reader);
  interpret_number(commissioning.node_id, u8, reader.findings);
  interpret_number(commissioning.network_number, u32, reader.findings);
  interpret_boolean(commissioning.is_manager, reader.findings);
  if (!commissioning.bit_rate.is_empty()) {
    read_bit_rate(commissioning.bit_rate, commissioning.bit_rate.value, reader);
  }
}

bool read_management_part(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  const std::string_view name = local_name(child);
  const Span place = reader.document.tag(child);
  Features& features = reader.device.features;
  std::vector<OpaquePart> opaque;
  if (name == "CANopenGeneralFeatures") {
    read_element(features, child, general_slots, opaque, reader, no_child);
    interpret_general(features, reader.findings);
  } else if (name == "CANopenMasterFeatures") {
    read_element(features, child, master_slots, opaque, reader, no_child);
    for (Field<bool>* flag : {&features.boot_up_master, &features.flying_master, &features.sdo_manager,
                              &features.configuration_manager, &features.lss_master}) {
      interpret_boolean(*flag, reader.findings);
    }
  } else if (is_named(name, "deviceCommissioning", place, reader) && !reader.device.commissioning.is_given) {
    read_commissioning(child, others, reader);
    return true;
  } else {
    return false;
  }
  store_remainder(child, std::move(opaque), others, reader);
  return true;
}

// Reads entry="Dummy0001=0".
bool read_dummy(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  constexpr std::string_view word = "Dummy";
  const Text entry = attribute_text(element, "entry", reader);
  const std::string_view text = entry.text;
  const std::size_t sign = std::min(text.find('='), text.size());
  std::uint64_t type = 0;
  if (sign <= word.size() || !equal_ignoring_case(text.substr(0, word.size()), word) ||
      !parse_hex(text.substr(word.size(), sign - word.size()), type) || type > u16 || sign == text.size()) {
    reader.findings.add(rules::dummy, entry.is_given ? entry.span : reader.document.tag(element),
                        fmt::format("{} is not a dummy entry; not used", in_quotes(entry.text)),
                        "write Dummy0001=0 or Dummy0001=1");
    others.push_back(opaque_part(reader.document, element));
    return true;
  }
  Dummy dummy;
  dummy.type = static_cast<std::uint16_t>(type);
  static_cast<Text&>(dummy.supported) = {std::string(trimmed(text.substr(sign + 1))), entry.span, true};
  interpret_boolean(dummy.supported, reader.findings);
  reader.device.dummies.push_back(std::move(dummy));
  return true;
}

void interpret_direction(Field<Access>& access, Findings& findings) {
  if (access.text == "readOnly") {
    access.value = Access::ro;
  } else if (access.text == "writeOnly") {
    access.value = Access::wo;
  } else if (access.text == "readWriteOutput") {
    access.value = Access::rww;
  } else if (!access.is_empty()) {
    findings.add(rules::access_unknown, access.span, fmt::format("{} is not an access", in_quotes(access.text)),
                 "write readOnly, writeOnly or readWriteOutput");
  }
}

void interpret_hex(Field<std::uint16_t>& field, Findings& findings) {
  std::uint64_t value = 0;
  if (!field.is_empty() && !read_hex(field, 0, u16, value, findings)) {
    findings.add(rules::index, field.span, fmt::format("{} is not a hexadecimal number", in_quotes(field.text)),
                 "write hexadecimal digits");
  }
  field.value = static_cast<std::uint16_t>(value);
}

bool read_channel(pugi::xml_node element, const Reader& reader) {
  if (local_name(element) != "dynamicChannel") {
    return false;
  }
  DynamicChannel channel;
  read_element(channel, element, channel_slots, channel.others, reader, no_child);
  for (Field<std::uint16_t>* field : {&channel.data_type, &channel.first_index, &channel.last_index}) {
    interpret_hex(*field, reader.findings);
  }
  for (Field<std::uint32_t>* field : {&channel.max_number, &channel.bit_alignment}) {
    interpret_number(*field, u32, reader.findings);
  }
  std::uint64_t offset = 0;
  if (!channel.offset.is_empty() && read_hex(channel.offset, 0, u32, offset, reader.findings)) {
    channel.offset.value = static_cast<std::uint32_t>(offset);
  }
  interpret_direction(channel.access, reader.findings);
  reader.device.dynamic_channels.push_back(std::move(channel));
  return true;
}

}  // namespace

bool read_network_part(pugi::xml_node child, std::vector<OpaquePart>& others, const Reader& reader) {
  const std::string_view name = local_name(child);
  std::vector<OpaquePart> opaque;
  if (name == "baudRate") {
    read_bit_rates(child, others, reader);
    return true;
  }
  if (name == "NetworkManagement") {
    read_children(child, opaque, reader,
                  [&](pugi::xml_node part) { return read_management_part(part, opaque, reader); });
  } else if (name == "dummyUsage") {
    read_children(child, opaque, reader,
                  [&](pugi::xml_node part) { return local_name(part) == "dummy" && read_dummy(part, opaque, reader); });
  } else if (name == "dynamicChannels") {
    read_children(child, opaque, reader, [&](pugi::xml_node part) { return read_channel(part, reader); });
  } else {
    return false;
  }
  store_remainder(child, std::move(opaque), others, reader);
  return true;
}

}  // namespace lexican::codict::xdd
