// SPDX-License-Identifier: Apache-2.0
// Reads labels, units and values. [311: t_label, unit, allowedValues]
#include <utility>

#include "xdd/parts.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::array<Slot<Unit>, 2> unit_slots = {{
    {"multiplier", [](Unit& u) -> Text& { return u.multiplier; }},
    {"unitURI", [](Unit& u) -> Text& { return u.uri; }},
}};

constexpr std::array<Slot<AllowedValue>, 3> value_slots = {{
    {"value", [](AllowedValue& v) -> Text& { return v.value; }},
    {"offset", [](AllowedValue& v) -> Text& { return v.offset.edit(); }},
    {"multiplier", [](AllowedValue& v) -> Text& { return v.multiplier.edit(); }},
}};

bool is_label(pugi::xml_node element) {
  const std::string_view name = local_name(element);
  return name == "label" || name == "labelRef";
}

bool is_description(pugi::xml_node element) {
  const std::string_view name = local_name(element);
  return name == "description" || name == "descriptionRef";
}

struct LabelTexts {
  Text language;
  Text uri;
  Text dictionary;
  Text text;
};

constexpr std::array<Slot<LabelTexts>, 4> label_slots = {{
    {"lang", [](LabelTexts& l) -> Text& { return l.language; }},
    {"URI", [](LabelTexts& l) -> Text& { return l.uri; }},
    {"dictID", [](LabelTexts& l) -> Text& { return l.dictionary; }},
    {"textID", [](LabelTexts& l) -> Text& { return l.text; }},
}};

Label read_label(pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  LabelTexts texts;
  std::vector<Kept> rest;
  for (const pugi::xml_attribute attribute : element.attributes()) {
    const Span place = reader.document.span(attribute);
    if (!is_syntax(attribute) &&
        !read_into(texts, local_name(attribute), reader.document.text(attribute), place, label_slots, reader)) {
      keep(attribute, rest, reader);
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      keep(child, rest, reader);
    }
  }
  keep_rest(element, std::move(rest), others, reader);
  Label label;
  label.language = texts.language.text;
  label.text = texts.text;
  if (!texts.dictionary.is_empty()) {
    label.dictionary = texts.dictionary.text;
  }
  if (!texts.uri.is_empty()) {
    label.uri = texts.uri.text;
  }
  if (!label.text.is_given) {
    label.text = reader.document.text(element);
    label.text.is_given = true;
  }
  return label;
}

AllowedValue read_allowed_value(pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  AllowedValue value;
  std::vector<Kept> rest;
  read_element(value, element, value_slots, rest, reader,
               [&](pugi::xml_node child) { return read_word(value.words, child, rest, reader); });
  keep_rest(element, std::move(rest), others, reader);
  return value;
}

// Adds the value of the enumeration entry that an element of maxon refers to. Returns false if there is none, or if it
// exceeds the limit of copies. [maxon: enumEntryIDRef]
bool read_entry_reference(Allowed& allowed, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  const pugi::xml_node entry = find(reader.shared.enum_entries, raw_attribute(element, "uniqueIDRef"));
  if (!entry || !may_copy(entry, reader)) {
    return false;
  }
  allowed.values.push_back(read_allowed_value(entry, others, reader));
  others.push_back(kept(reader.document, element));
  return true;
}

Range read_range(pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  Range range;
  std::vector<Kept> rest;
  read_children(element, rest, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    return (name == "minValue" && read_value(range.minimum, child, rest, reader)) ||
           (name == "maxValue" && read_value(range.maximum, child, rest, reader)) ||
           (name == "step" && read_value(range.step.edit(), child, rest, reader));
  });
  keep_rest(element, std::move(rest), others, reader);
  return range;
}

void read_value_part(Text& text, pugi::xml_node child, std::vector<Kept>& rest, const Reader& reader) {
  if (!text.is_given && local_name(child) == "value") {
    text = text_of(child, "value", rest, reader);
    return;
  }
  const pugi::xml_node entry = find(reader.shared.enum_entries, raw_attribute(child, "uniqueIDRef"));
  if (!text.is_given && local_name(child) == "enumEntryIDRef" && entry && may_copy(entry, reader)) {
    text = reader.document.text(entry.child("value"));
  }
  keep(child, rest, reader);
}

bool read_allowed_part(Allowed& allowed, pugi::xml_node child, std::vector<Kept>& rest, const Reader& reader) {
  const std::string_view name = local_name(child);
  if (name == "value" && !allowed.ranges.empty()) {
    reader.findings.add(rules::order, reader.document.tag(child), "value after a range",
                        "put values before ranges, as in the schema");
  }
  if (name == "value" || name == "valueEntry") {
    allowed.values.push_back(read_allowed_value(child, rest, reader));
  } else if (name == "range") {
    allowed.ranges.push_back(read_range(child, rest, reader));
  } else {
    return name == "enumEntryIDRef" && read_entry_reference(allowed, child, rest, reader);
  }
  return true;
}

}  // namespace

bool is_word(pugi::xml_node element) { return is_label(element) || is_description(element); }

bool read_word(Words& words, pugi::xml_node child, std::vector<Kept>& others, const Reader& reader) {
  if (is_label(child)) {
    words.labels.push_back(read_label(child, others, reader));
  } else if (is_description(child)) {
    words.descriptions.push_back(read_label(child, others, reader));
  } else {
    return false;
  }
  return true;
}

Text first_of(const Words& words) {
  if (!words.labels.empty()) {
    return words.labels.front().text;
  }
  return words.descriptions.empty() ? Text() : words.descriptions.front().text;
}

void read_unit(Unit& unit, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  std::vector<Kept> rest;
  unit.is_given = true;
  read_element(unit, element, unit_slots, rest, reader,
               [&](pugi::xml_node child) { return read_word(unit.words, child, rest, reader); });
  keep_rest(element, std::move(rest), others, reader);
}

// Reads a value: an attribute in CiA 311; in the dialect of maxon the text of the element or of a child, or an entry of
// an enumeration. Returns false, with a finding, for a duplicate.
bool read_value(Value& value, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  if (value.is_given) {
    report_duplicate(reader.document.tag(element), reader);
    return false;
  }
  std::vector<Kept> rest;
  Text& text = value;
  text = reader.document.text(element);
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (!text.is_given && local_name(attribute) == "value") {
      text = reader.document.text(attribute);
    } else if (!is_syntax(attribute)) {
      keep(attribute, rest, reader);
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      read_value_part(text, child, rest, reader);
    }
  }
  keep_rest(element, std::move(rest), others, reader);
  return true;
}

Text read_allowed(Allowed& allowed, pugi::xml_node element, std::vector<Kept>& others, const Reader& reader) {
  struct Target {
    Text id;
    Text template_id;
  };
  constexpr std::array<Slot<Target>, 2> slots = {{{"uniqueID", [](Target& t) -> Text& { return t.id; }},
                                                  {"templateIDRef", [](Target& t) -> Text& { return t.template_id; }}}};
  Target target;
  std::vector<Kept> rest;
  read_element(target, element, slots, rest, reader,
               [&](pugi::xml_node child) { return read_allowed_part(allowed, child, rest, reader); });
  keep_rest(element, std::move(rest), others, reader);
  allowed.template_id = target.template_id;
  return target.id;
}

}  // namespace lexican::codict::xdd
