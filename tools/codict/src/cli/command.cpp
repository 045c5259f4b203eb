// SPDX-License-Identifier: Apache-2.0
#include "cli/command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <type_traits>
#include <utility>

#include "check/check.hpp"
#include "cli/letters.hpp"
#include "cli/render.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "eds/suppressions.hpp"
#include "json/read.hpp"
#include "model/subject.hpp"
#include "text/file.hpp"
#include "text/number.hpp"
#include "text/similar.hpp"
#include "xdd/read.hpp"
#include "xdd/recognise.hpp"
#include "xdd/rules.hpp"
#include "xdd/suppressions.hpp"

namespace lexican::codict::cli {

namespace {

// Returns true if the first character is an angle bracket: XML begins with one, an EDS never does. Skips zero bytes
// (UTF-16 without byte order mark), then a byte order mark and white space.
bool is_xml(std::string_view bytes) {
  constexpr std::string_view before = "\xEF\xBB\xBF\xFE\xFF \t\r\n";
  const std::size_t first = bytes.find_first_not_of(std::string_view("\0", 1));
  const std::size_t begin = first == std::string_view::npos ? first : bytes.find_first_not_of(before, first);
  return begin != std::string_view::npos && bytes[begin] == '<';
}

template <typename Document>
std::unique_ptr<Document> document_of(Source source, Findings& findings) {
  if constexpr (std::is_constructible_v<Document, Source>) {  // reports its fault by refusal(), not as a finding
    return std::make_unique<Document>(std::move(source));
  } else {
    return std::make_unique<Document>(std::move(source), findings);
  }
}

// Reads a description in one format: refusal() checks the bytes, then the parsed document. Returns the reason if that
// fails, else an empty string.
template <typename Document, typename Refuse, typename Read>
std::string read_as(Source source, Refuse refusal, Read read, std::unique_ptr<const Document>& result, Input& input) {
  std::string why = refusal(source);
  if (!why.empty()) {
    return why;
  }
  std::unique_ptr<Document> document = document_of<Document>(std::move(source), input.findings);
  why = refusal(*document);
  if (why.empty()) {
    input.description = read(*document, input.findings);
    result = std::move(document);
  }
  return why;
}

}  // namespace

const Source& Input::source() const {
  return eds != nullptr ? eds->source() : xdd != nullptr ? xdd->source() : json->source();
}

Encoding Input::encoding() const {
  return eds != nullptr ? eds->encoding() : xdd != nullptr ? xdd->encoding() : json->encoding();
}

std::optional<Input> read(Source source, std::string& why) {
  Input input;
  if (is_xml(source.bytes())) {
    why = read_as(
        std::move(source), [](const auto& what) { return xdd::refusal(what); }, xdd::read, input.xdd, input);
  } else if (json::is_json(source)) {
    why = read_as(
        std::move(source), [](const auto& what) { return json::refusal(what); }, json::read, input.json, input);
  } else {
    why = read_as(
        std::move(source), [](const auto& what) { return eds::refusal(what); }, eds::read, input.eds, input);
  }
  return why.empty() ? std::optional<Input>(std::move(input)) : std::nullopt;
}

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
