// SPDX-License-Identifier: Apache-2.0
// Reads CANopenObjectList, and objects of private dialects. [311]
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "model/parse.hpp"
#include "xdd/parts.hpp"

namespace lexican::codict::xdd {

namespace {

// The attributes of an object or sub-object, before they are interpreted.
struct Part : Entry {
  Text number;  // index or subIndex
  Field<std::uint8_t> sub_number;
  std::vector<pugi::xml_node> subs;
};

constexpr std::array<Slot<Part>, 19> part_slots = {{
    {"index", [](Part& p) -> Text& { return p.number; }},
    {"subIndex", [](Part& p) -> Text& { return p.number; }},
    {"name", [](Part& p) -> Text& { return p.name; }},
    {"objectType", [](Part& p) -> Text& { return p.object_code; }},
    {"dataType", [](Part& p) -> Text& { return p.data_type; }},
    {"lowLimit", [](Part& p) -> Text& { return p.low_limit.edit(); }},
    {"highLimit", [](Part& p) -> Text& { return p.high_limit.edit(); }},
    {"accessType", [](Part& p) -> Text& { return p.access; }},
    {"defaultValue", [](Part& p) -> Text& { return p.default_value; }},
    {"actualValue", [](Part& p) -> Text& { return p.actual_value.edit(); }},
    {"denotation", [](Part& p) -> Text& { return p.denotation.edit(); }},
    {"PDOmapping", [](Part& p) -> Text& { return p.pdo_mapping; }},
    {"objFlags", [](Part& p) -> Text& { return p.flags.edit(); }},
    {"uniqueIDRef", [](Part& p) -> Text& { return p.parameter_id.edit(); }},
    {"subNumber", [](Part& p) -> Text& { return p.sub_number; }},
    {"edseditor_extenstion_storagelocation", [](Part& p) -> Text& { return p.node.edit().storage_group; }},
    // Names in _project.xml of CANopenNode.
    {"memoryType", [](Part& p) -> Text& { return p.node.edit().storage_group; }},
    {"disabled", [](Part& p) -> Text& { return p.node.edit().disabled.edit(); }},
    {"TPDOdetectCOS", [](Part& p) -> Text& { return p.node.edit().flags_pdo.edit(); }},
}};

bool is_object(std::string_view name) { return name == "CANopenObject" || name == "Object"; }
bool is_sub(std::string_view name) { return name == "CANopenSubObject" || name == "SubObject"; }

// Collects a sub-object, or the sub-objects of a SubObjectList. Returns false for other elements.
bool read_subs(pugi::xml_node child, std::vector<pugi::xml_node>& subs) {
  if (is_sub(local_name(child))) {
    subs.push_back(child);
    return true;
  }
  if (local_name(child) != "SubObjectList") {
    return false;
  }
  for (const pugi::xml_node sub : child.children()) {
    if (is_sub(local_name(sub))) {
      subs.push_back(sub);
    }
  }
  return true;
}

Part read_part(pugi::xml_node element, const Reader& reader) {
  Part part;
  part.span = reader.document.tag(element);
  part.extent = reader.document.whole(element);
  read_element(part, element, part_slots, part.others, reader, [&](pugi::xml_node child) {
    return read_subs(child, part.subs) ||
           (is_label_element(child) && read_label_element(part.texts.edit(), child, part.others, reader));
  });
  if (NodeProperties* const node = part.node.if_any()) {
    node->storage_group.value = node->storage_group.text;
    interpret_boolean(node->disabled, reader.findings);
    interpret_boolean(node->flags_pdo, reader.findings);
  }
  return part;
}

// Returns the number of digits that CiA 311 1.1 requires. CiA 311 1.0 allows any number: 0.
std::size_t digits(std::size_t wanted, const Reader& reader) {
  return reader.device.format == Format::xdd11 ? wanted : 0;
}

void interpret_object_code(Entry& entry, bool has_subs, const Reader& reader) {
  entry.object_code.value = has_subs ? ObjectCode::record : ObjectCode::variable;
  if (entry.object_code.is_empty()) {
    reader.findings.add(rules::object_type_missing, entry.span,
                        has_subs ? "objectType is missing, read as RECORD" : "objectType is missing, read as VAR",
                        has_subs ? "add objectType=\"9\"" : "add objectType=\"7\"");
    return;
  }
  const ParsedInteger number = parse_integer(entry.object_code.text);
  const auto code = static_cast<ObjectCode>(number.value.magnitude & 0xFF);
  if (!number.is_number() || number.value.magnitude > 0xFF || name_of(code).empty() || code == ObjectCode::null) {
    reader.findings.add(rules::object_type, entry.object_code.span,
                        fmt::format("{} is not an object type", in_quotes(entry.object_code.text)),
                        "write 7 (VAR), 8 (ARRAY), 9 (RECORD) or 2 (DOMAIN)");
  } else {
    entry.object_code.value = code;
  }
}

void interpret_data_type(Entry& entry, const Reader& reader) {
  if (entry.data_type.is_empty()) {
    return;
  }
  std::uint64_t code = 0;
  if (read_hex(entry.data_type, digits(2, reader), 0xFFFF, code, reader.findings)) {
    entry.data_type.value = static_cast<std::uint16_t>(code);
  } else if (const DataType* type = data_type_named(entry.data_type.text)) {
    entry.data_type.value = type->code;
  } else {
    reader.findings.add(rules::type_unknown, entry.data_type.span,
                        fmt::format("{} is not a data type", in_quotes(entry.data_type.text)),
                        "write a code of CiA 301, for example 05");
  }
}

// Returns whether the type element of a parameter can represent the type of its object. CiA 311 writes BITSTRING for
// all types that have no element of their own.
bool is_same_type(std::uint16_t of_object, std::uint16_t of_parameter) {
  return of_object == of_parameter || (of_parameter == type_code::octet_string && (data_type(of_object).iec.empty()));
}

void choose_type(Entry& entry, const Reader& reader) {
  const std::uint16_t of_parameter = entry.type->code;
  const std::uint16_t of_object = entry.data_type.value;
  if (of_parameter == 0) {
    return;
  }
  if (of_object != 0 && is_same_type(of_object, of_parameter)) {
    return;
  }
  if (of_object != 0) {
    reader.findings.add(rules::parameter_differs, entry.data_type.span,
                        fmt::format("data type {:04X}h, but the parameter has {:04X}h", of_object, of_parameter),
                        "use one type in both");
  }
  const bool has_octets = !entry.default_value.is_empty() || !entry.actual_value->is_empty();
  const bool is_domain = entry.object_code.value == ObjectCode::domain || !has_octets;
  entry.data_type.value = of_parameter == type_code::octet_string && is_domain ? type_code::domain : of_parameter;
}

bool is_same_value(Value a, Value b, const DataType& type) {
  Findings ignored;
  interpret(a, type, ignored);
  interpret(b, type, ignored);
  return a.kind == b.kind && a.kind != Value::Kind::malformed && a.integer == b.integer && a.real == b.real &&
         a.adds_node_id == b.adds_node_id && *a.octets == *b.octets &&
         (a.kind != Value::Kind::text || a.text == b.text);
}

// Chooses between the values of a parameter (`chosen`) and of its object (`own`), which is used if the parameter has
// none. The object's value is kept if its text differs, and reported if its meaning differs.
template <typename T>
void choose(T& chosen, const T& own, std::string_view attribute, bool is_same, Entry& entry, const Reader& reader) {
  if (!own.is_given) {
    return;
  }
  if (chosen.is_empty()) {
    chosen = own;
    return;
  }
  if (own.is_empty() || chosen.text == own.text) {
    return;
  }
  if (!is_same) {
    reader.findings.add(
        rules::parameter_differs, own.span,
        fmt::format("{} {} differs from {} of the parameter", attribute, in_quotes(own.text), in_quotes(chosen.text)),
        "use one value in both");
  }
  entry.others.push_back({"@" + std::string(attribute), static_cast<const Text&>(own), {}, own.span});
}

// Uses the range of allowed values as limits, if there is exactly one.
void take_limits_of_range(Entry& entry) {
  if (entry.allowed->ranges.size() == 1) {
    entry.low_limit = entry.allowed->ranges.front().minimum;
    entry.high_limit = entry.allowed->ranges.front().maximum;
  }
}

// Returns whether the access types agree: that of a parameter may add the direction of PDO mapping to rw.
bool is_same_access(Access own, Access of_parameter) {
  return own == of_parameter || (own == Access::rw && (of_parameter == Access::rwr || of_parameter == Access::rww));
}

void append(std::vector<OpaquePart>& to, std::vector<OpaquePart>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

// Merges the attributes of an object (`own`) into an entry that was read from its parameter. [311: uniqueIDRef]
void merge(Entry& entry, Entry& own, const Reader& reader) {
  entry.span = own.span;
  entry.extent = own.extent;
  entry.name = std::move(own.name);
  entry.object_code = std::move(own.object_code);
  entry.data_type = std::move(own.data_type);
  entry.pdo_mapping = std::move(own.pdo_mapping);
  entry.flags = std::move(own.flags);
  append(entry.others, own.others);
  if (!own.node->storage_group.is_empty() && entry.node->storage_group.is_empty()) {
    entry.node.edit().storage_group = std::move(own.node.edit().storage_group);
  }
  const DataType& type = data_type(entry.type->code != 0 ? entry.type->code : entry.data_type.value);
  const auto choose_value = [&](Value& chosen, const Value& value, std::string_view attribute) {
    const bool is_asked = chosen.is_given && value.is_given && chosen.text != value.text;
    choose(chosen, value, attribute, is_asked && is_same_value(chosen, value, type), entry, reader);
  };
  choose_value(entry.default_value, own.default_value, "defaultValue");
  const auto choose_rare = [&](Rare<Value>& chosen, const Value& value, std::string_view attribute) {
    if (value.is_given) {
      choose_value(chosen.edit(), value, attribute);
    }
  };
  choose_rare(entry.actual_value, own.actual_value, "actualValue");
  choose_rare(entry.low_limit, own.low_limit, "lowLimit");
  choose_rare(entry.high_limit, own.high_limit, "highLimit");
  choose(entry.access, own.access, "accessType", is_same_access(own.access.value, entry.access.value), entry, reader);
  if (own.denotation->is_given) {
    choose(entry.denotation.edit(), *own.denotation, "denotation", false, entry, reader);
  }
  choose_type(entry, reader);
}

// Returns the parameter that an object refers to; null if there is none, or if it exceeds the limit of copies.
pugi::xml_node parameter_of(const Entry& own, const Reader& reader) {
  if (own.parameter_id->is_empty()) {
    return {};
  }
  const std::string_view id = trimmed(reader.document.raw(own.parameter_id->span));
  const pugi::xml_node element = find(reader.shared.parameters, id);
  if (!element) {
    reader.findings.add(rules::reference, own.parameter_id->span,
                        fmt::format("parameter {} does not exist", in_quotes(own.parameter_id->text)),
                        "correct uniqueIDRef, or add the parameter");
    return {};
  }
  ParameterUse& use = reader.shared.uses[id];
  use.references -= use.references != 0 ? 1 : 0;
  const bool is_readable = !std::exchange(use.is_read, true) || may_copy(element, reader);
  return is_readable ? element : pugi::xml_node();
}

// Frees a parameter that no other object refers to. Those with an index are objects themselves, which are read later.
void free_parameter(pugi::xml_node parameter, const Entry& entry, const Reader& reader) {
  const std::string_view id = trimmed(reader.document.raw(entry.parameter_id->span));
  if (reader.shared.uses[id].references == 0 && !parameter.child("index")) {
    reader.shared.parameters.erase(id);
    parameter.parent().remove_child(parameter);
  }
}

void complete(Entry& entry, Entry& own, const Reader& reader) {
  const pugi::xml_node parameter = parameter_of(own, reader);
  if (!parameter) {
    entry = std::move(own);
    return;
  }
  read_parameter(parameter, entry, reader);
  free_parameter(parameter, own, reader);
  take_limits_of_range(entry);
  merge(entry, own, reader);
}

// Uses a label, preferably in English, as the name of an entry without one.
void complete_name(Entry& entry) {
  if (entry.name.is_empty()) {
    entry.name.text = text_in(entry.texts->labels, "en");
  }
}

void complete_access(Entry& entry, bool is_variable, const Reader& reader) {
  if (!is_variable || !entry.access.is_empty() || entry.access.value != Access::unknown) {
    return;
  }
  if (!entry.parameter_id->is_empty()) {
    entry.access.value = Access::ro;  // default of the schema
  } else if (entry.object_code.value == ObjectCode::domain) {
    entry.access.value = Access::rw;
  } else {
    reader.findings.add(rules::access_missing, entry.span, "access is missing", "add accessType");
  }
}

void complete_type(Entry& entry, bool is_variable, const Reader& reader) {
  if (entry.object_code.value == ObjectCode::domain && entry.data_type.value == 0) {
    entry.data_type.value = type_code::domain;
  }
  if (is_variable && entry.data_type.value == 0 && entry.type->reference.is_empty()) {
    reader.findings.add(rules::type_missing, entry.span, "data type is missing", "add dataType");
  }
}

// Interprets an object or sub-object into an empty entry, which is a parameter because entries are large.
void interpret_part(Part& part, bool has_subs, Entry& entry, const Reader& reader) {
  interpret_object_code(part, has_subs, reader);
  interpret_access(part.access, false, reader);
  interpret_data_type(part, reader);
  std::uint64_t flags = 0;
  if (!part.flags->is_empty() && read_hex(part.flags, digits(4, reader), 0xFFFFFFFF, flags, reader.findings)) {
    part.flags.edit().value = static_cast<std::uint32_t>(flags);
  }
  interpret_pdo_mapping(part.pdo_mapping, reader);
  complete(entry, part, reader);
  complete_name(entry);
}

// Completes missing attributes of an ARRAY's element with those of the ARRAY, unless a parameter describes the element.
void inherit_from_array(Sub& sub, const Object& object) {
  const bool is_element = object.object_code.value == ObjectCode::array && sub.sub_index != 0;
  if (!is_element || !sub.parameter_id->is_empty()) {
    return;
  }
  if (sub.data_type.is_empty()) {
    sub.data_type.value = object.data_type.value;
  }
  if (sub.access.is_empty()) {
    sub.access.value = object.access.value;
  }
  if (sub.pdo_mapping.is_empty()) {
    sub.pdo_mapping.value = object.pdo_mapping.value;
  }
}

bool read_number(const Text& number, std::size_t wanted, std::uint64_t largest, Span place, std::uint64_t& value,
                 const Reader& reader) {
  if (read_hex(number, reader.device.format == Format::other_xml ? 0 : wanted, largest, value, reader.findings)) {
    return true;
  }
  reader.findings.add(rules::index, number.is_given ? number.span : place,
                      !number.is_empty() ? fmt::format("{} is not an index; not used", in_quotes(number.text))
                                         : "index is missing; not used",
                      "write hexadecimal digits");
  return false;
}

// Returns false, with a finding, for a duplicate number.
bool is_first(std::vector<bool>& seen, std::uint64_t number, Span place, const Reader& reader) {
  const auto at = static_cast<std::size_t>(number);
  if (seen[at]) {
    const bool is_sub = seen.size() == 0x100;
    reader.findings.add(rules::duplicate_object, place,
                        is_sub ? fmt::format("duplicate sub-index {:02X}h; the first is used", number)
                               : fmt::format("duplicate object {:04X}h; the first is used", number),
                        "remove one of them, or correct its number");
    return false;
  }
  seen[at] = true;
  return true;
}

void read_subs(Object& object, const std::vector<pugi::xml_node>& elements, const Reader& reader) {
  std::vector<bool> seen(0x100);
  object.subs.reserve(std::min(elements.size(), seen.size()));
  for (const pugi::xml_node element : elements) {
    Part part = read_part(element, reader);
    std::uint64_t number = 0;
    if (!read_number(part.number, 2, 0xFF, part.span, number, reader) || !is_first(seen, number, part.span, reader)) {
      object.others.push_back(opaque_part(reader.document, element));
      continue;
    }
    Sub& sub = object.subs.emplace_back();
    sub.sub_index = static_cast<std::uint8_t>(number);
    interpret_part(part, false, sub, reader);
    inherit_from_array(sub, object);
    complete_access(sub, true, reader);
    complete_type(sub, true, reader);
  }
}

template <typename T, typename Key>
void sort_by(std::vector<T>& all, Key key) {
  const auto is_before = [key](const T& a, const T& b) { return key(a) < key(b); };
  if (!std::is_sorted(all.begin(), all.end(), is_before)) {  // a sort moves all elements, even sorted ones
    std::sort(all.begin(), all.end(), is_before);
  }
}

bool read_object(pugi::xml_node element, std::vector<bool>& seen, const Reader& reader) {
  Part part = read_part(element, reader);
  std::uint64_t number = 0;
  if (!read_number(part.number, 4, 0xFFFF, part.span, number, reader) || !is_first(seen, number, part.span, reader)) {
    return false;
  }
  Object& object = reader.device.objects.emplace_back();
  object.index = static_cast<std::uint16_t>(number);
  object.is_listed = true;
  object.sub_number = part.sub_number;
  interpret_number(object.sub_number, 0xFF, reader.findings);
  const std::vector<pugi::xml_node> subs = std::move(part.subs);
  interpret_part(part, !subs.empty() || !object.sub_number.is_empty(), object, reader);
  const bool is_variable = !has_sub_objects(object.object_code.value);
  if (is_variable && !subs.empty()) {
    reader.findings.add(rules::object_type, object.object_code.is_given ? object.object_code.span : object.span,
                        fmt::format("object type {}, but there are sub-objects", name_of(object.object_code.value)),
                        "write objectType=\"9\" (RECORD), or remove the sub-objects");
  }
  complete_access(object, is_variable, reader);
  complete_type(object, is_variable, reader);
  read_subs(object, subs, reader);
  sort_by(object.subs, [](const Sub& sub) { return sub.sub_index; });
  return true;
}

void interpret_values(Entry& entry, const Reader& reader) {
  const DataType& type = data_type_of(reader.device, entry.data_type.value);
  interpret_value(entry.default_value, type, reader);
  interpret_value(entry.actual_value, type, reader);
  interpret_value(entry.substitute_value, type, reader);
  if (Allowed* const allowed = entry.allowed.if_any()) {
    interpret_allowed(*allowed, type, reader);
  }
  if (entry.allowed->ranges.size() == 1) {  // the limits are copies of the range, whose faults are already reported
    Findings said_already;
    interpret(entry.low_limit, type, said_already);
    interpret(entry.high_limit, type, said_already);
  } else {
    interpret_value(entry.low_limit, type, reader);
    interpret_value(entry.high_limit, type, reader);
  }
}

constexpr std::array<Slot<Device>, 3> count_slots = {{
    {"mandatoryObjects", [](Device& d) -> Text& { return d.mandatory.count; }},
    {"optionalObjects", [](Device& d) -> Text& { return d.optional.count; }},
    {"manufacturerObjects", [](Device& d) -> Text& { return d.manufacturer.count; }},
}};

void check_count(ObjectList& list, ListKind kind, const Reader& reader) {
  list.is_given = list.count.is_given;
  if (list.count.is_empty()) {
    return;
  }
  interpret_number(list.count, 0xFFFFFFFF, reader.findings);
  const std::vector<Object>& objects = reader.device.objects;
  const auto number = std::count_if(objects.begin(), objects.end(),
                                    [kind](const Object& object) { return list_of(object.index) == kind; });
  if (list.count.value != static_cast<std::uint64_t>(number)) {
    reader.findings.add(rules::list_count, list.count.span,
                        fmt::format("count is {}, but the number of objects is {}", list.count.value, number),
                        fmt::format("write {}", number));
  }
}

// maxon -------------------------------------------------------------------------------------------------------------

void read_flags(Entry& entry, pugi::xml_node element, const Reader& reader) {
  const pugi::xml_node reference = element.child("flagsIDRef");
  if (!reference) {
    return;
  }
  const pugi::xml_node flags = find(reader.shared.templates, raw_attribute(reference, "uniqueIDRef"));
  if (!flags) {
    reader.findings.add(rules::reference, reader.document.tag(reference),
                        fmt::format("flags {} do not exist", in_quotes(raw_attribute(reference, "uniqueIDRef"))),
                        "correct the reference");
    return;
  }
  if (!may_copy(flags, reader)) {
    return;
  }
  entry.access.value = access_named(trimmed(flags.child_value("Access")));
  const std::string_view mapping = trimmed(flags.child_value("PdoMapping"));
  const bool is_sent = mapping.find_first_of("Tt") != std::string_view::npos;
  const bool is_received = mapping.find_first_of("Rr") != std::string_view::npos;
  entry.pdo_mapping.value = is_sent && is_received ? PdoMapping::optional
                            : is_sent              ? PdoMapping::tpdo
                            : is_received          ? PdoMapping::rpdo
                                                   : PdoMapping::no;
}

struct IndexedParameter {
  Entry entry;
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  bool is_whole = false;  // from a structuredParameter
};

bool read_leaf_number(pugi::xml_node element, const char* name, std::uint64_t largest, std::uint64_t& value,
                      const Reader& reader) {
  const pugi::xml_node leaf = element.child(name);
  return leaf && read_number(reader.document.text(leaf), 0, largest, reader.document.tag(leaf), value, reader);
}

bool read_indexed(pugi::xml_node element, IndexedParameter& indexed, const Reader& reader) {
  std::uint64_t index = 0;
  std::uint64_t sub_index = 0;
  if (!read_leaf_number(element, "index", 0xFFFF, index, reader) ||
      (element.child("subIndex") && !read_leaf_number(element, "subIndex", 0xFF, sub_index, reader))) {
    return false;
  }
  indexed.index = static_cast<std::uint16_t>(index);
  indexed.sub_index = static_cast<std::uint8_t>(sub_index);
  indexed.is_whole = local_name(element) == "structuredParameter";
  read_parameter(element, indexed.entry, reader);
  indexed.entry.object_code.value = indexed.is_whole ? ObjectCode::record : ObjectCode::variable;
  choose_type(indexed.entry, reader);
  take_limits_of_range(indexed.entry);
  read_flags(indexed.entry, element, reader);
  complete_name(indexed.entry);
  return true;
}

// Converts an object that has only sub-index 0, and no structuredParameter, to an object without sub-objects.
void simplify(Object& object) {
  if (object.subs.size() == 1 && object.subs.front().sub_index == 0 && object.span.is_empty()) {
    static_cast<Entry&>(object) = std::move(static_cast<Entry&>(object.subs.front()));
    object.subs.clear();
  } else if (object.span.is_empty()) {
    object.span = object.subs.front().span;
  }
}

// Adds an entry to its object. Returns false if the object already has such an entry.
bool add_indexed(std::map<std::uint16_t, Object>& objects, IndexedParameter& indexed) {
  const auto [place, is_new] = objects.try_emplace(indexed.index);
  Object& object = place->second;
  if (is_new) {
    object.index = indexed.index;
    object.is_listed = true;
    object.object_code.value = ObjectCode::record;
  }
  if (indexed.is_whole) {
    if (!object.span.is_empty()) {
      return false;
    }
    static_cast<Entry&>(object) = std::move(indexed.entry);
    return true;
  }
  const bool is_double = std::any_of(object.subs.begin(), object.subs.end(),
                                     [&indexed](const Sub& sub) { return sub.sub_index == indexed.sub_index; });
  if (!is_double) {
    Sub& sub = object.subs.emplace_back();
    static_cast<Entry&>(sub) = std::move(indexed.entry);
    sub.sub_index = indexed.sub_index;
  }
  return !is_double;
}

void read_indexed_parameters(const Reader& reader) {
  std::map<std::uint16_t, Object> objects;
  for (const pugi::xml_node element : reader.shared.indexed) {
    IndexedParameter indexed;
    const bool is_read = read_indexed(element, indexed, reader);
    if (is_read && add_indexed(objects, indexed)) {
      continue;
    }
    if (is_read) {
      reader.findings.add(rules::duplicate_object, reader.document.tag(element),
                          fmt::format("duplicate {:04X}h:{:02X}; the first is used", indexed.index, indexed.sub_index),
                          "remove one of them, or correct its number");
    }
    reader.device.others.push_back(opaque_part(reader.document, element));
  }
  for (auto& [index, object] : objects) {
    sort_by(object.subs, [](const Sub& sub) { return sub.sub_index; });
    if (!object.subs.empty()) {
      simplify(object);
    }
    if (!reader.shared.objects[index]) {
      reader.device.objects.push_back(std::move(object));
    }
  }
}

}  // namespace

void interpret_value(Value& value, const DataType& type, const Reader& reader) {
  // The words true and false of IEC 61131-3, which CiA 306 does not have.
  if (type.kind == TypeKind::boolean && (value.text == "true" || value.text == "false")) {
    value.kind = Value::Kind::integer;
    value.integer = value.text == "true" ? 1U : 0U;
    return;
  }
  interpret(value, type, reader.findings);
}

void interpret_value(Rare<Value>& value, const DataType& type, const Reader& reader) {
  if (Value* const given = value.if_any()) {
    interpret_value(*given, type, reader);
  }
}

void interpret_allowed(Allowed& allowed, const DataType& type, const Reader& reader) {
  for (AllowedValue& value : allowed.values) {
    interpret_value(value.value, type, reader);
  }
  for (Range& range : allowed.ranges) {
    interpret_value(range.minimum, type, reader);
    interpret_value(range.maximum, type, reader);
    interpret_value(range.step, type, reader);
  }
}

void finish_parameter(Entry& entry, const Reader& reader) {
  choose_type(entry, reader);
  take_limits_of_range(entry);
  interpret_values(entry, reader);
}

void interpret_access(Field<Access>& access, bool is_parameter, const Reader& reader) {
  // Indexed by Access.
  constexpr std::array<std::string_view, 8> access_names = {
      "", "noAccess", "read", "write", "readWrite", "readWriteInput", "readWriteOutput", "const"};
  if (access.is_empty()) {
    return;
  }
  const auto* const word =
      std::find_if(access_names.begin() + 1, access_names.end(),
                   [&access](std::string_view candidate) { return equal_ignoring_case(candidate, access.text); });
  const Access of_object = access_named(access.text);
  const Access of_parameter =
      word != access_names.end() ? static_cast<Access>(word - access_names.begin()) : Access::unknown;
  access.value =
      of_parameter != Access::unknown && (is_parameter || of_object == Access::unknown) ? of_parameter : of_object;
  if (access.value == Access::unknown) {
    reader.findings.add(rules::access_unknown, access.span, fmt::format("{} is not an access", in_quotes(access.text)),
                        is_parameter ? "write read, write, readWrite or const" : "write ro, wo, rw or const");
    return;
  }
  const std::string_view right =
      is_parameter ? access_names[static_cast<std::size_t>(access.value)] : name_of(access.value);
  if (access.text != right) {
    reader.findings.add(rules::access_case, access.span,
                        fmt::format("{} is not the word of CiA 311", in_quotes(access.text)),
                        fmt::format("write {}", right));
  }
}

void interpret_pdo_mapping(Field<PdoMapping>& mapping, const Reader& reader) {
  if (mapping.is_empty()) {
    return;
  }
  constexpr std::array<PdoMapping, 5> all = {PdoMapping::no, PdoMapping::optional, PdoMapping::standard,
                                             PdoMapping::tpdo, PdoMapping::rpdo};
  const auto* const word = std::find_if(all.begin(), all.end(), [&mapping](PdoMapping candidate) {
    return equal_ignoring_case(mapping.text, name_of(candidate));
  });
  if (word == all.end()) {
    const bool is_true = mapping.text == "1" || equal_ignoring_case(mapping.text, "true");
    mapping.value = is_true ? PdoMapping::optional : PdoMapping::no;
    reader.findings.add(rules::pdo_mapping, mapping.span,
                        fmt::format("{} is not a PDO mapping", in_quotes(mapping.text)),
                        fmt::format("write {}", name_of(mapping.value)));
    return;
  }
  mapping.value = *word;
  if (mapping.text != name_of(*word)) {
    reader.findings.add(rules::pdo_mapping, mapping.span, fmt::format("wrong capitals in {}", in_quotes(mapping.text)),
                        fmt::format("write {}", name_of(*word)));
  }
}

void count_references(pugi::xml_node element, const Reader& reader) {
  constexpr std::string_view reference = "uniqueIDRef";
  const std::string_view name = local_name(element);
  if (name == "ApplicationProcess" || reader.shared.parameters.empty()) {
    return;
  }
  for (const pugi::xml_attribute attribute : element.attributes()) {
    if (equal_ignoring_case(local_name(attribute), reference)) {
      ++reader.shared.uses[trimmed(attribute.value())].references;
    }
  }
  for (const pugi::xml_node child : element.children()) {
    if (equal_ignoring_case(local_name(child), reference)) {
      ++reader.shared.uses[trimmed(reader.document.raw(reader.document.text(child).span))].references;
    }
    count_references(child, reader);  // recursion is limited by Document::most_levels
  }
}

void read_object_list(pugi::xml_node element, const Reader& reader) {
  std::vector<OpaquePart> opaque;
  std::vector<bool>& seen = reader.shared.objects;
  const auto children = element.children();
  const auto objects = std::count_if(children.begin(), children.end(),
                                     [](pugi::xml_node child) { return is_object(local_name(child)); });
  reader.device.objects.reserve(std::min(static_cast<std::size_t>(objects), seen.size()));
  pugi::xml_node done;  // the object that has been read: it is freed when the reader has left it
  read_element(reader.device, element, count_slots, opaque, reader, [&](pugi::xml_node child) {
    const bool is_one = is_object(local_name(child));
    if (is_one) {
      element.remove_child(done);
      done = child;
    }
    if (is_one && !read_object(child, seen, reader)) {
      opaque.push_back(opaque_part(reader.document, child));
    }
    return is_one;
  });
  store_remainder(element, std::move(opaque), reader.device.others, reader);
}

void finish_objects(const Reader& reader) {
  read_indexed_parameters(reader);
  Device& device = reader.device;
  sort_by(device.objects, [](const Object& object) { return object.index; });
  for (Object& object : device.objects) {
    const ObjectCode code = object.object_code.value;
    if (!has_sub_objects(code) || code == ObjectCode::array) {  // an ARRAY describes its elements
      interpret_values(object, reader);
    }
    for (Sub& sub : object.subs) {
      interpret_values(sub, reader);
    }
  }
  check_count(device.mandatory, ListKind::mandatory, reader);
  check_count(device.optional, ListKind::optional, reader);
  check_count(device.manufacturer, ListKind::manufacturer, reader);
}

}  // namespace lexican::codict::xdd
