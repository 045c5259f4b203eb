// SPDX-License-Identifier: Apache-2.0
#include "doc/items.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace lexican::codict::doc {

namespace {

std::string type_name(const Device& device, const Entry& entry) {
  const std::uint16_t code = entry.data_type.value;
  const DataType& type = data_type_of(device, code);
  if (!type.name.empty()) {
    return std::string(type.name);
  }
  const Object* const own = device.find(code);
  if (code != 0 && own != nullptr && !own->name.is_empty()) {
    return own->name.text;
  }
  return code != 0 ? fmt::format("type {:04X}h", code) : "";
}

std::string access_name(Access access) { return access == Access::unknown ? "" : std::string(name_of(access)); }

std::string mapping_name(const Entry& entry) {
  const Directions directions = directions_of(entry);
  if (directions.receive && directions.send) {
    return "RPDO, TPDO";
  }
  return directions.receive ? "RPDO" : directions.send ? "TPDO" : "";
}

std::string range_of(const Entry& entry) {
  const std::string& low = entry.low_limit->text;
  const std::string& high = entry.high_limit->text;
  if (low.empty() && high.empty()) {
    return "";
  }
  if (high.empty()) {
    return "from " + low;
  }
  return low.empty() ? "up to " + high : low + " … " + high;
}

std::string unit_of(const Entry& entry, const Options& options) {
  const std::string_view label = text_in(entry.unit->texts.labels, options.language);
  const std::string unit = label.empty() ? entry.unit->uri.text : std::string(label);
  const std::string& multiplier = entry.unit->multiplier.text;
  return multiplier.empty() || multiplier == "1" ? unit : multiplier + " " + unit;
}

std::vector<Fact> allowed_values(const Device& device, const Entry& entry, const Options& options) {
  std::vector<Fact> facts;
  for (const AllowedValue& allowed : allowed_values_of(device, entry)) {
    facts.push_back({allowed.value.text, std::string(text_in(allowed.texts.labels, options.language))});
  }
  return facts;
}

constexpr std::uint32_t refuses_write = 1;
constexpr std::uint32_t refuses_read = 2;
constexpr std::uint32_t needs_reset = 4;

std::vector<std::string> words_of(const Entry& entry, const Options& options) {
  std::vector<std::string> words;
  const std::string_view description = text_in(entry.texts->descriptions, options.language);
  if (!description.empty()) {
    words.emplace_back(description);
  }
  if ((entry.flags->value & refuses_write) != 0) {
    words.emplace_back("Not written when a device is configured.");
  }
  if ((entry.flags->value & refuses_read) != 0) {
    words.emplace_back("Not read when a device is scanned.");
  }
  if ((entry.flags->value & needs_reset) != 0) {
    words.emplace_back("Takes effect after a reset.");
  }
  if (entry.node->byte_length->value != 0) {
    words.push_back(fmt::format("Has room for {} bytes.", entry.node->byte_length->value));
  }
  if (entry.node->string_length_min->value != 0) {
    words.push_back(fmt::format("Has room for {} characters.", entry.node->string_length_min->value));
  }
  if (entry.node->disabled->value) {
    words.emplace_back("Disabled: not in the device.");
  }
  return words;
}

void describe(const Device& device, const Entry& entry, const Options& options, Item& item) {
  item.name = name_in(entry, options);
  item.type = type_name(device, entry);
  item.access = access_name(entry.access.value);
  item.mapping = mapping_name(entry);
  item.default_value = entry.default_value.text;
  item.value = entry.actual_value->text;
  item.range = range_of(entry);
  item.unit = unit_of(entry, options);
  item.group = named_group(entry.node);
  item.allowed = allowed_values(device, entry, options);
  item.words = words_of(entry, options);
}

}  // namespace

std::string number_of(std::uint16_t index) { return fmt::format("{:04X}h", index); }
std::string number_of(std::uint16_t index, std::uint8_t sub_index) {
  return fmt::format("{:04X}h:{:X}", index, sub_index);
}
std::string anchor_of(std::uint16_t index) { return fmt::format("o-{:04X}", index); }
std::string anchor_of(std::uint16_t index, std::uint8_t sub_index) {
  return fmt::format("o-{:04X}-{:X}", index, sub_index);
}

std::string name_in(const Entry& entry, const Options& options) {
  const std::string_view label = text_in(entry.texts->labels, options.language);
  return label.empty() ? entry.name.text : std::string(label);
}

ObjectItem item_of(const Device& device, const Object& object, const Options& options) {
  ObjectItem result;
  result.has_subs = !object.subs.empty() || has_sub_objects(object.object_code.value);
  if (result.has_subs) {
    result.object.name = name_in(object, options);
    result.object.type = std::string(name_of(object.object_code.value));
    result.object.group = named_group(object.node);
    result.object.words = words_of(object, options);
  } else {
    describe(device, object, options, result.object);
  }
  result.object.number = number_of(object.index);
  result.object.anchor = anchor_of(object.index);
  for (const Sub& sub : object.subs) {
    Item& item = result.subs.emplace_back();
    describe(device, sub, options, item);
    item.number = number_of(object.index, sub.sub_index);
    item.anchor = anchor_of(object.index, sub.sub_index);
  }
  return result;
}

}  // namespace lexican::codict::doc
