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

Label read_label(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  LabelTexts texts;
  std::vector<OpaquePart> opaque;
  for (const pugi::xml_attribute attribute : element.attributes()) {
    const Span place = reader.document.span(attribute);
    if (!is_syntax(attribute) &&
        !read_into(texts, local_name(attribute), reader.document.text(attribute), place, label_slots, reader)) {
      store_opaque(attribute, opaque, reader);
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      store_opaque(child, opaque, reader);
    }
  }
  store_remainder(element, std::move(opaque), others, reader);
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

AllowedValue read_allowed_value(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  AllowedValue value;
  std::vector<OpaquePart> opaque;
  read_element(value, element, value_slots, opaque, reader,
               [&](pugi::xml_node child) { return read_label_element(value.texts, child, opaque, reader); });
  store_remainder(element, std::move(opaque), others, reader);
  return value;
}

// Adds the value of the enumeration entry that an element of maxon refers to. Returns false if there is none, or if it
// exceeds the limit of copies. [maxon: enumEntryIDRef]
bool read_entry_reference(Allowed& allowed, pugi::xml_node element, std::vector<OpaquePart>& others,
                          const Reader& reader) {
  const pugi::xml_node entry = find(reader.shared.enum_entries, raw_attribute(element, "uniqueIDRef"));
  if (!entry || !may_copy(entry, reader)) {
    return false;
  }
  allowed.values.push_back(read_allowed_value(entry, others, reader));
  others.push_back(opaque_part(reader.document, element));
  return true;
}

Range read_range(pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  Range range;
  std::vector<OpaquePart> opaque;
  read_children(element, opaque, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    return (name == "minValue" && read_value(range.minimum, child, opaque, reader)) ||
           (name == "maxValue" && read_value(range.maximum, child, opaque, reader)) ||
           (name == "step" && read_value(range.step.edit(), child, opaque, reader));
  });
  store_remainder(element, std::move(opaque), others, reader);
  return range;
}

void read_value_part(Text& text, pugi::xml_node child, std::vector<OpaquePart>& opaque, const Reader& reader) {
  if (!text.is_given && local_name(child) == "value") {
    text = text_of(child, "value", opaque, reader);
    return;
  }
  const pugi::xml_node entry = find(reader.shared.enum_entries, raw_attribute(child, "uniqueIDRef"));
  if (!text.is_given && local_name(child) == "enumEntryIDRef" && entry && may_copy(entry, reader)) {
    text = reader.document.text(entry.child("value"));
  }
  store_opaque(child, opaque, reader);
}

bool read_allowed_part(Allowed& allowed, pugi::xml_node child, std::vector<OpaquePart>& opaque, const Reader& reader) {
  const std::string_view name = local_name(child);
  if (name == "value" && !allowed.ranges.empty()) {
    reader.findings.add(rules::order, reader.document.tag(child), "value after a range",
                        "put values before ranges, as in the schema");
  }
  if (name == "value" || name == "valueEntry") {
    allowed.values.push_back(read_allowed_value(child, opaque, reader));
  } else if (name == "range") {
    allowed.ranges.push_back(read_range(child, opaque, reader));
  } else {
    return name == "enumEntryIDRef" && read_entry_reference(allowed, child, opaque, reader);
  }
  return true;
}

}  // namespace

bool is_label_element(pugi::xml_node element) { return is_label(element) || is_description(element); }

bool read_label_element(LabelGroup& texts, pugi::xml_node child, std::vector<OpaquePart>& others,
                        const Reader& reader) {
  if (is_label(child)) {
    texts.labels.push_back(read_label(child, others, reader));
  } else if (is_description(child)) {
    texts.descriptions.push_back(read_label(child, others, reader));
  } else {
    return false;
  }
  return true;
}

Text first_of(const LabelGroup& texts) {
  for (const std::vector<Label>* const labels : {&texts.labels, &texts.descriptions}) {
    for (const Label& label : *labels) {
      if (!label.text.is_empty()) {
        return label.text;
      }
    }
  }
  return {};
}

void read_unit(Unit& unit, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  unit.is_given = true;
  read_element(unit, element, unit_slots, opaque, reader,
               [&](pugi::xml_node child) { return read_label_element(unit.texts, child, opaque, reader); });
  store_remainder(element, std::move(opaque), others, reader);
}

// Reads a value: an attribute in CiA 311; in the dialect of maxon the text of the element or of a child, or an entry of
// an enumeration. Returns false, with a finding, for a duplicate.
bool read_value(Value& value, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  if (value.is_given) {
    report_duplicate(reader.document.tag(element), reader);
    return false;
  }
  std::vector<OpaquePart> opaque;
  Text& text = value;
  text = reader.document.text(element);
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (!text.is_given && local_name(attribute) == "value") {
      text = reader.document.text(attribute);
    } else if (!is_syntax(attribute)) {
      store_opaque(attribute, opaque, reader);
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      read_value_part(text, child, opaque, reader);
    }
  }
  store_remainder(element, std::move(opaque), others, reader);
  return true;
}

Text read_allowed(Allowed& allowed, pugi::xml_node element, std::vector<OpaquePart>& others, const Reader& reader) {
  struct Target {
    Text id;
    Text template_id;
  };
  constexpr std::array<Slot<Target>, 2> slots = {{{"uniqueID", [](Target& t) -> Text& { return t.id; }},
                                                  {"templateIDRef", [](Target& t) -> Text& { return t.template_id; }}}};
  Target target;
  std::vector<OpaquePart> opaque;
  read_element(target, element, slots, opaque, reader,
               [&](pugi::xml_node child) { return read_allowed_part(allowed, child, opaque, reader); });
  store_remainder(element, std::move(opaque), others, reader);
  allowed.template_id = target.template_id;
  return target.id;
}

}  // namespace lexican::codict::xdd
