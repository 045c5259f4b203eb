// SPDX-License-Identifier: Apache-2.0
#include "xdd/printer.hpp"

#include <algorithm>
#include <array>

#include "text/number.hpp"
#include "xdd/document.hpp"

namespace lexican::codict::xdd {

namespace {

// Elements that the schema of 1.1 declares locally, and which are therefore in no namespace. Sorted.
constexpr std::array<std::string_view, 56> local_elements = {"ApplicationLayers",
                                                             "BITSTRING",
                                                             "BOOL",
                                                             "BYTE",
                                                             "CANopenGeneralFeatures",
                                                             "CANopenMasterFeatures",
                                                             "CANopenObject",
                                                             "CANopenSubObject",
                                                             "CHAR",
                                                             "DINT",
                                                             "DWORD",
                                                             "ExternalProfileHandle",
                                                             "IASInterfaceType",
                                                             "INT",
                                                             "ISO15745Edition",
                                                             "ISO15745Part",
                                                             "ISO15745Reference",
                                                             "LINT",
                                                             "LREAL",
                                                             "LWORD",
                                                             "NetworkManagement",
                                                             "PhysicalLayer",
                                                             "ProfileBody",
                                                             "ProfileClassID",
                                                             "ProfileDate",
                                                             "ProfileHeader",
                                                             "ProfileIdentification",
                                                             "ProfileName",
                                                             "ProfileRevision",
                                                             "ProfileSource",
                                                             "ProfileTechnology",
                                                             "REAL",
                                                             "SINT",
                                                             "STRING",
                                                             "TransportLayers",
                                                             "UDINT",
                                                             "UINT",
                                                             "ULINT",
                                                             "USINT",
                                                             "WORD",
                                                             "WSTRING",
                                                             "baudRate",
                                                             "description",
                                                             "descriptionRef",
                                                             "deviceCommissioning",
                                                             "dummy",
                                                             "dummyUsage",
                                                             "dynamicChannel",
                                                             "dynamicChannels",
                                                             "identity",
                                                             "label",
                                                             "labelRef",
                                                             "maxValue",
                                                             "minValue",
                                                             "step",
                                                             "supportedBaudRate"};

static_assert(!local_elements.back().empty());

bool is_local(std::string_view name) { return std::binary_search(local_elements.begin(), local_elements.end(), name); }

// Returns a valid XML name. Names of other formats may be invalid: each invalid character becomes an underscore.
std::string written_name(std::string_view name) {
  std::string result(name);
  std::replace_if(
      result.begin(), result.end(),
      [](char c) {
        const bool is_letter = (to_lower(c) >= 'a' && to_lower(c) <= 'z') || static_cast<unsigned char>(c) >= 0x80;
        return !is_letter && !is_digit(c) && c != '_' && c != '-' && c != '.' && c != ':';
      },
      '_');
  const bool is_begun = !result.empty() && (is_digit(result.front()) || result.front() == '-' || result.front() == '.');
  return (is_begun || result.empty() ? "_" : "") + result;
}

bool is_attribute(const OpaquePart& opaque_part) { return opaque_part.name.substr(0, 1) == "@"; }

}  // namespace

OpaqueParts::OpaqueParts(const std::vector<OpaquePart>& others) {
  for (const OpaquePart& opaque_part : others) {
    all_.push_back(&opaque_part);
  }
}

const OpaquePart* OpaqueParts::remove_first(std::string_view name) {
  const auto place = std::find_if(all_.begin(), all_.end(),
                                  [name](const OpaquePart* opaque_part) { return opaque_part->name == name; });
  if (place == all_.end()) {
    return nullptr;
  }
  const OpaquePart* const found = *place;
  all_.erase(place);
  return found;
}

const OpaquePart* OpaqueParts::remove_remainder(std::string_view name, std::string_view attribute) {
  const auto is_left = [name, attribute](const OpaquePart* opaque_part) {
    return opaque_part->name == name && !opaque_part->text.is_given &&
           std::none_of(opaque_part->children.begin(), opaque_part->children.end(),
                        [attribute](const OpaquePart& child) { return child.name == "@" + std::string(attribute); });
  };
  const auto place = std::find_if(all_.begin(), all_.end(), is_left);
  if (place == all_.end()) {
    return nullptr;
  }
  const OpaquePart* const found = *place;
  all_.erase(place);
  return found;
}

OpaqueParts parts_inside(const OpaquePart* remainder) {
  return remainder != nullptr ? OpaqueParts(remainder->children) : OpaqueParts();
}

Printer::Printer(Edition edition) : edition_(edition), text_("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n") {}

std::string Printer::full(std::string_view name) const {
  return (is_qualified() || is_local(name) ? "" : "co:") + written_name(name);
}

void Printer::indent() { text_.append(open_.size() * 2, ' '); }

void Printer::end_tag() {
  if (is_tag_open_) {
    text_ += ">\n";
    is_tag_open_ = false;
  }
}

void Printer::open(std::string_view name) {
  end_tag();
  indent();
  open_.push_back(full(name));
  text_ += "<" + open_.back();
  is_tag_open_ = true;
}

void Printer::attribute(std::string_view name, std::string_view text) {
  text_ += " " + written_name(name) + "=\"" + escaped_attribute(text) + "\"";
}

void Printer::attribute(std::string_view name, const Text& text) {
  if (text.is_given) {
    attribute(name, std::string_view(text.text));
  }
}

void Printer::text(std::string_view text) {
  if (!text.empty()) {
    text_ += ">" + escaped(text);
    is_tag_open_ = false;
    has_text_ = true;
  }
}

void Printer::close() {
  const std::string name = open_.back();
  open_.pop_back();
  if (is_tag_open_) {
    text_ += "/>\n";
  } else {
    if (!has_text_) {
      indent();
    }
    text_ += "</" + name + ">\n";
  }
  is_tag_open_ = false;
  has_text_ = false;
}

void Printer::element(std::string_view name, std::string_view content) {
  open(name);
  text(content);
  close();
}

void Printer::print_opaque(const OpaquePart& part) {
  if (part.name.empty() || is_attribute(part)) {
    return;
  }
  const OpaqueParts opaque(part.children);
  open(part.name);
  attributes_of(opaque);
  const bool has_elements = std::any_of(part.children.begin(), part.children.end(),
                                        [](const OpaquePart& child) { return !is_attribute(child); });
  if (has_elements) {
    elements_of(opaque);
    if (!part.text.is_empty()) {
      text_ += escaped(part.text.text) + "\n";
    }
  } else {
    text(part.text.text);
  }
  close();
}

void Printer::attributes_of(const OpaqueParts& opaque) {
  for (const OpaquePart* part : opaque.all()) {
    if (is_attribute(*part)) {
      attribute(std::string_view(part->name).substr(1), std::string_view(part->text.text));
    }
  }
}

void Printer::elements_of(const OpaqueParts& opaque) {
  for (const OpaquePart* one : opaque.all()) {
    print_opaque(*one);
  }
}

}  // namespace lexican::codict::xdd
