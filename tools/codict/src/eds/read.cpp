// SPDX-License-Identifier: Apache-2.0
#include "eds/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

struct SortedSections {
  std::vector<NamedSection> headers;
  std::vector<NamedSection> objects;
  std::vector<NamedSection> additions;
  std::vector<NamedSection> modules;
  std::vector<NamedSection> others;
};

void report_form(const NamedSection& named, const Reader& reader) {
  const std::string name = shortened(reader.document.text(named.section->name));
  if (named.name.has_odd_zeros) {
    reader.findings.add(rules::section_zeros, named.section->name,
                        fmt::format("missing or extra leading zeros in [{}]", name),
                        "write four digits for an index, none too many for a sub-index");
  }
  if (named.name.has_mark) {
    const std::string index = fmt::format("{:04X}", named.name.index);
    const bool is_plain = named.name.kind == SectionKind::object || named.name.kind == SectionKind::sub;
    const std::string sub = named.name.is_sub ? fmt::format("sub{:X}", named.name.sub_index) : "";
    reader.findings.add(rules::section_mark, named.section->name,
                        fmt::format("0x or h in [{}], read as index {}h", name, index),
                        is_plain ? fmt::format("write [{}{}]", index, sub) : fmt::format("write only {} there", index));
  }
  if (named.name.has_odd_case) {
    reader.findings.add(rules::section_form, named.section->name, fmt::format("unusual capitals in [{}]", name),
                        "write digits in capitals, sub in small letters");
  }
}

std::vector<NamedSection>& place_of(SectionKind kind, SortedSections& sorted) {
  switch (kind) {
    case SectionKind::header: return sorted.headers;
    case SectionKind::object:
    case SectionKind::sub: return sorted.objects;
    case SectionKind::names:
    case SectionKind::values:
    case SectionKind::denotations:
    case SectionKind::links: return sorted.additions;
    case SectionKind::module:
    case SectionKind::module_fixed:
    case SectionKind::module_extension: return sorted.modules;
    case SectionKind::other: break;
  }
  return sorted.others;
}

SortedSections sort_sections(const Reader& reader) {
  SortedSections sorted;
  for (const Section& section : reader.document.sections()) {
    const NamedSection named{section_name(reader.document, section), &section};
    report_form(named, reader);
    place_of(named.name.kind, sorted).push_back(named);
  }
  return sorted;
}

void read_headers(const std::vector<NamedSection>& headers, const Reader& reader) {
  for (const NamedSection& header : headers) {
    if (header.section->is_duplicate) {
      reader.device.others.push_back(opaque_part(reader.document, *header.section));
    } else {
      read_header(header, reader);
    }
  }
  check_headers(reader);
}

// Reports a sub-index above FFh, by which sub-indexes in decimal are detected.
void report_large_sub(const NamedSection& named, Findings& findings) {
  const std::uint16_t index = named.name.index;
  std::uint32_t decimal = 0;
  const bool is_decimal = number_of(named.name.large_sub, "", decimal) && decimal <= 0xFF;
  findings.add(rules::sub_index, named.section->name,
               fmt::format("sub-index of {:04X}h beyond FFh; the section is not used", index),
               is_decimal ? fmt::format("sub-indexes are hexadecimal: write [{0:04X}sub{1:X}] for decimal {1}, and the "
                                        "others of {0:04X}h likewise",
                                        index, decimal)
                          : "sub-indexes are 0 to FEh, and FFh for the structure of the object");
}

// Keeps and reports unknown sections. [Tools] is a section of CiA 405; CANeds writes [ToolInfos] and [PreDefines].
void keep_others(const std::vector<NamedSection>& others, const Reader& reader) {
  for (const NamedSection& named : others) {
    const std::string_view name = reader.document.raw(named.section->name);
    if (!named.name.large_sub.empty()) {
      report_large_sub(named, reader.findings);
    } else if (compare_names(name, "Tools") != 0 && !named.section->is_duplicate) {
      reader.findings.add(
          rules::section_unknown, named.section->name,
          fmt::format("section {} is unknown to CiA 306", in_quotes(reader.document.text(named.section->name))),
          "check the spelling");
    }
    reader.device.others.push_back(opaque_part(reader.document, *named.section));
  }
  if (!reader.document.keys_outside().empty()) {
    OpaquePart outside;
    for (const Key& key : reader.document.keys_outside()) {
      outside.children.push_back(opaque_part(reader.document, key));
    }
    reader.device.others.push_back(std::move(outside));
  }
}

bool has_ending(std::string_view path, std::string_view ending) {
  return path.size() > ending.size() && equal_ignoring_case(path.substr(path.size() - ending.size()), ending);
}

}  // namespace

Description read(const Document& document, Findings& findings) {
  Description description;
  Device& device = description.devices.emplace_back();
  std::size_t implied_subs = 0;
  const Reader reader{document, device, findings, implied_subs};
  SortedSections sorted = sort_sections(reader);
  read_headers(sorted.headers, reader);
  device.objects = read_objects(std::move(sorted.objects), device.others, reader);
  for (const NamedSection& addition : sorted.additions) {
    read_addition(addition, reader);
  }
  for (Object& object : device.objects) {
    interpret_values(object, reader);
  }
  add_implied_pdos(reader);
  read_modules(sorted.modules, reader);
  check_lists(reader);
  keep_others(sorted.others, reader);
  const bool is_dcf = device.commissioning.is_given || device.file.last_eds.is_given;
  device.format = is_dcf || has_ending(document.source().name(), ".dcf") ? Format::dcf : Format::eds;
  findings.sort();
  return description;
}

}  // namespace lexican::codict::eds
