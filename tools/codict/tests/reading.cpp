// SPDX-License-Identifier: Apache-2.0
#include "reading.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "check/check.hpp"
#include "eds/read.hpp"
#include "eds/recognise.hpp"
#include "text/file.hpp"

namespace test {

using namespace lexican::codict;

namespace {

Source source_of(const std::string& path) {
  std::string why;
  std::optional<Source> source = read_file(path, why);
  if (!source) {
    throw std::runtime_error(why);
  }
  return std::move(*source);
}

}  // namespace

std::string fixture(const std::string& name) { return std::string(LEXICAN_CODICT_FIXTURES) + "/" + name; }

Reading::Reading(const std::string& name)
    : document(source_of(fixture(name)), findings),
      description(eds::read(document, findings)),
      device(description.devices.front()) {
  if (!eds::refusal(document.source()).empty() || !eds::refusal(document).empty()) {
    throw std::runtime_error(name + " is refused");
  }
  check::check_objects(device, findings);
  check::check_device(device, findings);
  findings.sort();
}

std::string Reading::found() const {
  std::string text;
  for (const Finding& finding : findings.all()) {
    const Position position = document.source().position(finding.span.begin);
    text += fmt::format("{}:{} {}\n", position.line, position.column, finding.rule->id);
  }
  return text;
}

const Entry& Reading::at(std::uint16_t index, std::uint8_t sub_index) const {
  const Object* const object = device.find(index);
  const Entry* const entry =
      sub_index == 0 && object != nullptr && object->subs.empty() ? object : device.find(index, sub_index);
  if (entry == nullptr) {
    throw std::runtime_error(fmt::format("no object {:04X}h sub-index {}", index, sub_index));
  }
  return *entry;
}

const Value& Reading::value(std::uint16_t index, std::uint8_t sub_index) const {
  return at(index, sub_index).default_value;
}

std::string meaning(const Value& value) {
  switch (value.kind) {
    case Value::Kind::none: return "none";
    case Value::Kind::integer:
      return fmt::format("{}{}{}", value.adds_node_id ? "$NODEID+" : "", value.integer.is_negative ? "-" : "",
                         value.integer.magnitude);
    case Value::Kind::real: return fmt::format("{:g}", value.real);
    case Value::Kind::text: return fmt::format("\"{}\"", value.text);
    case Value::Kind::octets: {
      std::string text = "octets";
      for (const char octet : *value.octets) {
        text += fmt::format(" {:02X}", static_cast<unsigned char>(octet));
      }
      return text;
    }
    case Value::Kind::malformed: break;
  }
  return "malformed";
}

bool is_well_said(const lexican::codict::Finding& finding) {
  constexpr std::size_t longest = 110;  // three shortened names and the fault
  const std::string beginning = finding.text.substr(0, 5);
  const bool is_ideal = beginning == "there" || beginning == "this " || beginning == "a key" || beginning == "an un";
  return !finding.text.empty() && finding.text.size() <= longest && finding.text.back() != '.' && !is_ideal &&
         !finding.hint.empty() && finding.hint.size() <= longest && finding.hint.back() != '.';
}

}  // namespace test
