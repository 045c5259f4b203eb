// SPDX-License-Identifier: Apache-2.0
// Writes types, parameters, groups and objects. [311: ApplicationProcess, CANopenObjectList]
#include <algorithm>
#include <array>

#include "model/parse.hpp"
#include "xdd/writer.hpp"

namespace lexican::codict::xdd {

namespace {

// Returns whether an opaque part belongs to the object, and not to its parameter, which has no such attribute.
bool is_of_object(const OpaquePart& opaque_part) {
  constexpr std::array<std::string_view, 7> names = {"@lowLimit",    "@highLimit",  "@accessType",     "@defaultValue",
                                                     "@actualValue", "@denotation", "CANopenSubObject"};
  return std::find(names.begin(), names.end(), opaque_part.name) != names.end();
}

std::string_view word_of(Access access) {
  switch (access) {
    case Access::none: return "noAccess";
    case Access::ro: return "read";
    case Access::wo: return "write";
    case Access::rw: return "readWrite";
    case Access::rwr: return "readWriteInput";
    case Access::rww: return "readWriteOutput";
    case Access::constant: return "const";
    case Access::unknown: break;
  }
  return {};
}

bool is_variable(const Object& object) { return object.subs.empty() && !has_sub_objects(object.object_code.value); }

bool is_in(const Text& text) { return text.is_given && !text.is_empty(); }

bool has_node_properties(const NodeProperties& node) {
  return node.disabled->is_given || node.count_label->is_given || node.storage_group.is_given || node.srdo->is_given ||
         node.string_length_min->is_given || node.byte_length->is_given || node.extension_io->is_given ||
         node.flags_pdo->is_given;
}

// Returns whether an entry has parts that the attributes of an object cannot express.
bool needs_parameter(const Entry& entry) {
  const auto is_of_parameter = [](const OpaquePart& opaque_part) { return !is_of_object(opaque_part); };
  return entry.parameter_id->is_given || !entry.texts->labels.empty() || !entry.texts->descriptions.empty() ||
         entry.unit->is_given || !entry.allowed->values.empty() || !entry.allowed->ranges.empty() ||
         has_node_properties(entry.node) || !entry.properties->empty() || entry.substitute_value->is_given ||
         std::any_of(entry.others.begin(), entry.others.end(), is_of_parameter);
}

bool has_limits_of_range(const Entry& entry) {
  const auto& ranges = entry.allowed->ranges;
  return ranges.size() == 1 && ranges[0].minimum.text == entry.low_limit->text &&
         ranges[0].maximum.text == entry.high_limit->text;
}

// Returns whether a value is written. An EDS may omit the value of sub-index 0; an XDD from this writer always has it.
bool is_said(const Value& value) { return value.is_given || value.is_integer(); }
std::string value_text(const Value& value) {
  return value.is_empty() && value.is_integer() ? value.written_integer() : value.text;
}

// Return the uniqueID of a parameter that has none in the description.
std::string made_id(const Object& object) { return "UID_OBJ_" + hex(object.index, 4); }
std::string made_id(const Object& object, const Sub& sub) {
  return "UID_SUB_" + hex(object.index, 4) + hex(sub.sub_index, 2);
}

}  // namespace

std::string hex(std::uint64_t value, std::size_t digits) {
  std::string text;
  for (; value != 0 || text.size() < digits; value >>= 4) {
    text.insert(text.begin(), "0123456789ABCDEF"[value & 0xF]);
  }
  return text;
}

void print_labels(Printer& out, const LabelGroup& texts) {
  const auto print = [&out](const Label& label, std::string_view name) {
    const bool is_reference = !label.dictionary->empty();
    out.open(is_reference ? std::string(name) + "Ref" : std::string(name));
    out.attribute("lang", std::string_view(label.language));
    if (!label.uri->empty()) {
      out.attribute("URI", std::string_view(*label.uri));
    }
    if (is_reference) {
      out.attribute("dictID", std::string_view(*label.dictionary));
      out.attribute("textID", std::string_view(label.text.text));
    } else {
      out.text(label.text.text);
    }
    out.close();
  };
  for (const Label& label : texts.labels) {
    print(label, "label");
  }
  for (const Label& description : texts.descriptions) {
    print(description, "description");
  }
}

EntryWriter::EntryWriter(Printer& out, const Device& device)
    : out_(out), device_(device), is_eds_(device.format == Format::eds || device.format == Format::dcf) {
  for (const TypeDefinition& definition : device.types) {
    types_.insert(definition.id.text);
  }
  for_each_variable(device, [this](std::uint16_t, std::uint8_t, const Entry& entry) {
    has_groups_ = has_groups_ || (is_eds_ && entry.node->storage_group.is_given);
  });
}

bool EntryWriter::has_parameter(const Entry& entry, bool is_variable) const {
  return needs_parameter(entry) || (is_eds_ && is_variable);
}

bool EntryWriter::has_parameters() const {
  bool is_any = !device_.parameters.empty();
  for (const Object& object : device_.objects) {
    is_any = is_any || has_parameter(object, is_variable(object)) ||
             std::any_of(object.subs.begin(), object.subs.end(),
                         [this](const Sub& sub) { return has_parameter(sub, true); });
  }
  return is_any;
}

std::string EntryWriter::id_of(const Entry& entry, const std::string& made) const {
  return entry.parameter_id->is_given ? entry.parameter_id->text : made;
}

void EntryWriter::type_use(const TypeUse& use, std::uint16_t code) {
  if (use.reference.is_given) {
    out_.open("dataTypeIDRef");
    out_.attribute("uniqueIDRef", std::string_view(use.reference.text));
    out_.close();
    return;
  }
  // Private type names are replaced by the element for the code: they are not names of IEC 61131-3.
  const DataType* const named = data_type_named(use.iec.text);
  const bool is_iec = named != nullptr && !equal_ignoring_case(named->name, use.iec.text);
  const DataType& type = data_type(code != 0 ? code : use.code);
  if (is_iec) {
    out_.element(use.iec.text, {});
  } else if (type.code != 0) {
    out_.element(type.iec.empty() ? "BITSTRING" : type.iec, {});
  }
}

void EntryWriter::type(const Entry& entry, bool is_variable) {
  if (entry.type->iec.is_given || entry.type->reference.is_given || (is_variable && !entry.template_id->is_given)) {
    type_use(entry.type, entry.data_type.value);
  }
}

void EntryWriter::value(std::string_view name, const Value& value, OpaqueParts& opaque) {
  const std::string text = value_text(value);
  if (!is_said(value) || (is_eds_ && text.empty())) {
    return;
  }
  const OpaqueParts remainder = parts_inside(opaque.remove_remainder(name, "value"));
  out_.open(name);
  out_.attribute("value", std::string_view(text));
  out_.attributes_of(remainder);
  out_.elements_of(remainder);
  out_.close();
}

void EntryWriter::range(const Range& range, OpaqueParts& opaque) {
  OpaqueParts remainder = parts_inside(opaque.remove_remainder("range", {}));
  out_.open("range");
  value("minValue", range.minimum, remainder);
  value("maxValue", range.maximum, remainder);
  value("step", range.step, remainder);
  out_.elements_of(remainder);
  out_.close();
}

void EntryWriter::ranges(const Allowed& allowed, OpaqueParts& opaque) {
  for (const Range& one : allowed.ranges) {
    range(one, opaque);
  }
}

void EntryWriter::allowed_values(const Allowed& allowed, OpaqueParts& opaque) {
  out_.attribute("templateIDRef", allowed.template_id);
  for (const AllowedValue& one : allowed.values) {
    out_.open("value");
    out_.attribute("value", one.value);
    out_.attribute("offset", one.offset);
    out_.attribute("multiplier", one.multiplier);
    print_labels(out_, one.texts);
    out_.close();
  }
  ranges(allowed, opaque);
  out_.elements_of(opaque);
}

void EntryWriter::allowed(const Entry& entry, OpaqueParts& opaque) {
  const Allowed& given = entry.allowed;
  const bool is_given = !given.values.empty() || !given.ranges.empty() || given.template_id.is_given;
  const bool has_both = is_in(entry.low_limit) && is_in(entry.high_limit);
  const OpaquePart* const remainder = opaque.remove_first("allowedValues");
  OpaqueParts remainder_parts = parts_inside(remainder);
  if (is_given || remainder != nullptr) {
    out_.open("allowedValues");
    out_.attributes_of(remainder_parts);
    allowed_values(given, remainder_parts);
    out_.close();
  } else if (is_eds_ && has_both) {
    out_.open("allowedValues");
    range({entry.low_limit, entry.high_limit, {}}, remainder_parts);
    out_.close();
  }
}

void EntryWriter::unit(const Unit& unit, OpaqueParts& opaque) {
  if (!unit.is_given) {
    return;
  }
  const OpaqueParts remainder = parts_inside(opaque.remove_remainder("unit", {}));
  out_.open("unit");
  out_.attribute("multiplier", unit.multiplier);
  out_.attribute("unitURI", unit.uri);
  out_.attributes_of(remainder);
  print_labels(out_, unit.texts);
  out_.elements_of(remainder);
  out_.close();
}

void EntryWriter::property(std::string_view name, std::string_view text) {
  out_.open("property");
  out_.attribute("name", name);
  out_.attribute("value", text);
  out_.close();
}

void EntryWriter::properties(const Entry& entry, bool is_variable) {
  const NodeProperties& node = entry.node;
  const auto known = [this](std::string_view name, const Text& text) {
    if (text.is_given) {
      property(name, text.text);
    }
  };
  known("CO_disabled", node.disabled);
  known("CO_countLabel", node.count_label);
  if (!is_eds_ || !node.storage_group.value.empty()) {  // RAM of a sub-object means nothing in an EDS
    known("CO_storageGroup", node.storage_group);
  }
  if (is_variable && has_groups_ && value_in_force(entry).kind == Value::Kind::none) {
    property("CO_extensionIO", "false");  // otherwise an empty default value is memory of the application
  } else {
    known("CO_extensionIO", node.extension_io);
  }
  if (node.flags_pdo->is_given) {
    property("CO_flagsPDO", is_eds_ ? (node.flags_pdo->value ? "true" : "false") : node.flags_pdo->text);
  }
  known("CO_accessSRDO", node.srdo);
  known("CO_byteLength", node.byte_length);
  known("CO_stringLengthMin", node.string_length_min);
  for (const Property& other : *entry.properties) {
    property(other.name, other.value.text);
  }
  for (const OpaquePart& key : entry.others) {
    if (is_eds_) {
      property(key.name, key.text.text);
    }
  }
}

// Writes the name of an entry of an EDS, which has no labels, as a label.
void EntryWriter::label_of_name(const Entry& entry) {
  if (entry.texts->labels.empty() && is_eds_) {
    out_.open("label");
    out_.attribute("lang", std::string_view("en"));
    out_.text(entry.name.text);
    out_.close();
  }
}

void EntryWriter::denotation(const Entry& entry, OpaqueParts& opaque) {
  const bool has_labels = !entry.denotations->labels.empty() || !entry.denotations->descriptions.empty();
  if (!has_labels && !(is_eds_ && entry.denotation->is_given)) {
    return;
  }
  const OpaqueParts remainder = parts_inside(opaque.remove_remainder("denotation", {}));
  out_.open("denotation");
  print_labels(out_, entry.denotations);
  if (!has_labels) {
    print_labels(out_, {{{"en", entry.denotation, {}, {}}}, {}});
  }
  out_.elements_of(remainder);
  out_.close();
}

void EntryWriter::parameter(const Entry& entry, const std::string& id, bool is_variable, std::string_view element) {
  std::vector<OpaquePart> own;
  std::copy_if(entry.others.begin(), entry.others.end(), std::back_inserter(own),
               [this](const OpaquePart& opaque_part) { return !is_of_object(opaque_part) && !is_eds_; });
  OpaqueParts opaque(own);
  out_.open(element);
  out_.attribute("uniqueID", std::string_view(id));
  const bool is_default = entry.access.value == Access::ro && !entry.access.is_given;
  if (entry.access.value != Access::unknown && !is_default) {
    out_.attribute("access", word_of(entry.access.value));
  } else if (is_in(entry.access)) {  // because the default would be ro
    out_.attribute("access", entry.access);
  }
  out_.attribute("accessList", entry.access_list);
  out_.attribute("support", entry.support);
  if (is_in(entry.persistent)) {
    out_.attribute("persistent", std::string_view(entry.persistent->value ? "true" : "false"));
  }
  out_.attribute("offset", entry.offset);
  out_.attribute("multiplier", entry.multiplier);
  out_.attribute("templateIDRef", entry.template_id);
  out_.attributes_of(opaque);
  label_of_name(entry);
  print_labels(out_, entry.texts);
  type(entry, is_variable);
  for (const Text& support : *entry.conditional_support) {
    out_.open("conditionalSupport");
    out_.attribute("paramIDRef", std::string_view(support.text));
    out_.close();
  }
  denotation(entry, opaque);
  value("actualValue", entry.actual_value, opaque);
  value("defaultValue", entry.default_value, opaque);
  value("substituteValue", entry.substitute_value, opaque);
  allowed(entry, opaque);
  unit(entry.unit, opaque);
  properties(entry, is_variable);
  out_.elements_of(opaque);
  out_.close();
}

void EntryWriter::parameter_once(const Entry& entry, const std::string& id, bool is_variable) {
  if (has_parameter(entry, is_variable) && written_.insert(id).second) {
    parameter(entry, id, is_variable, "parameter");
  }
}

void EntryWriter::parameters(const OpaquePart* remainder) {
  if (!has_parameters() && remainder == nullptr) {
    return;
  }
  out_.open("parameterList");
  for (const Object& object : device_.objects) {
    parameter_once(object, id_of(object, made_id(object)), is_variable(object));
    for (const Sub& sub : object.subs) {
      parameter_once(sub, id_of(sub, made_id(object, sub)), true);
    }
  }
  for (const Entry& entry : device_.parameters) {
    parameter(entry, entry.parameter_id->text, false, "parameter");
  }
  out_.elements_of(parts_inside(remainder));
  out_.close();
}

void EntryWriter::templates(const OpaquePart* remainder) {
  if (device_.templates.empty() && device_.allowed_templates.empty() && remainder == nullptr) {
    return;
  }
  OpaqueParts opaque = parts_inside(remainder);
  out_.open("templateList");
  for (const Entry& entry : device_.templates) {
    parameter(entry, entry.parameter_id->text, false, "parameterTemplate");
  }
  for (const AllowedTemplate& one : device_.allowed_templates) {
    OpaqueParts of_one = parts_inside(opaque.remove_first("allowedValuesTemplate"));
    out_.open("allowedValuesTemplate");
    out_.attribute("uniqueID", std::string_view(one.id.text));
    allowed_values(one.allowed, of_one);
    out_.close();
  }
  out_.elements_of(opaque);
  out_.close();
}

void EntryWriter::enumeration(const TypeDefinition& definition) {
  for (const AllowedValue& one : definition.values) {
    out_.open("enumValue");
    out_.attribute("value", one.value);
    print_labels(out_, one.texts);
    out_.close();
  }
}

void EntryWriter::definition(const TypeDefinition& definition) {
  constexpr std::array<std::string_view, 4> names = {"array", "struct", "enum", "derived"};  // indexed by Kind
  const OpaqueParts opaque(definition.others);
  out_.open(names[static_cast<std::size_t>(definition.kind)]);
  out_.attribute("name", definition.name);
  out_.attribute("uniqueID", definition.id);
  out_.attribute("size", definition.size);
  out_.attributes_of(opaque);
  print_labels(out_, definition.texts);
  for (const TypeDefinition::Bounds& bounds : definition.bounds) {
    out_.open("subrange");
    out_.attribute("lowerLimit", bounds.lower);
    out_.attribute("upperLimit", bounds.upper);
    out_.close();
  }
  type_use(definition.type, 0);
  for (const TypeDefinition::Member& member : definition.members) {
    const OpaqueParts of_member(member.others);
    out_.open("varDeclaration");
    out_.attribute("name", member.name);
    out_.attribute("uniqueID", member.id);
    out_.attribute("size", member.size);
    out_.attributes_of(of_member);
    print_labels(out_, member.texts);
    type_use(member.type, 0);
    out_.elements_of(of_member);
    out_.close();
  }
  enumeration(definition);
  out_.elements_of(opaque);
  out_.close();
}

void EntryWriter::types(const OpaquePart* remainder) {
  if (device_.types.empty() && remainder == nullptr) {
    return;
  }
  out_.open("dataTypeList");
  for (const TypeDefinition& one : device_.types) {
    definition(one);
  }
  out_.elements_of(parts_inside(remainder));
  out_.close();
}

void EntryWriter::group(const Group& group) {
  const OpaqueParts opaque(group.others);
  out_.open("parameterGroup");
  out_.attribute("uniqueID", group.id);
  out_.attribute("kindOfAccess", group.kind_of_access);
  out_.attributes_of(opaque);
  print_labels(out_, group.texts);
  for (const Group& inner : group.groups) {
    this->group(inner);
  }
  for (const Text& parameter : group.parameters) {
    out_.open("parameterRef");
    out_.attribute("uniqueIDRef", std::string_view(parameter.text));
    out_.close();
  }
  out_.elements_of(opaque);
  out_.close();
}

void EntryWriter::groups(const OpaquePart* remainder) {
  if (device_.groups.empty() && remainder == nullptr) {
    return;
  }
  out_.open("parameterGroupList");
  for (const Group& one : device_.groups) {
    group(one);
  }
  out_.elements_of(parts_inside(remainder));
  out_.close();
}

void EntryWriter::entry_attributes(const Entry& entry, const std::string& id, bool is_variable) {
  const bool is_parameter = has_parameter(entry, is_variable);
  out_.attribute("name", std::string_view(entry.name.text));
  out_.attribute("objectType", std::string_view(std::to_string(static_cast<unsigned>(entry.object_code.value))));
  if (entry.data_type.value != 0 && (is_variable || entry.data_type.is_given)) {
    out_.attribute("dataType", hex(entry.data_type.value, entry.data_type.value > 0xFF ? 4 : 2));
  }
  const bool are_in_range =
      has_limits_of_range(entry) || (is_eds_ && is_parameter && is_in(entry.low_limit) && is_in(entry.high_limit));
  if (!are_in_range) {
    out_.attribute("lowLimit", entry.low_limit);
    out_.attribute("highLimit", entry.high_limit);
  }
  if (!is_parameter) {
    if (entry.access.value != Access::unknown && (entry.access.is_given || is_variable)) {
      out_.attribute("accessType", name_of(entry.access.value));
    }
    if (is_said(entry.default_value)) {
      out_.attribute("defaultValue", std::string_view(value_text(entry.default_value)));
    }
    out_.attribute("actualValue", entry.actual_value);
  }
  const bool has_labels = !entry.denotations->labels.empty() || !entry.denotations->descriptions.empty();
  if (!has_labels && !(is_eds_ && is_parameter)) {
    out_.attribute("denotation", entry.denotation);
  }
  if (entry.pdo_mapping.is_given || entry.pdo_mapping.value != PdoMapping::no) {
    out_.attribute("PDOmapping", name_of(entry.pdo_mapping.value));
  }
  if (is_in(entry.flags)) {
    out_.attribute("objFlags", is_understood(*entry.flags) ? hex(entry.flags->value, 4) : entry.flags->text);
  }
  if (is_parameter) {
    out_.attribute("uniqueIDRef", std::string_view(id));
  }
  for (const OpaquePart& opaque_part : entry.others) {
    if (is_of_object(opaque_part) && opaque_part.name.front() == '@') {
      out_.attribute(std::string_view(opaque_part.name).substr(1), std::string_view(opaque_part.text.text));
    }
  }
}

void EntryWriter::object(const Object& object) {
  out_.open("CANopenObject");
  out_.attribute("index", hex(object.index, 4));
  entry_attributes(object, id_of(object, made_id(object)), is_variable(object));
  if (!object.subs.empty() || object.sub_number.is_given) {
    const std::size_t number = object.sub_number.is_given ? object.sub_number.value : object.subs.size();
    out_.attribute("subNumber", std::string_view(std::to_string(number)));
  }
  for (const Sub& sub : object.subs) {
    out_.open("CANopenSubObject");
    out_.attribute("subIndex", hex(sub.sub_index, 2));
    entry_attributes(sub, id_of(sub, made_id(object, sub)), true);
    out_.close();
  }
  for (const OpaquePart& opaque_part : object.others) {
    if (is_of_object(opaque_part)) {
      out_.print_opaque(opaque_part);
    }
  }
  out_.close();
}

void EntryWriter::objects(const OpaquePart* remainder) {
  const auto count = [this](std::string_view name, ListKind kind) {
    const auto number = std::count_if(device_.objects.begin(), device_.objects.end(),
                                      [kind](const Object& one) { return list_of(one.index) == kind; });
    out_.attribute(name, std::string_view(std::to_string(number)));
  };
  const OpaqueParts opaque = parts_inside(remainder);
  out_.open("CANopenObjectList");
  count("mandatoryObjects", ListKind::mandatory);
  count("optionalObjects", ListKind::optional);
  count("manufacturerObjects", ListKind::manufacturer);
  out_.attributes_of(opaque);
  for (const Object& one : device_.objects) {
    object(one);
  }
  out_.elements_of(opaque);
  out_.close();
}

}  // namespace lexican::codict::xdd
