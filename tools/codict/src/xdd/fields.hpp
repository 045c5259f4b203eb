// SPDX-License-Identifier: Apache-2.0
/// \file fields.hpp
/// Assignment of attributes and elements to members of the model, by tables. Other parts are stored as OpaquePart.
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

/// Use of a parameter by objects.
struct ParameterUse {
  std::size_t references = 0;  ///< number of the objects that refer to the parameter and have not been read yet
  bool is_read = false;
};

/// State of the read of one device, shared by all parts of the reader.
struct Shared {
  Dialect dialect = Dialect::container;
  Ids types;
  Ids parameters;
  Ids templates;
  Ids enum_entries;                                           ///< of maxon: entries of enumerations
  std::unordered_map<std::string_view, ParameterUse> uses;    ///< of the parameters by objects, by id
  std::unordered_map<std::string_view, std::uint16_t> codes;  ///< codes of the types that have been looked up
  std::vector<pugi::xml_node> indexed;                        ///< parameters of maxon that have an index
  std::vector<bool> objects = std::vector<bool>(0x10000);     ///< by index: true for those that exist
  /// Bytes that may still be read again for references. The limit prevents exponential growth by nested references.
  std::size_t copies_left = 0;
};

struct Reader {
  const Document& document;
  Device& device;
  Findings& findings;
  Shared& shared;
};

OpaquePart opaque_part(const Document& document, pugi::xml_attribute attribute);
OpaquePart opaque_part(const Document& document, pugi::xml_node element);

/// Returns whether an attribute belongs to XML, such as the declaration of a namespace.
bool is_syntax(pugi::xml_attribute attribute);
bool is_leaf(pugi::xml_node element);  ///< has neither child elements nor attributes

/// Returns whether a name equals `wanted`. Adds a finding if it differs in capitals.
bool is_named(std::string_view name, std::string_view wanted, Span span, const Reader& reader);

/// Store an attribute or element without a slot. Add a finding if CiA 311 does not define it.
void store_opaque(pugi::xml_attribute attribute, std::vector<OpaquePart>& others, const Reader& reader);
void store_opaque(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader);
/// Stores the parts of an element that the reader has not interpreted, if there are any, under the name of the element.
void store_remainder(pugi::xml_node element, std::vector<OpaquePart> opaque, std::vector<OpaquePart>& others,
                     const Reader& reader);

void report_duplicate(Span place, const Reader& reader);

/// A name of an attribute or element, and the member of the model that holds its text.
template <typename T>
struct Slot {
  std::string_view name;
  Text& (*member)(T&);
};

/// Sets the member of a name. Returns false if no slot has this name, or if its member is already set.
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

/// Reads all attributes of an element. Those without a slot are stored as opaque.
template <typename T, std::size_t size>
void read_attributes(T& target, pugi::xml_node element, const std::array<Slot<T>, size>& slots,
                     std::vector<OpaquePart>& others, const Reader& reader) {
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (is_syntax(attribute)) {
      continue;
    }
    const Span place = reader.document.span(attribute);
    if (!read_into(target, local_name(attribute), reader.document.text(attribute), place, slots, reader)) {
      store_opaque(attribute, others, reader);
    }
  }
}

/// Reads a child that has only text like an attribute of its name.
template <typename T, std::size_t size>
bool read_leaf(T& target, pugi::xml_node child, const std::array<Slot<T>, size>& slots, const Reader& reader) {
  return is_leaf(child) &&
         read_into(target, local_name(child), reader.document.text(child), reader.document.tag(child), slots, reader);
}

/// Reads attributes and children. call(child) is called first for each child, and returns whether it has read the
/// child.
template <typename T, std::size_t size, typename Call>
void read_element(T& target, pugi::xml_node element, const std::array<Slot<T>, size>& slots,
                  std::vector<OpaquePart>& others, const Reader& reader, const Call& call) {
  read_attributes(target, element, slots, others, reader);
  bool has_text = false;
  for (const pugi::xml_node child : element.children()) {
    const bool is_element = child.type() == pugi::node_element;
    has_text = has_text || !is_element;
    if (is_element && !call(child) && !read_leaf(target, child, slots, reader)) {
      store_opaque(child, others, reader);
    }
  }
  Text text = has_text ? reader.document.text(element) : Text();
  if (!text.is_empty()) {
    others.push_back({{}, std::move(text), {}, {}});
  }
}

/// Reads the children of an element, and keeps its attributes.
template <typename Call>
void read_children(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader, const Call& call) {
  constexpr std::array<Slot<OpaquePart>, 0> none = {};
  OpaquePart nothing;
  read_element(nothing, element, none, others, reader, call);
}

/// Returns the text of an element, or the value of its attribute with this name. Stores other parts as opaque.
Text text_of(pugi::xml_node element, std::string_view attribute, std::vector<OpaquePart>& others, const Reader& reader);

/// Returns the text of an attribute, without findings; not given if there is none.
Text attribute_text(pugi::xml_node element, std::string_view name, const Reader& reader);
/// Returns the value of an attribute as it is in the source, for lookups.
std::string_view raw_attribute(pugi::xml_node element, std::string_view name);

pugi::xml_node find(const Ids& ids, std::string_view id);
/// Returns whether the limit allows an element to be read again, and reduces the limit.
bool may_copy(pugi::xml_node element, const Reader& reader);

// Numbers --------------------------------------------------------------------------------------------------------

/// Reads hexadecimal digits, with or without 0x. digits: number that CiA 311 requires, 0 for any number.
bool read_hex(const Text& text, std::size_t digits, std::uint64_t largest, std::uint64_t& value, Findings& findings);
/// Interprets true, false, 1 or 0 of XML Schema.
void interpret_boolean(Field<bool>& field, Findings& findings);
void interpret_boolean(Rare<Field<bool>>& field, Findings& findings);

}  // namespace lexican::codict::xdd
