// SPDX-License-Identifier: Apache-2.0
#include "convert/losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "model/pdo.hpp"

namespace lexican::codict::convert {

namespace {

// Details of what is lost at one place, one element for each loss; a detail may be empty.
using Details = std::vector<std::string>;

Details one_if(bool is_there) { return Details(is_there ? 1 : 0); }
Details one_of(const Text& text) { return one_if(!text.is_empty()); }

template <typename Elements, typename NameOf>
Details each_of(const Elements& elements, NameOf name_of) {
  Details details;
  for (const auto& element : elements) {
    details.emplace_back(name_of(element));
  }
  return details;
}

void append(Details& details, Details others) { std::move(others.begin(), others.end(), std::back_inserter(details)); }

class Counter {
 public:
  explicit Counter(const Device& device) {
    for (const Object& object : device.objects) {
      entries_.push_back({&object, &object, nullptr});
      for (const Sub& sub : object.subs) {
        entries_.push_back({&sub, &object, &sub});
      }
    }
  }

  void add(std::string_view what, Details places, bool is_minor = false) {
    if (!places.empty()) {
      losses_.push_back({what, std::move(places), is_minor});
    }
  }
  // Adds the losses of all objects and sub-objects.
  void each(std::string_view what, const std::function<Details(const Entry&)>& details_of) {
    Details places;
    for (const EntryOfObject& described : entries_) {
      for (const std::string& detail : details_of(*described.entry)) {
        const std::string place = place_of(described);
        places.push_back(detail.empty() ? place : fmt::format("{} {}", place, detail));
      }
    }
    add(what, std::move(places));
  }
  std::vector<Loss> take_losses() { return std::move(losses_); }

 private:
  struct EntryOfObject {
    const Entry* entry;
    const Object* object;
    const Sub* sub;  // null for the object itself
  };

  static std::string place_of(const EntryOfObject& described) {
    const std::uint16_t index = described.object->index;
    return described.sub == nullptr ? fmt::format("{:04X}h", index)
                                    : fmt::format("{:04X}h:{:X}", index, described.sub->sub_index);
  }

  std::vector<EntryOfObject> entries_;
  std::vector<Loss> losses_;
};

// Returns the languages of labels with a text.
Details languages_of(const std::vector<Label>& labels) {
  Details languages;
  for (const Label& label : labels) {
    append(languages, Details(label.text.is_empty() ? 0 : 1, label.language));
  }
  return languages;
}

bool is_blank(const Unit& unit) {
  return unit.uri.is_empty() && unit.multiplier.is_empty() && languages_of(unit.texts.labels).empty() &&
         languages_of(unit.texts.descriptions).empty();
}

bool is_blank(const Commissioning& commissioning) {
  const auto& c = commissioning;
  const std::array<const Text*, 9> all = {&c.node_id,        &c.node_name,      &c.bit_rate,
                                          &c.network_number, &c.network_name,   &c.is_manager,
                                          &c.serial_number,  &c.node_reference, &c.network_reference};
  return std::all_of(all.begin(), all.end(), [](const Text* text) { return text->is_empty(); });
}

std::string id_of(const TypeDefinition& type) { return type.name.is_empty() ? type.id.text : type.name.text; }

void count_configuration(const Device& device, Counter& counter) {
  counter.each("configured values", [](const Entry& entry) { return one_of(*entry.actual_value); });
  counter.each("denotations", [](const Entry& entry) { return one_of(*entry.denotation); });
  counter.add("commissioning", one_if(!is_blank(device.commissioning)));
}

Details properties_of(const Entry& entry) {
  const NodeProperties& node = *entry.node;
  const std::array<std::pair<const Text&, const char*>, 6> known = {{{*node.disabled, "CO_disabled"},
                                                                     {*node.count_label, "CO_countLabel"},
                                                                     {*node.srdo, "CO_accessSRDO"},
                                                                     {*node.string_length_min, "CO_stringLengthMin"},
                                                                     {*node.byte_length, "CO_byteLength"},
                                                                     {*node.extension_io, "CO_extensionIO"}}};
  Details names;
  for (const Property& property : *entry.properties) {
    append(names, Details(property.value.is_empty() ? 0 : 1, property.name));
  }
  for (const auto& [text, name] : known) {
    // An entry of an EDS has a variable without CO_extensionIO=false.
    const bool is_default = &text == &*node.extension_io && !node.extension_io->value;
    append(names, Details(text.is_empty() || is_default ? 0 : 1, name));
  }
  return names;
}

// Counts labels, descriptions and units, for which an EDS has no keys: an object has one name only.
void count_words_for_eds(const Device& device, Counter& counter) {
  counter.each("labels", [](const Entry& entry) {
    Details languages;
    for (const Label& label : entry.texts->labels) {
      const bool is_other = !label.text.is_empty() && label.text.text != entry.name.text;
      append(languages, Details(is_other ? 1 : 0, label.language));
    }
    return languages;
  });
  const bool has_python_keys = device.dialect == "python-canopen";
  if (!has_python_keys) {
    counter.each("descriptions", [](const Entry& entry) { return languages_of(entry.texts->descriptions); });
    counter.each("units", [](const Entry& entry) { return one_if(!is_blank(*entry.unit)); });
    counter.each("multipliers", [](const Entry& entry) { return one_of(entry.multiplier); });
  }
}

// Counts device-wide data of CiA 311 for which CiA 306 has no keys.
void count_headers_for_eds(const Device& device, Counter& counter) {
  const Features& features = device.features;
  Details rates;
  for (const BitRate& rate : features.bit_rates) {
    append(rates, Details(rate.kbit == 0 && rate.supported.value ? 1 : 0, "auto-baudRate"));
  }
  counter.add("bit rates", std::move(rates));
  counter.add("default bit rates", one_of(features.default_bit_rate), true);  // the supported ones are kept
  const std::array<std::pair<const Field<bool>&, const char*>, 5> flags = {
      {{features.self_starting, "selfStartingDevice"},
       {features.sdo_requesting, "SDORequestingDevice"},
       {features.flying_master, "flyingMaster"},
       {features.sdo_manager, "SDOManager"},
       {features.configuration_manager, "configurationManager"}}};
  Details names;
  for (const auto& [flag, name] : flags) {
    append(names, Details(flag.value ? 1 : 0, name));
  }
  counter.add("features", std::move(names));
  const Identity& identity = device.identity;
  const std::array<std::pair<const Text&, const char*>, 7> texts = {
      {{identity.vendor_text, "vendorText"},
       {identity.device_family, "deviceFamily"},
       {identity.product_text, "productText"},
       {identity.product_family, "productFamily"},
       {identity.build_date, "buildDate"},
       {identity.specification_revision, "specificationRevision"},
       {identity.instance_name, "instanceName"}}};
  Details part;
  for (const auto& [text, name] : texts) {
    append(part, Details(text.is_empty() ? 0 : 1, name));
  }
  counter.add("texts of the identity", std::move(part));
  Details channels;
  for (const DynamicChannel& channel : device.dynamic_channels) {
    append(channels, one_of(channel.max_number));
    append(channels, one_of(channel.bit_alignment));
  }
  counter.add("numbers of dynamic channels", std::move(channels));
}

// Counts entries without any access, for which an EDS has no access type.
void count_access_for_eds(Counter& counter) {
  counter.each("access types", [](const Entry& entry) { return one_if(entry.access.value == Access::none); });
}

// Returns true if the direction of PDO mapping is lost: an EDS expresses it by rwr and rww only.
bool loses_direction(const Entry& entry) {
  const PdoMapping mapping = entry.pdo_mapping.value;
  const bool is_one_way = mapping == PdoMapping::tpdo || mapping == PdoMapping::rpdo;
  Entry plain;
  plain.access.value = entry.access.value;
  plain.pdo_mapping.value = PdoMapping::optional;
  const Directions before = directions_of(entry);
  const Directions after = directions_of(plain);
  const bool is_same = before.send == after.send && before.receive == after.receive;
  return is_one_way && entry.access.value != Access::rw && !is_same;
}

// Returns the sub-indexes 0 without default value: readers of an EDS take the highest sub-index instead.
Details numbers_that_become_implied(const Device& device) {
  Details places;
  for (const Object& object : device.objects) {
    const bool has_zero = has_sub_objects(object.object_code.value) && !object.subs.empty();
    if (has_zero && object.subs.front().sub_index == 0 && object.subs.front().default_value.kind == Value::Kind::none) {
      places.push_back(fmt::format("{:04X}h:0", object.index));
    }
  }
  return places;
}

// Returns texts of several lines, which the EDS writer joins with blanks.
Details texts_of_several_lines(const Entry& entry) {
  Details texts;
  for (const Text* text : std::initializer_list<const Text*>{&entry.name, &entry.default_value, &*entry.actual_value}) {
    append(texts, Details(text->text.find_first_of("\r\n") != std::string::npos ? 1 : 0));
  }
  return texts;
}

// Returns times whose seconds or time zone are lost: "09:30:15" and "09:30:00+01:00" become 09:30AM.
Details exact_times(const FileInfo& file) {
  Details times;
  for (const Text* time : {&file.creation_time, &file.modification_time}) {
    const bool is_schema = time->text.size() >= 8 && time->text[2] == ':' && time->text[5] == ':';
    append(times, Details(is_schema && time->text.substr(5) != ":00" ? 1 : 0, time->text));
  }
  return times;
}

// Counts unknown access types: readers take a parameter of an XDD without access type as read-only.
void count_access_for_xdd(Counter& counter) {
  counter.each("unknown access types", [](const Entry& entry) {
    const bool is_variable = !has_sub_objects(entry.object_code.value);
    return one_if(is_variable && entry.access.value == Access::unknown);
  });
}

void count_for_eds(const Device& device, Counter& counter) {
  count_access_for_eds(counter);
  counter.each("directions of PDOs", [](const Entry& entry) { return one_if(loses_direction(entry)); });
  counter.each("PDO mappings of unknown data types", [&device](const Entry& entry) {
    const bool is_unknown = data_type_of(device, entry.data_type.value).kind == TypeKind::unknown;
    return one_if(entry.pdo_mapping.value != PdoMapping::no && is_unknown);
  });
  counter.each("line ends in texts", texts_of_several_lines);
  counter.add("sub-indexes 0 without a default value", numbers_that_become_implied(device));
  counter.add("seconds of times", exact_times(device.file));
  count_words_for_eds(device, counter);
  count_headers_for_eds(device, counter);
  counter.each("offsets", [](const Entry& entry) { return one_of(entry.offset); });
  counter.each("allowed values", [](const Entry& entry) {
    Details values;
    for (const AllowedValue& allowed : entry.allowed->values) {
      append(values, Details(allowed.value.is_empty() ? 0 : 1, allowed.value.text));
    }
    return values;
  });
  counter.each("ranges", [](const Entry& entry) {
    const std::vector<Range>& ranges = entry.allowed->ranges;
    return each_of(ranges.size() > 1 ? ranges : std::vector<Range>(),
                   [](const Range& range) { return range.minimum.text + ".." + range.maximum.text; });
  });
  counter.each("steps", [](const Entry& entry) {
    const std::vector<Range>& ranges = entry.allowed->ranges;
    return one_if(
        std::any_of(ranges.begin(), ranges.end(), [](const Range& range) { return !range.step->is_empty(); }));
  });
  counter.each("substitute values", [](const Entry& entry) { return one_of(*entry.substitute_value); });
  counter.each("properties", properties_of);
  counter.add("groups", each_of(device.groups, [](const Group& group) { return group.id.text; }));
  counter.add("data types", each_of(device.types, id_of));
  Details templates = each_of(device.templates, [](const Entry& entry) { return entry.parameter_id->text; });
  append(templates, each_of(device.allowed_templates, [](const AllowedTemplate& allowed) { return allowed.id.text; }));
  counter.add("templates", std::move(templates));
  counter.add("parameters without an object",
              each_of(device.parameters, [](const Entry& entry) { return entry.parameter_id->text; }));
  Details codes;
  for (const Text& code : device.identity.order_codes) {
    append(codes, Details(code.is_empty() ? 0 : 1, code.text));
  }
  codes.erase(codes.begin(), codes.begin() + (codes.empty() ? 0 : 1));
  counter.add("order codes", std::move(codes));
  Details versions;
  for (const Version& version : device.identity.versions) {
    append(versions, Details(version.text.is_empty() ? 0 : 1, version.text.text));
  }
  counter.add("versions", std::move(versions));
}

// Counts file names of domains, which only a DCF can contain.
void count_files(Counter& counter) {
  counter.each("files of domains", [](const Entry& entry) {
    Details files = one_of(entry.upload_file);
    append(files, one_of(entry.download_file));
    return files;
  });
}

// Returns keys of an EDS whose text contains a vertical line, the separator in the product description of an XDD.
Details texts_with_line(const FileInfo& file) {
  Details keys;
  for (const auto& [text, key] : {std::pair<const Text&, const char*>(file.description, "Description"),
                                  std::pair<const Text&, const char*>(file.eds_version, "EDSVersion")}) {
    append(keys, Details(text.text.find('|') != std::string::npos ? 1 : 0, key));
  }
  return keys;
}

void count_for_xdd(const Device& device, Counter& counter) {
  count_access_for_xdd(counter);
  counter.add("texts of the file", texts_with_line(device.file));
  counter.add("name of the former EDS", one_of(device.file.last_eds));
  counter.add("lines of comment", Details(device.comments.size()));
  counter.add("modules", each_of(device.modules, [](const Module& module) { return std::to_string(module.number); }));
  counter.add("connected modules", Details(device.connected_modules.size()));
  const auto name_of = [](const OpaquePart& part) { return part.name; };
  counter.add("sections that CiA 306 does not know", each_of(device.others, name_of));
  counter.each("keys that CiA 306 does not know",
               [&name_of](const Entry& entry) { return each_of(entry.others, name_of); });
  Details links;
  for (const Object& object : device.objects) {
    append(links, Details(object.links.size(), fmt::format("{:04X}h", object.index)));
  }
  counter.add("object links", std::move(links));
}

// Counts commissioning data of one device for which an XDC has no element.
void count_for_xdc(const Commissioning& commissioning, Counter& counter) {
  counter.add("serial numbers", one_of(commissioning.serial_number));
  Details references = one_of(commissioning.node_reference);
  append(references, one_of(commissioning.network_reference));
  counter.add("references to other files", std::move(references));
}

bool is_of_eds(const Device& device) { return device.format == Format::eds || device.format == Format::dcf; }

}  // namespace

std::vector<Loss> losses(const Description& description, Target target) {
  const Device& device = description.devices.front();
  Counter counter(device);
  if (target != Target::json) {
    Details names = each_of(description.devices, [](const Device& other) { return other.identity.product_name.text; });
    names.erase(names.begin());
    counter.add("further devices", std::move(names));
  }
  if (target == Target::eds || target == Target::xdd) {
    count_configuration(device, counter);
  }
  if (target != Target::dcf && target != Target::json) {
    count_files(counter);
  }
  if (target == Target::eds || target == Target::dcf) {
    count_for_eds(device, counter);
  } else if (target != Target::json && is_of_eds(device)) {
    count_for_xdd(device, counter);
    if (target == Target::xdc) {
      count_for_xdc(device.commissioning, counter);
    }
  }
  return counter.take_losses();
}

Device without_configuration(Device device) {
  device.commissioning = Commissioning();
  device.connected_modules.clear();
  const auto forget = [](Entry& entry) {
    entry.actual_value.reset();
    entry.denotation.reset();
  };
  for (Object& object : device.objects) {
    forget(object);
    for (Sub& sub : object.subs) {
      forget(sub);
    }
  }
  return device;
}

}  // namespace lexican::codict::convert
