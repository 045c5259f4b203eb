// SPDX-License-Identifier: Apache-2.0
#include "cli/command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <utility>

#include "check/check.hpp"
#include "cli/letters.hpp"
#include "cli/render.hpp"
#include "eds/suppressions.hpp"
#include "model/subject.hpp"
#include "text/file.hpp"
#include "text/number.hpp"
#include "text/similar.hpp"
#include "xdd/rules.hpp"
#include "xdd/suppressions.hpp"

namespace lexican::codict::cli {

std::optional<Input> load(const std::string& path) {
  std::string why;
  std::optional<Source> source = read_file(path, why);
  if (!source) {
    print_message(why);
    return std::nullopt;
  }
  const std::string name = source->name();
  std::optional<Input> input = read(std::move(*source), why);
  if (!input) {
    print_message(name + ": " + why);
  }
  return input;
}

std::optional<Input> open(const std::string& path) {
  std::optional<Input> input = load(path);
  if (input) {
    show_findings(*input, input->findings, [](const Finding& finding) { return finding.rule == &xdd::rules::syntax; });
  }
  return input;
}

void suppress(const Input& input, catalogue::Origin origin, Findings& findings) {
  const std::vector<Suppression> suppressions = input.eds != nullptr   ? eds::suppressions(*input.eds)
                                                : input.xdd != nullptr ? xdd::suppressions(*input.xdd)
                                                                       : std::vector<Suppression>();
  catalogue::suppress(input.source(), suppressions, origin, findings);
  for (const Device& device : input.description.devices) {
    name_subjects(device, findings);
  }
}

void check_all(Input& input) {
  for (const Device& device : input.description.devices) {
    check::check_all(device, input.findings);
  }
  suppress(input, catalogue::Origin::checks, input.findings);
}

std::string unknown_word_message(std::string_view what, std::string_view word,
                                 const std::vector<std::string_view>& words, std::string_view catalogue) {
  const std::vector<std::string_view> near = similar(word, words);
  return near.empty() ? fmt::format("unknown {} {}; {} lists all", what, word, catalogue)
                      : fmt::format("unknown {} {}; did you mean {}?", what, word, fmt::join(near, ", "));
}

void print_message(std::string_view text) { fmt::print(stderr, "codict: {}\n", visible(text)); }

bool is_terminal() { return ::isatty(STDOUT_FILENO) == 1; }

void print(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::string to_text(const Json& json) { return json.dump(2) + "\n"; }

void print_json(const Json& json) { print(to_text(json)); }

bool parse_reference(std::string_view text, Reference& reference) {
  if (equal_ignoring_case(text.substr(0, 2), "0x")) {
    text.remove_prefix(2);
  }
  std::size_t end = text.find(':');
  std::size_t sub = end == std::string_view::npos ? end : end + 1;
  if (end == std::string_view::npos && (end = text.find("sub")) != std::string_view::npos) {
    sub = end + 3;
  }
  std::uint64_t index = 0;
  std::uint64_t sub_index = 0;
  if (!parse_hex(text.substr(0, end), index) || index > 0xFFFF) {
    return false;
  }
  reference = {static_cast<std::uint16_t>(index), std::nullopt};
  if (sub == std::string_view::npos) {
    return true;
  }
  std::string_view digits = text.substr(sub);
  if (equal_ignoring_case(digits.substr(0, 2), "0x")) {
    digits.remove_prefix(2);
  }
  reference.sub_index = static_cast<std::uint8_t>(parse_hex(digits, sub_index) ? sub_index : 0);
  return parse_hex(digits, sub_index) && sub_index <= 0xFF;
}

std::string to_string(const Reference& reference) {
  return reference.sub_index ? fmt::format("{:04X}:{:02X}", reference.index, *reference.sub_index)
                             : fmt::format("{:04X}", reference.index);
}

const Entry* find(const Device& device, const Reference& reference) {
  return reference.sub_index ? device.find(reference.index, *reference.sub_index) : device.find(reference.index);
}

void add_node_id(Arguments& command, std::uint8_t& node_id) {
  command.add_option("--node-id", node_id, "Node-ID for the COB-IDs; default: that of the description, or 1")
      .in_hidden_range(1, 127);
}

std::uint8_t node_id_of(const Device& device, std::uint8_t asked) {
  const std::uint8_t configured = device.commissioning.node_id.value;
  return asked != 0 ? asked : configured >= 1 && configured <= 127 ? configured : std::uint8_t{1};
}

std::string type_name(const Entry& entry) {
  const std::uint16_t code = entry.data_type.value;
  const DataType& type = data_type(code);
  if (!type.name.empty()) {
    return std::string(type.name);
  }
  return code == 0 ? "-" : fmt::format("type {:04X}h", code);
}

}  // namespace lexican::codict::cli
