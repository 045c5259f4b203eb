// SPDX-License-Identifier: Apache-2.0
// Reads compact storage: a section for all sub-objects of an ARRAY, and lists of their names and values. [306: 4.6.4]
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "model/parse.hpp"

namespace lexican::codict::eds {

namespace {

// Limit per file, about ten times the number of any known device, so that a small file cannot exhaust the memory.
constexpr std::size_t most_implied_subs = 50000;

Sub implied_zero(std::uint8_t number) {
  Sub zero;
  zero.is_implied = true;
  zero.name.text = "NrOfObjects";
  zero.object_code.value = ObjectCode::variable;
  zero.data_type.value = type_code::unsigned8;
  zero.access.value = Access::ro;
  zero.default_value.text = std::to_string(number);
  zero.default_value.kind = Value::Kind::integer;
  zero.default_value.integer = number;
  return zero;
}

Sub implied_sub(const Object& object, std::uint8_t sub_index) {
  Sub sub;
  sub.sub_index = sub_index;
  sub.is_implied = true;
  sub.span = object.span;
  sub.name.text = object.name.text + std::to_string(sub_index);
  sub.object_code.value = ObjectCode::variable;
  sub.data_type = object.data_type;
  sub.access = object.access;
  sub.pdo_mapping = object.pdo_mapping;
  sub.default_value = object.default_value;
  sub.flags = object.flags;
  return sub;
}

// Returns the member that an entry in a list of names, values or denotations sets.
Text& member_of(Sub& sub, SectionKind kind) {
  return kind == SectionKind::names    ? sub.name
         : kind == SectionKind::values ? static_cast<Text&>(sub.actual_value.edit())
                                       : sub.denotation.edit();
}

Sub* find_sub(Object& object, std::uint32_t number) {
  return number <= 0xFF ? object.find(static_cast<std::uint8_t>(number)) : nullptr;
}

void read_sub_list(Object& object, const NamedSection& addition, const Reader& reader) {
  const NumberedList list = read_list(*addition.section, "NrOfEntries", "", Gaps::are_right, reader);
  OpaquePart opaque = opaque_part(reader.document, *addition.section);
  opaque.children.clear();
  for (const NumberedKey& entry : list.entries) {
    Sub* const sub = find_sub(object, entry.number);
    const bool is_free = sub != nullptr && !member_of(*sub, addition.name.kind).is_given;
    if (is_free) {
      member_of(*sub, addition.name.kind) = text_of(reader.document, *entry.key);
      if (sub->is_implied && addition.name.kind == SectionKind::values) {
        sub->extent = {entry.key->name.begin, entry.key->value.end};
      }
      continue;
    }
    opaque.children.push_back(opaque_part(reader.document, *entry.key));
    reader.findings.add(rules::compact_entry, entry.key->name,
                        sub == nullptr
                            ? fmt::format("{:04X}h has no sub-index {:02X}h", object.index, entry.number)
                            : fmt::format("{:04X}h:{:02X} has a section that defines this", object.index, entry.number),
                        sub == nullptr ? "raise CompactSubObj, or remove the entry" : "remove the entry");
  }
  for (const Key* key : list.others) {
    store_opaque_key(*key, opaque.children, reader);
  }
  if (!opaque.children.empty()) {
    object.others.push_back(std::move(opaque));
  }
}

void read_links(Object& object, const Section& section, const Reader& reader) {
  const NumberedList list = read_list(section, "ObjectLinks", "", Gaps::are_wrong, reader);
  for (const NumberedKey& entry : list.entries) {
    Field<std::uint16_t>& link = object.links.emplace_back();
    static_cast<Text&>(link) = text_of(reader.document, *entry.key);
    interpret_number(link, 0xFFFF, reader.findings);
  }
  for (const Key* key : list.others) {
    store_opaque_key(*key, object.others, reader);
  }
}

}  // namespace

bool take_implied_subs(std::size_t number, Span place, const Reader& reader) {
  if (reader.implied_subs + number > most_implied_subs) {
    reader.findings.add(
        rules::compact_limit, place,
        fmt::format("more than {} sub-objects without sections; the others are omitted", most_implied_subs),
        "describe fewer sub-objects");
    return false;
  }
  reader.implied_subs += number;
  return true;
}

void expand_compact(Object& object, const Reader& reader) {
  constexpr std::uint8_t highest_sub = 0xFE;
  const std::uint8_t number = std::min(object.compact.value, highest_sub);
  if (number == 0) {
    return;
  }
  if (object.compact.value > highest_sub) {
    reader.findings.add(codict::rules::value_range, object.compact.span,
                        fmt::format("CompactSubObj is {}, 254 is used", object.compact.value), "write 254");
  }
  if (!take_implied_subs(number, object.compact.span, reader)) {
    return;
  }
  std::vector<Sub> described = std::exchange(object.subs, {});
  object.subs.push_back(implied_zero(number));
  object.subs.front().span = object.span;
  for (unsigned sub_index = 1; sub_index <= number; ++sub_index) {
    object.subs.push_back(implied_sub(object, static_cast<std::uint8_t>(sub_index)));
  }
  for (Sub& sub : described) {  // a section of a sub-object takes precedence
    if (Sub* const implied = object.find(sub.sub_index); implied != nullptr) {
      *implied = std::move(sub);
    } else {
      object.subs.push_back(std::move(sub));  // keeps the order: its sub-index is above all implied ones
    }
  }
}

void read_addition(const NamedSection& addition, const Reader& reader) {
  Object* const object = reader.device.find(addition.name.index);
  if (object == nullptr || addition.section->is_duplicate) {
    if (object == nullptr) {
      reader.findings.add(rules::section_orphan, addition.section->name,
                          fmt::format("section [{:04X}] of the object is missing", addition.name.index), "add it");
    }
    reader.device.others.push_back(opaque_part(reader.document, *addition.section));
  } else if (addition.name.kind == SectionKind::links) {
    read_links(*object, *addition.section, reader);
  } else {
    read_sub_list(*object, addition, reader);
  }
}

}  // namespace lexican::codict::eds
