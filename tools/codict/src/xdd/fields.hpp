// SPDX-License-Identifier: Apache-2.0
/// \file fields.hpp
/// Attributes and elements become members of the model, by tables. What no table has is kept.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/device.hpp"
#include "text/finding.hpp"
#include "text/number.hpp"
#include "xdd/document.hpp"
#include "xdd/recognise.hpp"
#include "xdd/rules.hpp"

namespace lexican::codict::xdd {

using Ids = std::unordered_map<std::string_view, pugi::xml_node>;

/// What the parts of the reader share about one device.
struct Shared {
  Dialect dialect = Dialect::container;
  Ids types;
  Ids parameters;
  Ids templates;
  Ids flags;                                                  ///< of maxon: what can be done with a parameter
  Ids enum_entries;                                           ///< of maxon
  std::unordered_map<std::string_view, bool> used;            ///< parameters that an object refers to
  std::unordered_map<std::string_view, std::uint16_t> codes;  ///< of the types that have been asked for
  std::vector<pugi::xml_node> indexed;                        ///< parameters of maxon, each with an index of its own
  std::vector<bool> objects = std::vector<bool>(0x10000);     ///< by index: which ones are there
  /// Bytes that may be read again because something refers to them: what a fuzzer nests must not grow.
  std::size_t copies_left = 0;
};

struct Reader {
  const Document& document;
  Device& device;
  Findings& findings;
  Shared& shared;
};

Kept kept(const Document& document, pugi::xml_attribute attribute);
Kept kept(const Document& document, pugi::xml_node element);

/// Declarations of namespaces and the like, which belong to XML.
bool is_syntax(pugi::xml_attribute attribute);
bool is_leaf(pugi::xml_node element);  ///< without elements and attributes

/// Whether a name is meant; in other capitals, with a finding.
bool is_named(std::string_view name, std::string_view wanted, Span span, const Reader& reader);

/// Keeps what no table knows, with a finding if CiA 311 does not know it either.
void keep(pugi::xml_attribute attribute, std::vector<Kept>& others, const Reader& reader);
void keep(pugi::xml_node element, std::vector<Kept>& others, const Reader& reader);
/// What is left of an element, if anything is.
void keep_rest(pugi::xml_node element, std::vector<Kept> rest, std::vector<Kept>& others, const Reader& reader);

void report_duplicate(Span place, const Reader& reader);

/// The name of an attribute or element, and the member that it becomes.
template <typename T>
struct Slot {
  std::string_view name;
  Text& (*member)(T&);
};

/// False if no slot is that of the name, or its member has a text already.
template <typename T, std::size_t size>
bool read_into(T& target, std::string_view name, Text text, Span place, const std::array<Slot<T>, size>& slots,
               const Reader& reader) {
  for (const Slot<T>& slot : slots) {
    if (!is_named(name, slot.name, place, reader)) {
      continue;
    }
    Text& member = slot.member(target);
    if (member.is_given) {
      report_duplicate(place, reader);
      return false;
    }
    member = std::move(text);
    member.is_given = true;
    return true;
  }
  return false;
}

/// Attributes by slots; what is no slot's is kept.
template <typename T, std::size_t size>
void read_attributes(T& target, pugi::xml_node element, const std::array<Slot<T>, size>& slots,
                     std::vector<Kept>& others, const Reader& reader) {
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (is_syntax(attribute)) {
      continue;
    }
    const Span place = reader.document.span(attribute);
    if (!read_into(target, local_name(attribute), reader.document.text(attribute), place, slots, reader)) {
      keep(attribute, others, reader);
    }
  }
}

/// A child that has only text may stand for an attribute.
template <typename T, std::size_t size>
bool read_leaf(T& target, pugi::xml_node child, const std::array<Slot<T>, size>& slots, const Reader& reader) {
  return is_leaf(child) &&
         read_into(target, local_name(child), reader.document.text(child), reader.document.tag(child), slots, reader);
}

/// Attributes and children; call(child) is asked about each child first, and says whether it has taken it.
template <typename T, std::size_t size, typename Call>
void read_element(T& target, pugi::xml_node element, const std::array<Slot<T>, size>& slots, std::vector<Kept>& others,
                  const Reader& reader, const Call& call) {
  read_attributes(target, element, slots, others, reader);
  bool has_text = false;
  for (const pugi::xml_node child : element.children()) {
    const bool is_element = child.type() == pugi::node_element;
    has_text = has_text || !is_element;
    if (is_element && !call(child) && !read_leaf(target, child, slots, reader)) {
      keep(child, others, reader);
    }
  }
  Text text = has_text ? reader.document.text(element) : Text();
  if (!text.is_empty()) {
    others.push_back({{}, std::move(text), {}, {}});
  }
}

/// Children of an element without attributes of its own.
template <typename Call>
void read_children(pugi::xml_node element, std::vector<Kept>& others, const Reader& reader, const Call& call) {
  constexpr std::array<Slot<Kept>, 0> none = {};
  Kept nothing;
  read_element(nothing, element, none, others, reader, call);
}

/// A text with nothing around it, or the value of an attribute of this name; the rest is kept.
Text text_of(pugi::xml_node element, std::string_view attribute, std::vector<Kept>& others, const Reader& reader);

/// The text of an attribute, without a remark; not given if there is none.
Text attribute_text(pugi::xml_node element, std::string_view name, const Reader& reader);
/// As it stands in the source: for what is looked up.
std::string_view raw_attribute(pugi::xml_node element, std::string_view name);

pugi::xml_node find(const Ids& ids, std::string_view id);
/// Whether an element may be read once more.
bool may_copy(pugi::xml_node element, const Reader& reader);

// Numbers --------------------------------------------------------------------------------------------------------

/// Hexadecimal digits, with or without 0x; digits: how many CiA 311 wants, 0: any number.
bool read_hex(const Text& text, std::size_t digits, std::uint64_t largest, std::uint64_t& value, Findings& findings);
/// Words of XML Schema.
void interpret_boolean(Field<bool>& field, Findings& findings);

}  // namespace lexican::codict::xdd
