// SPDX-License-Identifier: Apache-2.0
#include "eds/recognise.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "eds/names.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

// Limits. The largest known files have 0.5 MB and 5000 sections.
constexpr std::size_t most_bytes = std::size_t{16} * 1024 * 1024;
constexpr std::size_t most_sections = 100000;

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// Returns whether a file is a symbolic link that a checkout without links has written as a file with its target.
bool is_link(std::string_view bytes) {
  return bytes.size() < 4096 && contains(bytes, "/") && bytes.find_first_of("[=\n ;") == std::string_view::npos;
}

std::string refusal_without_sections(const Document& document) {
  const std::string_view bytes = document.source().bytes();
  if (is_link(bytes)) {
    return "this is the name that a symbolic link had, no device description: " + std::string(bytes);
  }
  if (contains(bytes, "set_property") || contains(bytes, "create_clock") || contains(bytes, "get_ports")) {
    return "these are constraints of an FPGA design (Xilinx), no device description";
  }
  return "no section [FileInfo], [DeviceInfo] or of an object: this is no EDS or DCF";
}

bool is_word(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return to_lower(c) >= 'a' && to_lower(c) <= 'z'; });
}

// Returns whether types are words (ObjectType=VAR, DataType=UNSIGNED32), as in a dialect with the same section names.
bool has_words_for_types(const Document& document) {
  for (const Section& section : document.sections()) {
    const Key* const type = document.find(section, "ObjectType");
    if (type != nullptr && section_name(document, section).kind == SectionKind::object) {
      return is_word(document.raw(type->value));
    }
  }
  return false;
}

}  // namespace

std::string refusal(const Source& source) {
  const std::string_view bytes = source.bytes();
  const std::size_t first = bytes.find_first_not_of(" \t\r\n", mark_size(bytes));
  if (first == std::string_view::npos) {
    return "the file is empty";
  }
  if (guess_encoding(bytes) == Encoding::utf16) {
    return "the file is UTF-16: save it as ASCII or UTF-8";
  }
  if (const std::string fault = nul_fault(source); !fault.empty()) {
    return fault;
  }
  if (bytes.size() > most_bytes) {
    return "more than 16 MB: this is no EDS or DCF";
  }
  return bytes[first] == '<' ? "this is XML, no EDS or DCF" : std::string();
}

std::string refusal(const Document& document) {
  if (document.sections().size() > most_sections) {
    return "more than 100000 sections: this is no EDS or DCF";
  }
  if (document.find("File") != nullptr && document.find("Device") != nullptr) {
    return "this is an EDS of ODVA (EtherNet/IP, DeviceNet), not of CANopen";
  }
  if (document.find("Topology") != nullptr) {
    return "this is the topology of a network (CPJ), no device description";
  }
  const auto& sections = document.sections();
  const bool is_known = std::any_of(sections.begin(), sections.end(), [&document](const Section& section) {
    return section_name(document, section).kind != SectionKind::other;
  });
  if (!is_known) {
    return refusal_without_sections(document);
  }
  if (has_words_for_types(document)) {
    return "types are words here (ObjectType=VAR), as in the dialect of socanmatic: this is no EDS of CiA 306";
  }
  return {};
}

}  // namespace lexican::codict::eds
