// SPDX-License-Identifier: Apache-2.0
// Reads FileInfo, DeviceInfo and the other sections about the whole device. [306: 4.4, 4.5]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "eds/slots.hpp"
#include "model/parse.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

constexpr std::uint64_t u8 = std::numeric_limits<std::uint8_t>::max();
constexpr std::uint64_t u16 = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint64_t u32 = std::numeric_limits<std::uint32_t>::max();

// Keys of former versions of the standard: stored as opaque parts without a finding.
constexpr std::array<std::string_view, 4> former_keys = {"ProductVersion", "ProductRevision", "LMT_ManufacturerName",
                                                         "LMT_ProductName"};

// Keeps the keys of a section that have no member in the model.
void keep_section(std::string_view name, std::vector<OpaquePart> children, const Section& section, Device& device) {
  if (!children.empty()) {
    device.others.push_back({std::string(name), {}, std::move(children), section.name});
  }
}

void read_file_info(const Section& section, const Reader& reader) {
  FileInfo& file = reader.device.file;
  std::vector<OpaquePart> others;
  read_section(file, section, file_slots, others, reader);
  interpret_number(file.version, u8, reader.findings);
  interpret_number(file.revision, u8, reader.findings);
  keep_section("FileInfo", std::move(others), section, reader.device);
}

// Reads BaudRate_500, and the form BaudRate_500.0 that python-canopen writes.
bool read_bit_rate(const Key& key, const Reader& reader) {
  std::string_view name = reader.document.raw(key.name);
  if (name.size() > 2 && name.substr(name.size() - 2) == ".0") {
    name.remove_suffix(2);
  }
  BitRate rate;
  if (!number_of(name, "BaudRate_", rate.kbit)) {
    return false;
  }
  static_cast<Text&>(rate.supported) = text_of(reader.document, key);
  interpret_flag(rate.supported, reader.findings);
  reader.device.features.bit_rates.push_back(std::move(rate));
  return true;
}

bool is_former(std::string_view name) {
  return std::any_of(former_keys.begin(), former_keys.end(),
                     [name](std::string_view former) { return compare_names(name, former) == 0; });
}

void interpret_device_info(Device& device, Findings& findings) {
  for (Field<std::uint32_t>* number :
       {&device.identity.vendor_number, &device.identity.product_number, &device.identity.revision_number,
        &device.features.dynamic_channels, &device.features.compact_pdo}) {
    interpret_number(*number, u32, findings);
  }
  Features& features = device.features;
  for_each_flag(features, [&findings](Field<bool>& flag) { interpret_flag(flag, findings); });
  for (Field<std::uint16_t>* number : {&features.rx_pdos, &features.tx_pdos, &features.guarded_nodes}) {
    interpret_number(*number, u16, findings);
  }
  interpret_number(features.granularity, u8, findings);
}

void read_device_info(const Section& section, const Reader& reader) {
  std::vector<OpaquePart> others;
  for (const Key& key : section.keys) {
    if (!key.is_duplicate && is_former(reader.document.raw(key.name))) {
      others.push_back(opaque_part(reader.document, key));
    } else if (key.is_duplicate ||
               !(read_into(reader.device, key, device_slots, reader) || read_bit_rate(key, reader))) {
      store_opaque_key(key, others, reader);
    }
  }
  interpret_device_info(reader.device, reader.findings);
  keep_section("DeviceInfo", std::move(others), section, reader.device);
}

void read_dummy_usage(const Section& section, const Reader& reader) {
  constexpr std::string_view word = "Dummy";
  std::vector<OpaquePart> others;
  for (const Key& key : section.keys) {
    const std::string_view name = reader.document.raw(key.name);
    std::uint64_t type = 0;
    const bool is_dummy = name.size() > word.size() && equal_ignoring_case(name.substr(0, word.size()), word) &&
                          parse_hex(name.substr(word.size()), type) && type <= u16;
    if (!is_dummy || key.is_duplicate) {
      store_opaque_key(key, others, reader);
      continue;
    }
    Dummy dummy;
    dummy.type = static_cast<std::uint16_t>(type);
    static_cast<Text&>(dummy.supported) = text_of(reader.document, key);
    interpret_flag(dummy.supported, reader.findings);
    reader.device.dummies.push_back(std::move(dummy));
  }
  keep_section("DummyUsage", std::move(others), section, reader.device);
}

void read_comments(const Section& section, const Reader& reader) {
  const NumberedList list = read_list(section, "Lines", "Line", Gaps::are_wrong, reader);
  for (const NumberedKey& entry : list.entries) {
    reader.device.comments.push_back(text_of(reader.document, *entry.key));
    report_length(reader.device.comments.back(), 249, reader.findings);
  }
  std::vector<OpaquePart> others;
  for (const Key* key : list.others) {
    store_opaque_key(*key, others, reader);
  }
  keep_section("Comments", std::move(others), section, reader.device);
}

void read_commissioning(const NamedSection& header, const Reader& reader) {
  if (header.name.word != "DeviceComissioning") {
    reader.findings.add(rules::commissioning_spelling, header.section->name, "section spelled DeviceCommissioning",
                        "write [DeviceComissioning], with one m");
  }
  Commissioning& commissioning = reader.device.commissioning;
  if (commissioning.is_given) {  // already read from a section in the other spelling
    reader.findings.add(rules::duplicate_section, header.section->name,
                        "duplicate section [DeviceComissioning]; the first is used", "remove one of them");
    reader.device.others.push_back(opaque_part(reader.document, *header.section));
    return;
  }
  std::vector<OpaquePart> others;
  read_section(commissioning, *header.section, commissioning_slots, others, reader);
  commissioning.is_given = true;
  interpret_number(commissioning.node_id, u8, reader.findings);
  interpret_flag(commissioning.is_manager, reader.findings);
  for (Field<std::uint32_t>* number :
       {&commissioning.bit_rate, &commissioning.network_number, &commissioning.serial_number,
        &commissioning.node_reference, &commissioning.network_reference}) {
    interpret_number(*number, u32, reader.findings);
  }
  keep_section("DeviceComissioning", std::move(others), *header.section, reader.device);
}

// Interprets "0xA000-0xA03F".
void interpret_range(DynamicChannel& channel, Findings& findings) {
  const std::size_t dash = channel.first_index.text.find('-');
  if (dash == std::string::npos) {
    Findings said_already;
    findings.add(codict::rules::value_number, channel.first_index.span,
                 fmt::format("{} is not a range", in_quotes(channel.first_index.text)), "write 0xA000-0xA03F");
    interpret_number(channel.first_index, u16, said_already);
    return;
  }
  const auto offset = static_cast<std::uint32_t>(dash);
  const std::string both = channel.first_index.text;
  const Span span = channel.first_index.span;
  const auto set = [&findings](Field<std::uint16_t>& field, std::string_view text, Span place) {
    field.text = trimmed(text);
    field.span = place;
    field.is_given = true;
    interpret_number(field, u16, findings);
  };
  set(channel.first_index, std::string_view(both).substr(0, dash), {span.begin, span.begin + offset});
  set(channel.last_index, std::string_view(both).substr(dash + 1), {span.begin + offset + 1, span.end});
}

void interpret_channel(DynamicChannel& channel, Findings& findings) {
  interpret_number(channel.data_type, u16, findings);
  channel.access.value = access_named(channel.access.text);
  interpret_number(channel.offset, u32, findings);
  if (channel.first_index.is_given) {
    interpret_range(channel, findings);
  }
}

void read_dynamic_channels(const Section& section, const Reader& reader) {
  constexpr std::array<Slot<DynamicChannel>, 4> slots = {{
      {"Type", [](DynamicChannel& c) -> Text& { return c.data_type; }},
      {"Dir", [](DynamicChannel& c) -> Text& { return c.access; }},
      {"Range", [](DynamicChannel& c) -> Text& { return c.first_index; }},
      {"PPOffset", [](DynamicChannel& c) -> Text& { return c.offset; }},
  }};
  const std::size_t most = section.keys.size();  // limit of the segment numbers
  std::vector<DynamicChannel>& channels = reader.device.dynamic_channels;
  std::vector<OpaquePart> others;
  Field<std::uint32_t> count;
  for (const Key& key : section.keys) {
    const std::string_view name = reader.document.raw(key.name);
    std::uint32_t number = 0;
    const auto slot = std::find_if(slots.begin(), slots.end(), [name, &number](const Slot<DynamicChannel>& candidate) {
      return number_of(name, candidate.key, number);
    });
    if (compare_names(name, "NrOfSeg") == 0 && !key.is_duplicate) {
      static_cast<Text&>(count) = text_of(reader.document, key);
      interpret_number(count, u32, reader.findings);
    } else if (key.is_duplicate || slot == slots.end() || number == 0 || number > most) {
      store_opaque_key(key, others, reader);
    } else {
      channels.resize(std::max<std::size_t>(channels.size(), number));
      slot->member(channels[number - 1]) = text_of(reader.document, key);
    }
  }
  for (DynamicChannel& channel : channels) {
    interpret_channel(channel, reader.findings);
  }
  if (count.value != channels.size()) {
    reader.findings.add(rules::list_count, count.is_given ? count.span : section.name,
                        std::to_string(channels.size()) + " entries are there");
  }
  keep_section("DynamicChannels", std::move(others), section, reader.device);
}

void read_supported_modules(const Section& section, const Reader& reader) {
  constexpr std::array<Slot<Device>, 1> slots = {{{"NrOfEntries", [](Device& d) -> Text& { return d.module_count; }}}};
  std::vector<OpaquePart> others;
  read_section(reader.device, section, slots, others, reader);
  interpret_number(reader.device.module_count, u16, reader.findings);
  keep_section("SupportedModules", std::move(others), section, reader.device);
}

void read_connected_modules(const Section& section, const Reader& reader) {
  const NumberedList list = read_list(section, "NrOfEntries", "", Gaps::are_wrong, reader);
  for (const NumberedKey& entry : list.entries) {
    Field<std::uint16_t>& module = reader.device.connected_modules.emplace_back();
    static_cast<Text&>(module) = text_of(reader.document, *entry.key);
    interpret_number(module, u16, reader.findings);
  }
  std::vector<OpaquePart> others;
  for (const Key* key : list.others) {
    store_opaque_key(*key, others, reader);
  }
  keep_section("ConnectedModules", std::move(others), section, reader.device);
}

// Returns whether a text matches a pattern, in which 0 stands for a digit, ~ for A or P, and other characters for
// themselves.
bool has_form(std::string_view text, std::string_view pattern) {
  return text.size() == pattern.size() && std::equal(text.begin(), text.end(), pattern.begin(), [](char c, char p) {
           return p == '0' ? is_digit(c) : p == '~' ? c == 'A' || c == 'P' : c == p;
         });
}

bool is_version(std::string_view text) { return has_form(text, "0.0") && text >= "3.0" && text < "5.0"; }

void check_file_name(const FileInfo& file, const Reader& reader) {
  const std::string& path = reader.document.source().name();
  const std::string_view name = std::string_view(path).substr(path.find_last_of('/') + 1);
  if (!file.file_name.is_empty() && file.file_name.text != name && name != "<stdin>") {
    reader.findings.add(
        rules::file_name, file.file_name.span,
        fmt::format("FileName is {}, but the file is named {}", in_quotes(file.file_name.text), in_quotes(name)),
        "correct FileName, or rename the file");
  }
}

}  // namespace

void read_header(const NamedSection& header, const Reader& reader) {
  const std::string_view word = header.name.word;
  const Section& section = *header.section;
  if (word == "FileInfo") {
    read_file_info(section, reader);
  } else if (word == "DeviceInfo") {
    read_device_info(section, reader);
  } else if (word == "DummyUsage") {
    read_dummy_usage(section, reader);
  } else if (word == "Comments") {
    read_comments(section, reader);
  } else if (word == "SupportedModules") {
    read_supported_modules(section, reader);
  } else if (word == "ConnectedModules") {
    read_connected_modules(section, reader);
  } else if (word == "DynamicChannels") {
    read_dynamic_channels(section, reader);
  } else if (word.substr(0, 9) == "DeviceCom") {
    read_commissioning(header, reader);
  } else {
    read_object_list(header, reader);
  }
}

void check_headers(const Reader& reader) {
  const FileInfo& file = reader.device.file;
  check_file_name(file, reader);
  for (const Text* date : {&file.creation_date, &file.modification_date}) {
    if (!date->is_empty() && !has_form(date->text, "00-00-0000")) {
      reader.findings.add(rules::file_date, date->span, fmt::format("{} is not a date", in_quotes(date->text)),
                          "write month-day-year: 12-31-2020");
    }
  }
  for (const Text* time : {&file.creation_time, &file.modification_time}) {
    if (!time->is_empty() && !has_form(time->text, "00:00~M")) {
      reader.findings.add(rules::file_time, time->span, fmt::format("{} is not a time", in_quotes(time->text)),
                          "write hours:minutes with AM or PM: 09:30AM");
    }
  }
  if (!file.eds_version.is_empty() && !is_version(file.eds_version.text)) {
    reader.findings.add(rules::file_version, file.eds_version.span,
                        fmt::format("{} is not a version of CiA 306", in_quotes(file.eds_version.text)), "write 4.0");
  }
  for (const std::string_view name : {"FileInfo", "DeviceInfo", "MandatoryObjects"}) {
    if (reader.document.find(name) == nullptr) {
      reader.findings.add(rules::section_missing, {}, fmt::format("section [{}] is missing", name), "add it");
    }
  }
}

}  // namespace lexican::codict::eds
