// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "diff/recorder.hpp"
#include "model/pdo.hpp"

namespace lexican::codict::diff {

namespace {

bool are_equal(const Value& a, const Value& b) {
  if (a.kind != b.kind) {
    return false;
  }
  switch (a.kind) {
    case Value::Kind::none: return true;
    case Value::Kind::integer: return a.integer == b.integer && a.adds_node_id == b.adds_node_id;
    case Value::Kind::real: return a.real == b.real;
    case Value::Kind::octets: return *a.octets == *b.octets;
    case Value::Kind::text:
    case Value::Kind::malformed: break;
  }
  return a.text == b.text;
}

// Access ---------------------------------------------------------------------------------------------------------

// Access rights of the network to an entry.
struct Rights {
  explicit Rights(const Entry& entry)
      : read(is_readable(entry.access.value)), write(is_writable(entry.access.value)), map(directions_of(entry)) {}

  bool has_all_of(const Rights& other) const {
    return read >= other.read && write >= other.write && map.send >= other.map.send && map.receive >= other.map.receive;
  }

  bool read;
  bool write;
  Directions map;
};

// Returns true if both entries are objects with sub-objects: DataType, AccessType and PDOMapping have no effect there.
bool are_containers(const Entry& before, const Entry& after) {
  return has_sub_objects(before.object_code.value) && has_sub_objects(after.object_code.value);
}

void compare_rights(const Entry& before, const Entry& after, const Recorder& recorder) {
  const Rights old_rights(before);
  const Rights new_rights(after);
  const bool is_more = new_rights.has_all_of(old_rights);
  const bool is_same = is_more && old_rights.has_all_of(new_rights);
  const Kind kind = is_more || are_containers(before, after) ? Kind::compatible : Kind::breaking;
  // Access rwr and rww of an EDS equals rw with a mapping direction in an XDD.
  const bool are_both = old_rights.read && old_rights.write && new_rights.read && new_rights.write;
  if (before.access.value != after.access.value && !(is_same && are_both)) {
    recorder.add(kind, "access", before.access, after.access);
  } else if (!is_same) {
    recorder.add(kind, "PDO mapping", before.pdo_mapping, after.pdo_mapping);
  }
}

// Values ---------------------------------------------------------------------------------------------------------

// Returns true for objects whose default values configure the communication of the device.
bool is_connection_set(std::uint16_t index) {
  constexpr std::array<std::uint16_t, 3> cob_ids = {0x1005, 0x1012, 0x1014};
  return (index >= 0x1200 && index < 0x1300) || (index >= 0x1400 && index < 0x1C00) ||
         std::find(cob_ids.begin(), cob_ids.end(), index) != cob_ids.end();
}

// Returns true for entries that identify the product: 1000h, and 1018h without revision and serial number.
bool is_identity(const Place& place) {
  return place.index == 0x1000 || (place.index == 0x1018 && (place.sub_index == 1 || place.sub_index == 2));
}

void compare_defaults(const Entry& before, const Entry& after, const Recorder& recorder) {
  if (!are_equal(before.default_value, after.default_value)) {
    const bool is_breaking = is_connection_set(recorder.place.index) || is_identity(recorder.place);
    recorder.add(is_breaking ? Kind::breaking : Kind::compatible, "default", before.default_value, after.default_value);
  }
  if (!are_equal(before.actual_value, after.actual_value)) {
    recorder.add(Kind::configuration, "value", before.actual_value, after.actual_value);
  }
}

// Returns true if both values are numbers and a is less than b.
bool is_below(const Value& a, const Value& b) {
  return (a.is_integer() && b.is_integer() && a.integer < b.integer) ||
         (a.kind == Value::Kind::real && b.kind == Value::Kind::real && a.real < b.real);
}

void compare_limit(std::string_view what, const Value& before, const Value& after, bool is_narrower,
                   const Recorder& recorder) {
  if (!are_equal(before, after)) {
    const bool is_new = before.kind == Value::Kind::none;
    recorder.add(is_new || is_narrower ? Kind::breaking : Kind::compatible, what, before, after);
  }
}

void compare_limits(const Entry& before, const Entry& after, const Recorder& recorder) {
  compare_limit("low limit", before.low_limit, after.low_limit, is_below(before.low_limit, after.low_limit), recorder);
  compare_limit("high limit", before.high_limit, after.high_limit, is_below(after.high_limit, before.high_limit),
                recorder);
}

// Returns "1..5 step 2".
Text shown(const Range& range) {
  Text text;
  text.text = range.minimum.text + ".." + range.maximum.text;
  text.text += range.step->is_empty() ? "" : " step " + range.step->text;
  text.span = range.minimum.span;
  return text;
}

bool are_equal(const Range& a, const Range& b) {
  return are_equal(a.minimum, b.minimum) && are_equal(a.maximum, b.maximum) && are_equal(a.step, b.step);
}

// Compares the steps of single ranges; their bounds equal the limits, which are compared elsewhere.
void compare_step(const std::vector<Range>& before, const std::vector<Range>& after, const Recorder& recorder) {
  static const Value nothing;
  const Value& old_step = before.size() == 1 ? *before.front().step : nothing;
  const Value& new_step = after.size() == 1 ? *after.front().step : nothing;
  if (!are_equal(old_step, new_step)) {
    recorder.add(new_step.is_empty() ? Kind::compatible : Kind::breaking, "step", old_step, new_step);
  }
}

bool is_in(const Range& range, const std::vector<Range>& ranges) {
  return std::any_of(ranges.begin(), ranges.end(), [&range](const Range& other) { return are_equal(range, other); });
}

// Compares lists of ranges. A removed range forbids values, unless all values are now allowed.
void compare_ranges(const std::vector<Range>& before, const std::vector<Range>& after, const Recorder& recorder) {
  static const Text nothing;
  compare_step(before, after, recorder);
  if (before.size() < 2 && after.size() < 2) {
    return;
  }
  for (const Range& range : before) {
    if (!is_in(range, after)) {
      recorder.add(after.empty() ? Kind::compatible : Kind::breaking, "range", shown(range), nothing);
    }
  }
  for (const Range& range : after) {
    if (!is_in(range, before)) {
      recorder.add(before.empty() ? Kind::breaking : Kind::compatible, "range", nothing, shown(range));
    }
  }
}

const AllowedValue* find_value(const std::vector<AllowedValue>& values, const Value& value) {
  const auto place = std::find_if(values.begin(), values.end(),
                                  [&value](const AllowedValue& other) { return are_equal(other.value, value); });
  return place != values.end() ? &*place : nullptr;
}

Text label_of(const AllowedValue& value) {
  Text label;
  label.text = text_in(value.texts.labels, "en");
  label.span = value.value.span;
  return label;
}

// Compares enumerations. One without values allows all values.
void compare_allowed(const std::vector<AllowedValue>& before, const std::vector<AllowedValue>& after,
                     const Recorder& recorder) {
  static const Text nothing;
  for (const AllowedValue& old_value : before) {
    const AllowedValue* const same = find_value(after, old_value.value);
    if (same == nullptr) {
      recorder.add(after.empty() ? Kind::compatible : Kind::breaking, "allowed value", old_value.value, nothing);
    } else if (label_of(old_value).text != label_of(*same).text) {
      recorder.add(Kind::text, "name of allowed value " + old_value.value.text, label_of(old_value), label_of(*same));
    }
  }
  for (const AllowedValue& new_value : after) {
    if (find_value(before, new_value.value) == nullptr) {
      recorder.add(before.empty() ? Kind::breaking : Kind::compatible, "allowed value", nothing, new_value.value);
    }
  }
}

bool is_blank(const Range& range) { return range.minimum.is_empty() && range.maximum.is_empty(); }
bool is_blank(const AllowedValue& allowed) { return allowed.value.is_empty(); }

// Returns the elements that have a value.
template <typename Element>
std::vector<Element> given(const std::vector<Element>& elements) {
  std::vector<Element> result;
  std::copy_if(elements.begin(), elements.end(), std::back_inserter(result),
               [](const Element& element) { return !is_blank(element); });
  return result;
}

// Words ----------------------------------------------------------------------------------------------------------

void compare_labels(std::string_view what, const std::vector<Label>& before, const std::vector<Label>& after,
                    const Recorder& recorder) {
  static const Text nothing;
  for (std::size_t at = 0; at < std::max(before.size(), after.size()); ++at) {
    const Text& old_text = at < before.size() ? before[at].text : nothing;
    const Text& new_text = at < after.size() ? after[at].text : nothing;
    const bool are_both = at < before.size() && at < after.size();
    if (!are_both || before[at].language != after[at].language) {
      recorder.add(Kind::text, what, old_text, new_text);
    } else {
      recorder.text(Kind::text, what, old_text, new_text);
    }
  }
}

// Returns the labels that have a text and differ from the name. An EDS has no others; an empty one equals a missing
// one.
std::vector<Label> own_labels(const std::vector<Label>& labels, const std::string& name) {
  std::vector<Label> own;
  std::copy_if(labels.begin(), labels.end(), std::back_inserter(own),
               [&name](const Label& label) { return !label.text.is_empty() && label.text.text != name; });
  return own;
}

void compare_words(const Entry& before, const Entry& after, const Recorder& recorder) {
  recorder.text(Kind::text, "name", before.name, after.name);
  compare_labels("label", own_labels(before.texts->labels, before.name.text),
                 own_labels(after.texts->labels, after.name.text), recorder);
  compare_labels("description", own_labels(before.texts->descriptions, ""), own_labels(after.texts->descriptions, ""),
                 recorder);
  recorder.text(Kind::text, "denotation", before.denotation, after.denotation);
}

void compare_properties(const NodeProperties& before, const NodeProperties& after, const Recorder& recorder) {
  if (named_group(before) != named_group(after)) {
    recorder.add(Kind::compatible, "storage group", before.storage_group, after.storage_group);
  }
  recorder.field(Kind::compatible, "disabled", *before.disabled, *after.disabled);
  recorder.text(Kind::compatible, "count label", *before.count_label, *after.count_label);
  recorder.field(Kind::compatible, "SRDO access", *before.srdo, *after.srdo);
  recorder.ability("shortest capacity", *before.string_length_min, *after.string_length_min);
  recorder.ability("capacity", *before.byte_length, *after.byte_length);
  recorder.field(Kind::compatible, "extension", *before.extension_io, *after.extension_io);
  recorder.field(Kind::compatible, "TPDO on change", *before.flags_pdo, *after.flags_pdo);
}

// Returns a property without meaning for codict; in an EDS, this is an unknown key.
const Text* find_other(const Entry& entry, const std::string& name) {
  const auto has_name = [&name](const auto& other) { return other.name == name; };
  const auto property = std::find_if(entry.properties->begin(), entry.properties->end(), has_name);
  if (property != entry.properties->end()) {
    return &property->value;
  }
  const auto part = std::find_if(entry.others.begin(), entry.others.end(), has_name);
  return part != entry.others.end() ? &part->text : nullptr;
}

void compare_others(const Entry& before, const Entry& after, const Recorder& recorder) {
  static const Text nothing;
  for (const Property& property : *before.properties) {
    const Text* const same = find_other(after, property.name);
    recorder.text(Kind::text, "property " + property.name, property.value, same != nullptr ? *same : nothing);
  }
  for (const Property& property : *after.properties) {
    if (find_other(before, property.name) == nullptr) {
      recorder.text(Kind::text, "property " + property.name, nothing, property.value);
    }
  }
}

}  // namespace

void compare_entries(const Entry& before, const Entry& after, const Recorder& recorder) {
  recorder.field(Kind::breaking, "object type", before.object_code, after.object_code);
  recorder.field(are_containers(before, after) ? Kind::compatible : Kind::breaking, "data type", before.data_type,
                 after.data_type);
  compare_rights(before, after, recorder);
  compare_defaults(before, after, recorder);
  compare_limits(before, after, recorder);
  compare_ranges(given(before.allowed->ranges), given(after.allowed->ranges), recorder);
  compare_allowed(given(allowed_values_of(recorder.before, before)), given(allowed_values_of(recorder.after, after)),
                  recorder);
  recorder.text(Kind::breaking, "unit", before.unit->uri, after.unit->uri);
  recorder.text(Kind::breaking, "unit's multiplier", before.unit->multiplier, after.unit->multiplier);
  recorder.text(Kind::breaking, "multiplier", before.multiplier, after.multiplier);
  recorder.text(Kind::breaking, "offset", before.offset, after.offset);
  recorder.field(Kind::compatible, "flags", *before.flags, *after.flags);
  recorder.text(Kind::configuration, "upload file", before.upload_file, after.upload_file);
  recorder.text(Kind::configuration, "download file", before.download_file, after.download_file);
  compare_properties(before.node, after.node, recorder);
  compare_others(before, after, recorder);
  compare_words(before, after, recorder);
}

}  // namespace lexican::codict::diff
