// SPDX-License-Identifier: Apache-2.0
#include "xdd/recognise.hpp"

#include <array>
#include <string_view>

#include "text/number.hpp"

namespace lexican::codict::xdd {

namespace {

struct Root {
  std::string_view name;
  Dialect dialect;
};

constexpr std::array<Root, 7> roots = {{
    {"ISO15745ProfileContainer", Dialect::container},
    {"ISO15745Profile", Dialect::container},
    {"ProfileContainer", Dialect::maxon},
    {"Profile", Dialect::maxon},
    {"DeviceProfile", Dialect::device_profile},
    {"CanOpenProject_1_1", Dialect::project},
    {"device", Dialect::canopennode},
}};

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

bool is_powerlink(const Document& document) {
  for (const pugi::xml_attribute attribute : document.root().attributes()) {
    if (contains(attribute.value(), "ethernet-powerlink")) {
      return true;
    }
  }
  // The head of the file, in which the first profile names its technology.
  const std::string_view head = document.source().bytes().substr(0, 4096);
  return contains(head, "ProfileTechnology>Powerlink<") || contains(head, "ProfileTechnology>POWERLINK<") ||
         contains(head, "_Powerlink\"");
}

std::string refusal_of_root(std::string_view name) {
  if (name == "EtherCATInfo") {
    return "this is a description of an EtherCAT device (ESI), not of CANopen";
  }
  if (name == "IODevice" || name == "GSDML" || name == "html") {
    return "this is no description of a CANopen device: its root is <" + std::string(name) + ">";
  }
  return "no ISO15745ProfileContainer or other root of a CANopen description: <" + std::string(name.substr(0, 80)) +
         ">";
}

}  // namespace

Dialect dialect_of(pugi::xml_node root) {
  const std::string_view name = local_name(root);
  for (const Root& known : roots) {
    if (equal_ignoring_case(name, known.name)) {
      return known.dialect;
    }
  }
  return Dialect::none;
}

std::string refusal(const Source& source) {
  const std::string_view bytes = source.bytes();
  const std::size_t first = bytes.find_first_not_of(" \t\r\n", mark_size(bytes));
  if (first == std::string_view::npos) {
    return "the file is empty";
  }
  if (guess_encoding(bytes) == Encoding::utf16) {
    return "the file is UTF-16: save it as UTF-8";
  }
  if (const std::string fault = nul_fault(source); !fault.empty()) {
    return fault;
  }
  if (bytes[first] == '<') {
    return {};
  }
  if (contains(bytes, "set_property") || contains(bytes, "create_clock") || contains(bytes, "get_ports")) {
    return "these are constraints of an FPGA design (Xilinx), no device description";
  }
  return "this is no XML";
}

std::string refusal(const Document& document) {
  if (document.is_too_deep()) {
    return "more than " + std::to_string(Document::most_levels) + " levels of elements: this is no device description";
  }
  if (!document.root()) {
    return "there is no XML element";
  }
  if (is_powerlink(document)) {
    return "this is a description of a POWERLINK device, not of CANopen";
  }
  return dialect_of(document.root()) == Dialect::none ? refusal_of_root(local_name(document.root())) : std::string();
}

}  // namespace lexican::codict::xdd
