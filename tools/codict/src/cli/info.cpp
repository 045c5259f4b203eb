// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/letters.hpp"

namespace lexican::codict::cli {

namespace {

struct InfoOptions {
  std::string file;
  bool is_json = false;
};

std::size_t count_between(const Device& device, std::uint16_t first, std::uint16_t last) {
  return static_cast<std::size_t>(
      std::count_if(device.objects.begin(), device.objects.end(),
                    [=](const Object& object) { return object.index >= first && object.index <= last; }));
}

std::vector<std::uint32_t> bit_rates(const Device& device) {
  std::vector<std::uint32_t> rates;
  for (const BitRate& rate : device.features.bit_rates) {
    if (rate.supported.value) {
      rates.push_back(rate.kbit);
    }
  }
  return rates;
}

void add(Json& json, const char* name, const Text& text) {
  if (!text.is_empty()) {
    json[name] = text.text;
  }
}

Json describe(const Input& input) {
  const Device& device = input.device();
  Json json;
  json["schema"] = "codict-info-1";
  json["file"] = input.source().name();
  json["format"] = (input.json != nullptr ? "JSON, " : "") + std::string(name_of(device.format));
  json["encoding"] = name_of(input.encoding());
  add(json, "vendor", device.identity.vendor_name);
  add(json, "vendor_number", device.identity.vendor_number);
  add(json, "product", device.identity.product_name);
  add(json, "product_number", device.identity.product_number);
  add(json, "revision_number", device.identity.revision_number);
  if (!device.identity.order_codes.empty()) {
    add(json, "order_code", device.identity.order_codes.front());
  }
  add(json, "description", device.file.description);
  json["bit_rates"] = bit_rates(device);
  std::size_t variables = 0;
  for_each_variable(device, [&variables](std::uint16_t, std::uint8_t, const Entry&) { ++variables; });
  json["objects"] = device.objects.size();
  json["variables"] = variables;
  json["receive_pdos"] = count_between(device, 0x1400, 0x15FF);
  json["transmit_pdos"] = count_between(device, 0x1800, 0x19FF);
  json["sdo_servers"] = count_between(device, 0x1200, 0x127F);
  json["sdo_clients"] = count_between(device, 0x1280, 0x12FF);
  if (!device.modules.empty()) {
    json["modules"] = device.modules.size();
  }
  if (device.commissioning.is_given) {
    add(json, "node_id", device.commissioning.node_id);
    add(json, "node_name", device.commissioning.node_name);
    add(json, "bit_rate", device.commissioning.bit_rate);
  }
  return json;
}

// Returns a title for the output as text: "Receive PDOs" for "receive_pdos".
std::string title(const std::string& name) {
  constexpr std::array<std::string_view, 3> abbreviations = {"pdo", "sdo", "id"};
  std::string result;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end = std::min(name.find('_', at), name.size());
    std::string word = name.substr(at, end - at);
    const bool is_abbreviation = std::any_of(abbreviations.begin(), abbreviations.end(), [&word](std::string_view a) {
      return word == a || word == std::string(a) + "s";
    });
    const std::size_t capitals = is_abbreviation ? word.find_last_not_of('s') + 1 : at == 0 ? 1 : 0;
    std::transform(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(capitals), word.begin(),
                   [](char c) { return static_cast<char>(c - 'a' + 'A'); });
    result += (at == 0 ? "" : " ") + word;
    at = end + 1;
  }
  return result;
}

std::string plain(const Json& value) {
  if (value.is_string()) {
    return value.text();
  }
  if (!value.is_array()) {
    return value.dump();
  }
  std::string text;
  for (const Json& element : value.elements()) {
    text += (text.empty() ? "" : " ") + element.dump();
  }
  return text.empty() ? "-" : text;
}

int run_info(const InfoOptions& options) {
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  const Json json = describe(*input);
  if (options.is_json) {
    print_json(json);
    return clean;
  }
  for (const auto& [name, value] : json.members()) {
    if (name != "schema") {
      print(fmt::format("{:<16} {}\n", title(name), visible(plain(value))));
    }
  }
  return clean;
}

}  // namespace

Command add_info(CommandLine& line) {
  const auto options = std::make_shared<InfoOptions>();
  Arguments command = line.add_command("info", "Show what device a description is of");
  command.add_option("file", options->file, file_help).required();
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_info(*options); }};
}

}  // namespace lexican::codict::cli
