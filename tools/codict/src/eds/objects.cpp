// SPDX-License-Identifier: Apache-2.0
// Reads objects and sub-objects, each of which has a section. [306: 4.6]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "eds/slots.hpp"
#include "model/parse.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

bool read_python_key(Entry& entry, const Key& key, const Reader& reader) {
  if (!read_into(entry, key, python_slots, reader)) {
    return false;
  }
  reader.findings.add(
      rules::dialect, key.name,
      fmt::format("key {} is defined by python-canopen only", in_quotes(reader.document.text(key.name))),
      "convert the description to XDD for other tools");
  if (Unit* const unit = entry.unit.if_any()) {
    unit->is_given = !unit->texts.labels.empty();
  }
  reader.device.dialect = python_dialect;
  return true;
}

// Reads the keys that CANopenEditor stores in comments. It writes RAM at each sub-object that names no group.
void read_hidden_keys(Entry& entry, const Section& section, bool is_sub, const Reader& reader) {
  const auto read = [&](std::string_view name, std::string_view what) {
    const std::optional<Key> key = comment_key(reader.document, section, name);
    if (key) {
      reader.findings.add(
          rules::hidden_key, {key->name.begin, key->value.end},
          fmt::format("{} {} in a comment of libEDSsharp", what, in_quotes(reader.document.text(key->value))),
          "keep the comment, or convert the description to XDD");
    }
    return key;
  };
  if (const std::optional<Key> key = read(storage_key, "storage group")) {
    Field<std::string>& group = entry.node.edit().storage_group;
    static_cast<Text&>(group) = text_of(reader.document, *key);
    group.value = is_sub && equal_ignoring_case(group.text, "RAM") ? std::string() : group.text;
  }
  if (const std::optional<Key> key = read(trigger_key, trigger_key)) {
    Field<bool>& flag = entry.node.edit().flags_pdo.edit();
    static_cast<Text&>(flag) = text_of(reader.document, *key);
    interpret_flag(flag, reader.findings);
  }
}

void interpret_object_code(Entry& entry, bool has_subs, Findings& findings) {
  entry.object_code.value = has_subs ? ObjectCode::record : ObjectCode::variable;
  if (entry.object_code.is_empty()) {
    findings.add(rules::object_type_missing, entry.span,
                 has_subs ? "ObjectType is missing, read as RECORD" : "ObjectType is missing, read as VAR",
                 has_subs ? "add ObjectType=0x9" : "add ObjectType=0x7");
    return;
  }
  Field<std::uint8_t> number;
  static_cast<Text&>(number) = static_cast<const Text&>(entry.object_code);
  interpret_number(number, 0xFF, findings);
  const auto code = static_cast<ObjectCode>(number.value);
  if (name_of(code).empty() || code == ObjectCode::null) {
    findings.add(rules::object_type, entry.object_code.span,
                 fmt::format("{} is not an object type", in_quotes(entry.object_code.text)),
                 "write 0x7 (VAR), 0x8 (ARRAY), 0x9 (RECORD) or 0x2 (DOMAIN)");
  } else {
    entry.object_code.value = code;
  }
}

void interpret_access(Entry& entry, Findings& findings) {
  if (entry.access.is_empty()) {
    entry.access.value = entry.object_code.value == ObjectCode::domain ? Access::rw : Access::unknown;
    return;
  }
  const std::string_view word = without_comment(entry.access.text);
  if (word.size() != entry.access.text.size()) {
    const auto size = static_cast<std::uint32_t>(word.size());
    findings.add(codict::rules::value_comment, {entry.access.span.begin + size, entry.access.span.end},
                 "text after the access type is ignored", "move it to a line that begins with ;");
  }
  entry.access.value = access_named(word);
  if (entry.access.value == Access::unknown || entry.access.value == Access::none) {
    entry.access.value = Access::unknown;
    const Access meant = access_meant_by(word);
    findings.add(
        rules::access_unknown, entry.access.span, fmt::format("{} is not an access type", in_quotes(word)),
        meant == Access::unknown ? "write ro, wo, rw, rwr, rww or const" : fmt::format("write {}", name_of(meant)));
  } else if (word != name_of(entry.access.value)) {
    findings.add(rules::access_case, entry.access.span,
                 fmt::format("access type {} is not in small letters", in_quotes(word)),
                 fmt::format("write {}", name_of(entry.access.value)));
  }
}

// Returns whether DataType and AccessType are mandatory. For other object codes, the standard defines their values.
bool is_type_needed(const Entry& entry) {
  const ObjectCode code = entry.object_code.value;
  return code == ObjectCode::variable || code == ObjectCode::deftype;
}

void require(const Text& field, std::string_view key, const Entry& entry, Findings& findings) {
  if (field.is_empty()) {
    findings.add(rules::key_missing, entry.span, std::string(key) + " is missing", "add " + std::string(key) + "=");
  }
}

}  // namespace

void interpret_entry(Entry& entry, bool has_subs, Findings& findings) {
  interpret_object_code(entry, has_subs, findings);
  interpret_access(entry, findings);
  if (entry.object_code.value == ObjectCode::domain) {
    entry.data_type.value = type_code::domain;
  }
  interpret_number(entry.data_type, 0xFFFF, findings);
  interpret_number(entry.flags, std::numeric_limits<std::uint32_t>::max(), findings);
  Field<bool> mapping;
  static_cast<Text&>(mapping) = static_cast<const Text&>(entry.pdo_mapping);
  interpret_flag(mapping, findings);
  entry.pdo_mapping.value = mapping.value ? PdoMapping::optional : PdoMapping::no;
  require(entry.name, "ParameterName", entry, findings);
  if (is_type_needed(entry)) {
    require(entry.data_type, "DataType", entry, findings);
    require(entry.access, "AccessType", entry, findings);
  }
}

namespace {

void report_misplaced(const Text& field, std::string_view key, Findings& findings) {
  if (!field.is_empty()) {
    findings.add(rules::key_misplaced, field.span, std::string(key) + " has no effect in an object with sub-objects",
                 "move it to the sub-objects");
  }
}

// Reports keys about values in an ARRAY or RECORD without compact storage.
void report_misplaced_keys(const Object& object, Findings& findings) {
  if (object.compact.value == 0) {
    report_misplaced(object.data_type, "DataType", findings);
    report_misplaced(object.access, "AccessType", findings);
    report_misplaced(object.default_value, "DefaultValue", findings);
    report_misplaced(object.pdo_mapping, "PDOMapping", findings);
  }
  report_misplaced(object.low_limit, "LowLimit", findings);
  report_misplaced(object.high_limit, "HighLimit", findings);
}

// Returns whether the object itself has a section. Without one, its span is that of its first sub-object.
bool has_section(const Object& object) { return object.subs.empty() || !(object.span == object.subs.front().span); }

void interpret_object(Object& object, Findings& findings) {
  const bool has_subs = !object.subs.empty() || !object.sub_number.is_empty() || !object.compact.is_empty();
  interpret_number(object.sub_number, 0xFF, findings);
  interpret_number(object.compact, 0xFF, findings);
  if (has_section(object)) {
    interpret_entry(object, has_subs, findings);
  } else {
    object.object_code.value = ObjectCode::record;
  }
  for (Sub& sub : object.subs) {
    interpret_entry(sub, false, findings);
    if (has_sub_objects(sub.object_code.value)) {
      findings.add(rules::object_type, sub.object_code.span,
                   fmt::format("sub-object of type {}", name_of(sub.object_code.value)), "write 0x7 (VAR)");
    }
  }
  if (has_sub_objects(object.object_code.value)) {
    report_misplaced_keys(object, findings);
  } else if (!object.subs.empty() || object.compact.value != 0) {
    const bool is_compact = object.subs.empty();
    findings.add(rules::object_type, object.object_code.is_given ? object.object_code.span : object.span,
                 fmt::format("object type {}, but there are sub-objects{}", name_of(object.object_code.value),
                             is_compact ? " (CompactSubObj)" : ""),
                 is_compact ? "write ObjectType=0x8 (ARRAY), or remove CompactSubObj"
                            : "write ObjectType=0x9 (RECORD), or remove the sub-objects");
  }
}

// Keeps and reports a key that CiA 306 defines for objects only. Returns false for other keys.
bool keep_object_key(Sub& sub, const Key& key, const Reader& reader) {
  const bool is_known = std::any_of(object_slots.begin(), object_slots.end(), [&](const Slot<Object>& slot) {
    return compare_names(reader.document.raw(key.name), slot.key) == 0;
  });
  if (is_known) {
    sub.others.push_back(opaque_part(reader.document, key));
    reader.findings.add(rules::key_misplaced, key.name,
                        fmt::format("key {} has no effect in a sub-object", in_quotes(reader.document.text(key.name))),
                        "remove it");
  }
  return is_known;
}

void read_sub(Sub& sub, const Section& section, const Reader& reader) {
  sub.span = section.name;
  sub.extent = extent_of(reader.document, section);
  for (const Key& key : section.keys) {
    if (key.is_duplicate || !(read_into(static_cast<Entry&>(sub), key, entry_slots, reader) ||
                              keep_object_key(sub, key, reader) || read_python_key(sub, key, reader))) {
      store_opaque_key(key, sub.others, reader);
    }
  }
  read_hidden_keys(sub, section, true, reader);
}

// Completes a missing default value of sub-index 0 with the highest sub-index. [306: 4.6.3]
void complete_sub_zero(Object& object) {
  if (!has_sub_objects(object.object_code.value) || object.subs.empty() || object.subs.front().sub_index != 0) {
    return;
  }
  Value& value = object.subs.front().default_value;
  if (value.is_empty()) {
    value.kind = Value::Kind::integer;
    value.integer = highest_sub(object);
  }
}

const DataType& type_of(const Entry& entry, const Reader& reader) {
  const std::uint16_t code = entry.data_type.value;
  const DataType& type = data_type_of(reader.device, code);
  const bool is_basic = type.kind != TypeKind::unknown && type.kind != TypeKind::structure && type.code == code;
  if (is_basic || code == 0 || entry.data_type.is_empty()) {
    return type;
  }
  if (type.kind != TypeKind::unknown || reader.device.find(code) != nullptr) {
    reader.findings.add(rules::type_own, entry.data_type.span,
                        fmt::format("data type {:04X}h is not a basic type of CiA 301", code),
                        "use a basic type for other tools");
  } else {
    reader.findings.add(rules::type_unknown, entry.data_type.span,
                        fmt::format("data type {:04X}h is unknown to CiA 301 and to the device", code),
                        "use a type of CiA 301, or describe it as DEFTYPE");
  }
  return type;
}

}  // namespace

void read_key(Object& object, const Key& key, const Reader& reader) {
  if (key.is_duplicate || !(read_into(static_cast<Entry&>(object), key, entry_slots, reader) ||
                            read_into(object, key, object_slots, reader) || read_python_key(object, key, reader))) {
    store_opaque_key(key, object.others, reader);
  }
}

namespace {

void read_object(Object& object, const Section& section, const Reader& reader) {
  object.span = section.name;
  object.extent = extent_of(reader.document, section);
  for (const Key& key : section.keys) {
    read_key(object, key, reader);
  }
  read_hidden_keys(object, section, false, reader);
}

std::size_t number_of_objects(const std::vector<NamedSection>& sorted) {
  std::size_t number = 0;
  for (std::size_t n = 0; n < sorted.size(); ++n) {
    number += n == 0 || sorted[n].name.index != sorted[n - 1].name.index ? 1U : 0U;
  }
  return number;
}

// Reads a section of an object or sub-object. Sections are sorted, so it belongs to the last object or begins a new
// one.
void read_part(const NamedSection& part, std::vector<Object>& objects, const Reader& reader) {
  const bool is_new = objects.empty() || objects.back().index != part.name.index;
  Object& object = is_new ? objects.emplace_back() : objects.back();
  object.index = part.name.index;
  if (!part.name.is_sub) {
    read_object(object, *part.section, reader);
    return;
  }
  if (is_new) {
    object.span = part.section->name;
    reader.findings.add(rules::section_orphan, part.section->name,
                        fmt::format("section [{:04X}] of the object is missing", part.name.index), "add it");
  }
  Sub& sub = object.subs.emplace_back();
  sub.sub_index = part.name.sub_index;
  read_sub(sub, *part.section, reader);
}

void keep_second(const NamedSection& part, std::vector<OpaquePart>& others, const Reader& reader) {
  if (!part.section->is_duplicate) {  // a duplicate name is already reported
    reader.findings.add(
        rules::duplicate_section, part.section->name,
        fmt::format("duplicate section [{}]; the first is used", shortened(reader.document.text(part.section->name))),
        "remove one of them, or correct its index");
  }
  others.push_back(opaque_part(reader.document, *part.section));
}

}  // namespace

std::vector<Object> read_objects(std::vector<NamedSection> parts, std::vector<OpaquePart>& others,
                                 const Reader& reader) {
  const auto key_of = [](const NamedSection& part) {
    return std::make_tuple(part.name.index, part.name.is_sub, part.name.sub_index);
  };
  std::stable_sort(parts.begin(), parts.end(),
                   [key_of](const NamedSection& a, const NamedSection& b) { return key_of(a) < key_of(b); });
  std::vector<Object> objects;
  objects.reserve(number_of_objects(parts));
  const NamedSection* before = nullptr;
  for (const NamedSection& part : parts) {
    if (before != nullptr && key_of(*before) == key_of(part)) {
      keep_second(part, others, reader);
    } else {
      read_part(part, objects, reader);
      before = &part;
    }
  }
  for (Object& object : objects) {
    interpret_object(object, reader.findings);
    expand_compact(object, reader);
  }
  return objects;
}

namespace {

// Uses the range of a range type as limits of an entry that has none. Faults of its values are reported at the type.
void take_limits_of_type(Entry& entry, const DataType& type, const Device& device) {
  const Object* const own = type.code != entry.data_type.value ? device.find(entry.data_type.value) : nullptr;
  if (own == nullptr || !is_range_type(*own) || has_sub_objects(entry.object_code.value)) {
    return;
  }
  Findings reported;
  const auto take = [&](Rare<Value>& limit, std::uint8_t sub_index) {
    if (limit->is_empty()) {
      limit = own->find(sub_index)->default_value;
      interpret(limit, type, reported);
    }
  };
  take(entry.low_limit, 2);
  take(entry.high_limit, 3);
}

}  // namespace

void interpret_values(Entry& entry, const Reader& reader) {
  const DataType& type = type_of(entry, reader);
  interpret(entry.default_value, type, reader.findings);
  for (Rare<Value>* value : {&entry.actual_value, &entry.low_limit, &entry.high_limit}) {
    interpret(*value, type, reader.findings);
  }
  take_limits_of_type(entry, type, reader.device);
}

void interpret_values(Object& object, const Reader& reader) {
  const ObjectCode code = object.object_code.value;
  if (!has_sub_objects(code) || code == ObjectCode::array || object.compact.value != 0) {
    interpret_values(static_cast<Entry&>(object), reader);
  }
  for (Sub& sub : object.subs) {
    if (!sub.is_implied) {
      interpret_values(static_cast<Entry&>(sub), reader);
      continue;
    }
    if (sub.sub_index != 0) {
      sub.default_value = object.default_value;
    }
    interpret(sub.actual_value, data_type_of(reader.device, sub.data_type.value), reader.findings);
  }
  complete_sub_zero(object);
}

}  // namespace lexican::codict::eds
