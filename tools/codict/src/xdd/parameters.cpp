// SPDX-License-Identifier: Apache-2.0
// Reads ApplicationProcess: types, templates, parameters and groups. [311]
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/similar.hpp"
#include "xdd/parts.hpp"

namespace lexican::codict::xdd {

namespace {

constexpr std::array<Slot<Entry>, 8> parameter_slots = {{
    {"uniqueID", [](Entry& e) -> Text& { return e.parameter_id.edit(); }},
    {"access", [](Entry& e) -> Text& { return e.access; }},
    {"accessList", [](Entry& e) -> Text& { return e.access_list.edit(); }},
    {"support", [](Entry& e) -> Text& { return e.support.edit(); }},
    {"persistent", [](Entry& e) -> Text& { return e.persistent.edit(); }},
    {"offset", [](Entry& e) -> Text& { return e.offset.edit(); }},
    {"multiplier", [](Entry& e) -> Text& { return e.multiplier.edit(); }},
    {"templateIDRef", [](Entry& e) -> Text& { return e.template_id.edit(); }},
}};

// Order of the children in the schema: words, a type, then these. Elements that the schema lacks rank last.
constexpr std::array<std::string_view, 4> word_names = {"label", "description", "labelRef", "descriptionRef"};
constexpr std::array<std::string_view, 8> child_order = {
    "conditionalSupport", "denotation",    "actualValue", "defaultValue",
    "substituteValue",    "allowedValues", "unit",        "property"};

// Returns the place of a child element in the schema: 0 for words, 1 for a type, from 2 for `child_order`.
std::size_t rank_of(std::string_view name) {
  constexpr std::size_t of_labels = 0;
  constexpr std::size_t of_type = 1;
  if (std::find(word_names.begin(), word_names.end(), name) != word_names.end()) {
    return of_labels;
  }
  const auto* const place = std::find(child_order.begin(), child_order.end(), name);
  const bool is_type = place == child_order.end() &&
                       (name == "dataTypeIDRef" || name == "variableRef" || data_type_named(name) != nullptr);
  const auto rank = static_cast<std::size_t>(place - child_order.begin());
  return is_type ? of_type : of_type + 1 + std::min(rank, child_order.size() - 1);
}

void check_order(pugi::xml_node element, const Reader& reader) {
  std::size_t last = 0;
  for (const pugi::xml_node child : element.children()) {
    if (child.type() != pugi::node_element) {
      continue;
    }
    const std::size_t rank = rank_of(local_name(child));
    if (rank < last) {
      reader.findings.add(rules::order, reader.document.tag(child),
                          fmt::format("element {} is not in the order of the schema", in_quotes(local_name(child))),
                          "move it before the elements that follow it in the schema");
      return;
    }
    last = rank;
  }
}

void read_denotation(Entry& entry, pugi::xml_node element, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(element, opaque, reader, [&](pugi::xml_node child) {
    return read_label_element(entry.denotations.edit(), child, opaque, reader);
  });
  store_remainder(element, std::move(opaque), entry.others, reader);
  entry.denotation = first_of(entry.denotations);
}

// Sets the name of a storage group: "RAM" for 0, which CANopenNode writes for it.
void interpret_storage_group(Field<std::string>& group) {
  const bool is_number = !group.text.empty() && std::all_of(group.text.begin(), group.text.end(), is_digit);
  const bool is_zero = is_number && group.text.find_first_not_of('0') == std::string::npos;
  group.value = is_zero ? "RAM" : group.text;
}

void interpret_srdo(Field<SrdoAccess>& srdo, Findings& findings) {
  constexpr std::array<std::string_view, 4> texts = {"no", "tx", "rx", "trx"};  // indexed by SrdoAccess
  const auto* const word = std::find_if(texts.begin(), texts.end(), [&srdo](std::string_view candidate) {
    return equal_ignoring_case(candidate, srdo.text);
  });
  if (word == texts.end()) {
    findings.add(rules::property, srdo.span, fmt::format("{} is not an SRDO access, read as no", in_quotes(srdo.text)),
                 "write tx, rx, trx or no");
  } else {
    srdo.value = static_cast<SrdoAccess>(word - texts.begin());
  }
}

void interpret_length(Field<std::uint32_t>& length, Findings& findings) {
  const ParsedInteger number = parse_integer(length.text);
  if (!number.is_number() || number.value.is_negative || number.value.magnitude > 0xFFFFFFFF) {
    findings.add(rules::property, length.span, fmt::format("{} is not a length", in_quotes(length.text)),
                 "write a number");
  } else {
    length.value = static_cast<std::uint32_t>(number.value.magnitude);
  }
}

constexpr std::array<Slot<NodeProperties>, 8> property_slots = {{
    {"CO_disabled", [](NodeProperties& n) -> Text& { return n.disabled.edit(); }},
    {"CO_countLabel", [](NodeProperties& n) -> Text& { return n.count_label.edit(); }},
    {"CO_storageGroup", [](NodeProperties& n) -> Text& { return n.storage_group; }},
    {"CO_accessSRDO", [](NodeProperties& n) -> Text& { return n.srdo.edit(); }},
    {"CO_stringLengthMin", [](NodeProperties& n) -> Text& { return n.string_length_min.edit(); }},
    {"CO_byteLength", [](NodeProperties& n) -> Text& { return n.byte_length.edit(); }},
    {"CO_extensionIO", [](NodeProperties& n) -> Text& { return n.extension_io.edit(); }},
    {"CO_flagsPDO", [](NodeProperties& n) -> Text& { return n.flags_pdo.edit(); }},
}};

// Reports an unknown name with the prefix of CANopenNode, because a misspelled property has no effect.
void check_property_name(const Text& name, Findings& findings) {
  if (name.text.substr(0, 3) != "CO_") {
    return;
  }
  std::vector<std::string_view> known;
  known.reserve(property_slots.size());
  for (const Slot<NodeProperties>& slot : property_slots) {
    known.push_back(slot.name);
  }
  const std::vector<std::string_view> near = similar(name.text, known);
  findings.add(rules::property, name.span, fmt::format("property {} is unknown to CANopenNode", in_quotes(name.text)),
               near.empty() ? "check the spelling" : fmt::format("did you mean {}?", near.front()));
}

void read_property(Entry& entry, pugi::xml_node element, const Reader& reader) {
  struct Raw {
    Text name;
    Text value;
  };
  constexpr std::array<Slot<Raw>, 2> slots = {
      {{"name", [](Raw& r) -> Text& { return r.name; }}, {"value", [](Raw& r) -> Text& { return r.value; }}}};
  Raw raw;
  std::vector<OpaquePart> opaque;
  read_element(raw, element, slots, opaque, reader, [](pugi::xml_node) { return false; });
  store_remainder(element, std::move(opaque), entry.others, reader);
  if (!read_into(entry.node.edit(), raw.name.text, raw.value, raw.name.span, property_slots, reader)) {
    check_property_name(raw.name, reader.findings);
    entry.properties.edit().push_back({raw.name.text, raw.value});
  }
}

void read_conditional_support(Entry& entry, pugi::xml_node element, const Reader& reader) {
  entry.conditional_support.edit().push_back(text_of(element, "paramIDRef", entry.others, reader));
}

bool read_parameter_value(Entry& entry, pugi::xml_node child, const Reader& reader) {
  const std::string_view name = local_name(child);
  return (name == "actualValue" && read_value(entry.actual_value.edit(), child, entry.others, reader)) ||
         (name == "defaultValue" && read_value(entry.default_value, child, entry.others, reader)) ||
         (name == "substituteValue" && read_value(entry.substitute_value.edit(), child, entry.others, reader));
}

bool read_parameter_part(Entry& entry, pugi::xml_node child, const Reader& reader) {
  const std::string_view name = local_name(child);
  if (reader.shared.dialect == Dialect::maxon && (name == "index" || name == "subIndex")) {
    return true;  // read with the object
  }
  if (name == "conditionalSupport" && !child.first_child()) {
    read_conditional_support(entry, child, reader);
  } else if (name == "denotation" && !entry.denotation->is_given) {
    read_denotation(entry, child, reader);
  } else if (name == "allowedValues" && entry.allowed->values.empty() && entry.allowed->ranges.empty()) {
    read_allowed(entry.allowed.edit(), child, entry.others, reader);
  } else if (name == "unit" && !entry.unit->is_given) {
    read_unit(entry.unit.edit(), child, entry.others, reader);
  } else if (name == "property") {
    read_property(entry, child, reader);
  } else {
    return (is_label_element(child) && read_label_element(entry.texts.edit(), child, entry.others, reader)) ||
           read_parameter_value(entry, child, reader) || read_type(entry.type.edit(), child, entry.others, reader);
  }
  return true;
}

void interpret_node(NodeProperties& node, Findings& findings) {
  interpret_storage_group(node.storage_group);
  for (Rare<Field<bool>>* flag : {&node.disabled, &node.extension_io, &node.flags_pdo}) {
    interpret_boolean(*flag, findings);
  }
  if (!node.srdo->is_empty()) {
    interpret_srdo(node.srdo.edit(), findings);
  }
  for (Rare<Field<std::uint32_t>>* length : {&node.string_length_min, &node.byte_length}) {
    if (!(*length)->is_empty()) {
      interpret_length(length->edit(), findings);
    }
  }
}

// Completes type and access of a parameter from its template.
void inherit(Entry& entry, const Reader& reader) {
  const pugi::xml_node element = find(reader.shared.templates, entry.template_id->text);
  if (!element) {
    reader.findings.add(rules::reference, entry.template_id->span,
                        fmt::format("template {} does not exist", in_quotes(entry.template_id->text)),
                        "correct the reference, or add the template");
    return;
  }
  if (!may_copy(element, reader)) {
    return;
  }
  for (const pugi::xml_node child : element.children()) {
    if (entry.type->code == 0 && !entry.type->reference.is_given && child.type() == pugi::node_element) {
      TypeUse type;
      std::vector<OpaquePart> ignored;
      read_type(type, child, ignored, reader);
      entry.type.edit().code = type.code;
    }
  }
  if (entry.access.is_empty()) {
    Field<Access> access;
    static_cast<Text&>(access) = attribute_text(element, "access", reader);
    interpret_access(access, true, reader);
    entry.access.value = access.value;
  }
}

void collect_ids(pugi::xml_node list, Ids& ids, const Reader& reader) {
  for (const pugi::xml_node element : list.children()) {
    const std::string_view id = raw_attribute(element, "uniqueID");
    if (!id.empty() && !ids.try_emplace(id, element).second) {
      reader.findings.add(rules::duplicate_id, reader.document.tag(element),
                          fmt::format("duplicate uniqueID {}; the first is used", in_quotes(id)),
                          "give each element an id of its own");
    }
  }
}

void collect_types(pugi::xml_node list, const Reader& reader) {
  collect_ids(list, reader.shared.types, reader);
  for (const pugi::xml_node type : list.children()) {
    if (local_name(type) == "enum" && reader.shared.dialect == Dialect::maxon) {
      collect_ids(type, reader.shared.enum_entries, reader);
    }
  }
}

void collect_all_ids(pugi::xml_node process, const Reader& reader) {
  Shared& shared = reader.shared;
  for (const pugi::xml_node list : process.children()) {
    const std::string_view name = local_name(list);
    if (name == "dataTypeList") {
      collect_types(list, reader);
    } else if (name == "parameterList") {
      collect_ids(list, shared.parameters, reader);
    } else if (name == "templateList") {
      collect_ids(list, shared.templates, reader);
    }
  }
}

void read_templates(pugi::xml_node list, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(list, opaque, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    if (name == "parameterTemplate") {
      read_parameter(child, reader.device.templates.emplace_back(), reader);
      finish_parameter(reader.device.templates.back(), reader);
      return true;
    }
    if (name == "allowedValuesTemplate" || name == "allowedValues") {
      AllowedTemplate& result = reader.device.allowed_templates.emplace_back();
      result.id = read_allowed(result.allowed, child, opaque, reader);
      interpret_allowed(result.allowed, data_type(0), reader);
      return true;
    }
    return false;
  });
  store_remainder(list, std::move(opaque), others, reader);
}

void read_member(Group& group, pugi::xml_node element, const Reader& reader) {
  group.parameters.push_back(text_of(element, "uniqueIDRef", group.others, reader));
  if (!find(reader.shared.parameters, raw_attribute(element, "uniqueIDRef"))) {
    reader.findings.add(rules::reference, group.parameters.back().span,
                        fmt::format("parameter {} does not exist", in_quotes(group.parameters.back().text)),
                        "correct the reference, or add the parameter");
  }
}

Group read_group(pugi::xml_node element, const Reader& reader) {
  constexpr std::array<Slot<Group>, 2> slots = {{{"uniqueID", [](Group& g) -> Text& { return g.id; }},
                                                 {"kindOfAccess", [](Group& g) -> Text& { return g.kind_of_access; }}}};
  Group group;
  read_element(group, element, slots, group.others, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    if (name == "parameterGroup") {
      group.groups.push_back(read_group(child, reader));
      return true;
    }
    if (name == "parameterRef" || name == "paramIDRef") {
      read_member(group, child, reader);
      return true;
    }
    return read_label_element(group.texts, child, group.others, reader);
  });
  return group;
}

void read_groups(pugi::xml_node list, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(list, opaque, reader, [&](pugi::xml_node child) {
    if (local_name(child) != "parameterGroup") {
      return false;
    }
    reader.device.groups.push_back(read_group(child, reader));
    return true;
  });
  store_remainder(list, std::move(opaque), others, reader);
}

void read_types(pugi::xml_node list, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(list, opaque, reader, [&](pugi::xml_node child) {
    if (!is_definition(child)) {
      return false;
    }
    reader.device.types.push_back(read_definition(child, reader));
    return true;
  });
  store_remainder(list, std::move(opaque), others, reader);
}

// Collects the parameters of maxon, which are objects. Other parameters are read when an object refers to them, or at
// the end.
void read_parameters(pugi::xml_node list, std::vector<OpaquePart>& others, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  read_children(list, opaque, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    if (child.child("index") && (name == "parameter" || name == "structuredParameter")) {
      reader.shared.indexed.push_back(child);
      return true;
    }
    return name == "parameter";
  });
  store_remainder(list, std::move(opaque), others, reader);
}

}  // namespace

void read_parameter(pugi::xml_node element, Entry& entry, const Reader& reader) {
  entry.span = reader.document.tag(element);
  entry.parameter_extent = reader.document.whole(element);
  read_element(entry, element, parameter_slots, entry.others, reader,
               [&](pugi::xml_node child) { return read_parameter_part(entry, child, reader); });
  interpret_access(entry.access, true, reader);
  interpret_boolean(entry.persistent, reader.findings);
  if (NodeProperties* const node = entry.node.if_any()) {
    interpret_node(*node, reader.findings);
  }
  if (reader.shared.dialect == Dialect::container) {
    check_order(element, reader);
  }
  if (!entry.template_id->is_empty()) {
    inherit(entry, reader);
  }
}

void read_process(pugi::xml_node element, const Reader& reader) {
  collect_all_ids(element, reader);
  std::vector<OpaquePart> opaque;
  read_children(element, opaque, reader, [&](pugi::xml_node child) {
    const std::string_view name = local_name(child);
    if (name == "dataTypeList") {
      read_types(child, opaque, reader);
    } else if (name == "parameterList") {
      read_parameters(child, opaque, reader);
    } else if (name == "templateList") {
      read_templates(child, opaque, reader);
    } else if (name == "parameterGroupList") {
      read_groups(child, opaque, reader);
    } else {
      return false;
    }
    return true;
  });
  store_remainder(element, std::move(opaque), reader.device.others, reader);
}

void read_unused_parameters(pugi::xml_node list, const Reader& reader) {
  for (const pugi::xml_node element : list.children()) {
    const std::string_view id = raw_attribute(element, "uniqueID");
    const bool is_used = !id.empty() && reader.shared.uses[id].is_read && find(reader.shared.parameters, id) == element;
    if (is_used || local_name(element) != "parameter" || element.child("index")) {
      continue;
    }
    reader.findings.add(rules::parameter_unused, reader.document.tag(element), "no object refers to the parameter",
                        "add uniqueIDRef to its object, or remove it");
    read_parameter(element, reader.device.parameters.emplace_back(), reader);
    finish_parameter(reader.device.parameters.back(), reader);
  }
}

}  // namespace lexican::codict::xdd
