// SPDX-License-Identifier: Apache-2.0
#include "xdd/set_type.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "model/types.hpp"
#include "text/number.hpp"

namespace lexican::codict::xdd {

namespace {

// Returns the data type with a code or name; null if CiA 301 does not define it.
const DataType* type_of(std::string_view text) {
  std::uint64_t code = 0;
  const std::string_view digits = equal_ignoring_case(text.substr(0, 2), "0x") ? text.substr(2) : text;
  const DataType* const type =
      parse_hex(digits, code) && code <= 0xFFFF ? &data_type(static_cast<std::uint16_t>(code)) : data_type_named(text);
  return type != nullptr && type->kind != TypeKind::unknown ? type : nullptr;
}

// Returns the type element of CiA 311. BITSTRING is used for types without an element; the object gives their code
// then.
std::string_view element_of(const DataType& type) { return type.iec.empty() ? "BITSTRING" : type.iec; }

bool needs_attribute(const DataType& type) { return element_of(type) == "BITSTRING"; }

// Renames an element such as <USINT/> or <p:USINT></p:USINT>. tag: its start tag.
bool rename_element(const Document& document, Span tag, std::string_view name, Edits& edits) {
  const std::string_view text = document.raw(tag);
  const std::string_view full = text.substr(1, text.find_first_of(" \t\r\n/>") - 1);
  const std::size_t prefix = full.size() - local_name(full).size();
  const auto rename = [&](std::size_t begin) {
    edits.replace({static_cast<std::uint32_t>(begin + prefix), static_cast<std::uint32_t>(begin + full.size())},
                  std::string(name));
  };
  rename(tag.begin + 1);
  if (text[text.size() - 2] == '/') {
    return true;
  }
  const std::size_t end = document.source().bytes().find("</" + std::string(full), tag.end);
  if (end != std::string_view::npos) {
    rename(end + 2);
  }
  return end != std::string_view::npos;
}

// Sets the type of a parameter, which is an element's name or, in the dialect of maxon, an element's text.
bool set_parameter_type(const Document& document, const Entry& entry, const DataType& type, Edits& edits) {
  const Span place = entry.type->iec.span;
  return document.raw(place).substr(0, 1) == "<" ? rename_element(document, place, element_of(type), edits)
                                                 : document.set_text(place, type.name, edits);
}

bool set_object_type(const Document& document, const Entry& entry, const DataType& type, Edits& edits) {
  const std::string digits =
      fmt::format("{:0{}X}", type.code, entry.data_type.text.size() == 4 ? 4 : 2);  // as many as before
  if (entry.data_type.is_given) {
    return document.set_text(entry.data_type.span, digits, edits);
  }
  return !needs_attribute(type) || document.add_attribute(entry.span.begin, "dataType", digits, edits);
}

}  // namespace

bool has_parameter_type(const Entry& entry) {
  return entry.type->iec.is_given || entry.type->reference.is_given || entry.type->code != 0;
}

bool set_type(const Document& document, const Entry& entry, std::string_view type, Edits& edits, std::string& why) {
  const DataType* const wanted = type_of(type);
  if (wanted == nullptr) {
    why = "this is no data type of CiA 301: " + std::string(type);
    return false;
  }
  if (!entry.type->iec.is_given) {
    why = "the type is that of " +
          (entry.type->reference.is_given ? "the data type " + entry.type->reference.text
                                          : "the template " + entry.template_id->text) +
          ", which others may use, too: it is not changed";
    return false;
  }
  why = "the file cannot hold this type";
  return set_parameter_type(document, entry, *wanted, edits) && set_object_type(document, entry, *wanted, edits);
}

}  // namespace lexican::codict::xdd
