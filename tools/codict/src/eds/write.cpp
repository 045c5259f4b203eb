// SPDX-License-Identifier: Apache-2.0
#include "eds/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eds/names.hpp"
#include "eds/normal.hpp"
#include "eds/numbered.hpp"
#include "eds/slots.hpp"

namespace lexican::codict::eds {

namespace {

bool is_of_eds(const Device& device) { return device.format == Format::eds || device.format == Format::dcf; }

struct NameLess {
  bool operator()(std::string_view a, std::string_view b) const { return compare_names(a, b) < 0; }
};

class Writer {
 public:
  Writer(const Device& device, const WriteOptions& options) : device_(device), options_(options) {
    for (const OpaquePart& other : device.others) {
      others_[other.name].push_back(&other);
    }
  }

  void headers();
  void object_list(ListKind kind);
  void modules();
  void other_sections();
  std::string take_text() { return std::move(text_); }

 private:
  void section(std::string_view name) {
    if (!text_.empty()) {
      text_ += options_.line_end;
    }
    text_ += '[';
    part(name);
    text_ += ']';
    text_ += options_.line_end;
  }

  void line(std::string_view key, std::string_view value) {
    part(key);
    text_ += '=';
    part(value);
    text_ += options_.line_end;
  }

  // Appends a text. A line end becomes a blank, because it would end the line; NUL becomes U+FFFD, because a file with
  // NUL is not accepted as text.
  void part(std::string_view text) {
    for (const char c : text) {
      text_ += c == '\0' ? replacement : c == '\n' || c == '\r' ? std::string_view(" ") : std::string_view(&c, 1);
    }
  }

  // Writes the keys of a table whose members have a text.
  template <typename T, std::size_t size>
  void slots(T target, const std::array<Slot<T>, size>& slots) {
    for (const Slot<T>& slot : slots) {
      const Text& text = slot.member(target);
      if (text.is_given || !text.is_empty()) {
        line(slot.key, text.text);
      }
    }
  }

  // Writes opaque keys. Opaque parts of other formats cannot be keys of an EDS.
  void opaque_keys(const std::vector<OpaquePart>& others) {
    for (const OpaquePart& other : others) {
      if (is_of_eds(device_) && other.children.empty()) {
        line(other.name, other.text.text);
      }
    }
  }

  // Writes the opaque keys of a section, which have no member in the model, back to that section.
  void opaque_keys_of(std::string_view name) {
    const auto place = others_.find(name);
    if (place == others_.end()) {
      return;
    }
    for (const OpaquePart* other : place->second) {
      opaque_keys(other->children);
    }
    others_.erase(place);
  }

  // Writes a list: the number of entries (`count_key`), and a key for each entry (`word` and its number, from 1).
  template <typename Entries, typename TextOf>
  void numbered(std::string_view count_key, std::string_view word, const Entries& entries, TextOf text_of_entry) {
    line(count_key, std::to_string(entries.size()));
    std::size_t number = 0;
    for (const auto& entry : entries) {
      line(fmt::format("{}{}", word, ++number), text_of_entry(entry));
    }
  }

  void file_info();
  void device_info(const Device& normal);
  void dummies();
  void comments();
  void channels();
  void commissioning(const Device& normal);
  void entry(const Entry& entry);
  void object(const Object& object, const std::string& prefix);
  void object_sections(const Object& object, const std::string& prefix);
  void compact_lists(const Object& object, const std::string& name);
  void sub_list(const std::string& name, const std::vector<std::pair<unsigned, std::string>>& entries);
  void module(const Module& module);

  const Device& device_;
  const WriteOptions& options_;
  std::map<std::string_view, std::vector<const OpaquePart*>, NameLess> others_;  // sections not yet written
  std::string text_;
};

// Returns a number in a format; a malformed text is returned unchanged.
template <typename T>
std::string written(const Field<T>& number, std::string_view format) {
  return number.is_empty() || is_understood(number) ? fmt::format(fmt::runtime(format), number.value) : number.text;
}

std::string index_text(const Field<std::uint16_t>& index) { return written(index, "0x{:04X}"); }
std::string index_text(std::uint16_t index) { return fmt::format("0x{:04X}", index); }

// Headers ----------------------------------------------------------------------------------------------------------

void Writer::device_info(const Device& normal) {
  section("DeviceInfo");
  slots(normal, device_slots);
  for (const BitRate& rate : device_.features.bit_rates) {
    if (rate.kbit != 0) {  // CiA 306 has no key for automatic bit rate detection
      line(fmt::format("BaudRate_{}", rate.kbit), flag_text(rate.supported));
    }
  }
  opaque_keys_of("DeviceInfo");
}

void Writer::dummies() {
  if (device_.dummies.empty()) {
    return;
  }
  section("DummyUsage");
  for (const Dummy& dummy : device_.dummies) {
    line(fmt::format("Dummy{:04X}", dummy.type), flag_text(dummy.supported));
  }
  opaque_keys_of("DummyUsage");
}

void Writer::comments() {
  if (device_.comments.empty()) {
    return;
  }
  section("Comments");
  numbered("Lines", "Line", device_.comments, [](const Text& text) { return text.text; });
  opaque_keys_of("Comments");
}

void Writer::headers() {
  const Device normal = normal_headers(device_);
  section("FileInfo");
  slots(normal.file, file_slots);
  opaque_keys_of("FileInfo");
  device_info(normal);
  dummies();
  comments();
  channels();
  if (options_.as_dcf) {
    section("DeviceComissioning");
    slots(normal.commissioning, commissioning_slots);
    opaque_keys_of("DeviceComissioning");
  }
}

void Writer::channels() {
  if (device_.dynamic_channels.empty()) {
    return;
  }
  section("DynamicChannels");
  line("NrOfSeg", std::to_string(device_.dynamic_channels.size()));
  std::size_t number = 0;
  for (const DynamicChannel& channel : device_.dynamic_channels) {
    ++number;
    line(fmt::format("Type{}", number), index_text(channel.data_type));
    const bool is_direction = channel.access.value != Access::unknown;
    line(fmt::format("Dir{}", number), is_direction ? name_of(channel.access.value) : channel.access.text);
    const bool is_range = channel.last_index.is_given || channel.first_index.is_empty();
    line(fmt::format("Range{}", number),
         is_range ? index_text(channel.first_index) + "-" + index_text(channel.last_index) : channel.first_index.text);
    line(fmt::format("PPOffset{}", number), written(channel.offset, "{}"));
  }
  opaque_keys_of("DynamicChannels");
}

// Objects ----------------------------------------------------------------------------------------------------------

void Writer::entry(const Entry& entry) {
  Entry normal = eds::normal(device_, entry);
  if (!options_.as_dcf) {
    normal.actual_value.reset();
    for (Rare<Text>* text :
         {&normal.denotation, &normal.upload_file, &normal.download_file, &normal.parameter_reference}) {
      text->reset();
    }
  }
  slots(normal, entry_slots);
  if (device_.dialect == python_dialect) {
    slots(entry, python_slots);
  }
  opaque_keys(entry.others);
  const Field<std::string>& group = entry.node->storage_group;  // its text may be the number of a group
  if (!group.is_empty() || !group.value.empty()) {
    line(";StorageLocation", group.value.empty() ? group.text : group.value);  // the form that other tools read
  }
  if (entry.node->flags_pdo->value) {
    line(";TPDODetectCos", "1");
  }
}

void Writer::sub_list(const std::string& name, const std::vector<std::pair<unsigned, std::string>>& entries) {
  if (entries.empty()) {
    return;
  }
  section(name);
  line("NrOfEntries", std::to_string(entries.size()));
  for (const auto& [sub_index, text] : entries) {
    line(std::to_string(sub_index), text);
  }
}

void Writer::compact_lists(const Object& object, const std::string& name) {
  std::vector<std::pair<unsigned, std::string>> names;
  std::vector<std::pair<unsigned, std::string>> values;
  std::vector<std::pair<unsigned, std::string>> denotations;
  for (const Sub& sub : object.subs) {
    if (!sub.is_implied) {
      continue;
    }
    if (sub.name.is_given) {
      names.emplace_back(sub.sub_index, sub.name.text);
    }
    if (sub.actual_value->is_given) {
      values.emplace_back(sub.sub_index, value_text(sub.actual_value));
    }
    if (sub.denotation->is_given) {
      denotations.emplace_back(sub.sub_index, sub.denotation->text);
    }
  }
  sub_list(name + "Name", names);
  if (options_.as_dcf) {
    sub_list(name + "Value", values);
    sub_list(name + "Denotation", denotations);
  }
}

// Returns an object whose sub-objects name their groups, if one of them is not stored: an EDS cannot say otherwise that
// a sub-object of a stored object is not stored.
Object with_groups_of_subs(Object object) {
  const Field<std::string> group = object.node->storage_group;
  object.node.edit().storage_group.value = "RAM";
  for (Sub& sub : object.subs) {
    if (sub.node->storage_group.value.empty()) {
      sub.node.edit().storage_group = group;
    }
  }
  return object;
}

void Writer::object(const Object& object, const std::string& prefix) {
  const bool is_partly_stored =
      !named_group(object.node).empty() && std::any_of(object.subs.begin(), object.subs.end(), [](const Sub& sub) {
        return equal_ignoring_case(sub.node->storage_group.value, "RAM");
      });
  is_partly_stored ? object_sections(with_groups_of_subs(object), prefix) : object_sections(object, prefix);
}

void Writer::object_sections(const Object& object, const std::string& prefix) {
  const std::string name = prefix + fmt::format("{:04X}", object.index);
  section(name);
  entry(object);
  const auto described =
      std::count_if(object.subs.begin(), object.subs.end(), [](const Sub& sub) { return sub.sub_index != 0xFF; });
  if (object.compact.value != 0) {
    line("CompactSubObj", std::to_string(object.compact.value));
  } else if (has_sub_objects(object.object_code.value)) {
    line("SubNumber", std::to_string(described));
  }
  for (const Sub& sub : object.subs) {
    if (!sub.is_implied) {
      section(name + fmt::format("sub{:X}", sub.sub_index));
      entry(sub);
    }
  }
  compact_lists(object, name);
  if (!object.links.empty()) {
    section(name + "ObjectLinks");
    numbered("ObjectLinks", "", object.links, [](const auto& link) { return index_text(link); });
  }
}

void Writer::object_list(ListKind kind) {
  const std::string_view name = list_name(kind);
  std::vector<const Object*> objects;
  std::vector<const Object*> types;  // objects below 1000h, which no list contains
  for (const Object& object : device_.objects) {
    if (object.index < 0x1000 && kind == ListKind::optional) {
      types.push_back(&object);
    } else if (object.index >= 0x1000 && list_of(object.index) == kind) {
      objects.push_back(&object);
    }
  }
  section(name);
  numbered("SupportedObjects", "", objects, [](const Object* object) { return index_text(object->index); });
  opaque_keys_of(name);
  for (const Object* object : types) {
    this->object(*object, "");
  }
  for (const Object* object : objects) {
    this->object(*object, "");
  }
}

// Modules ----------------------------------------------------------------------------------------------------------

void Writer::module(const Module& module) {
  const std::string prefix = fmt::format("M{}", module.number);
  section(prefix + "ModuleInfo");
  slots(module, module_slots);
  opaque_keys(module.others);
  if (!module.comments.empty()) {
    section(prefix + "Comments");
    numbered("Lines", "Line", module.comments, [](const Text& text) { return text.text; });
  }
  section(prefix + "FixedObjects");
  numbered("NrOfEntries", "", module.fixed, [](const Object& object) { return index_text(object.index); });
  for (const Object& object : module.fixed) {
    this->object(object, prefix + "Fixed");
  }
  section(prefix + "SubExtends");
  numbered("NrOfEntries", "", module.extensions,
           [](const SubExtension& extension) { return index_text(extension.object.index); });
  for (const SubExtension& extension : module.extensions) {
    section(prefix + fmt::format("SubExt{:04X}", extension.object.index));
    entry(extension.object);
    line("Count", extension.bits.is_given ? fmt::format("{};{}", extension.count.value, extension.bits.value)
                                          : std::to_string(extension.count.value));
    if (extension.object_extension.is_given) {
      line("ObjExtend", extension.object_extension.text);
    }
  }
}

void Writer::modules() {
  if (!device_.modules.empty()) {
    section("SupportedModules");
    line("NrOfEntries", std::to_string(device_.modules.size()));
    opaque_keys_of("SupportedModules");
    for (const Module& each : device_.modules) {
      module(each);
    }
  }
  if (options_.as_dcf && !device_.connected_modules.empty()) {
    section("ConnectedModules");
    numbered("NrOfEntries", "", device_.connected_modules, [](const auto& number) { return written(number, "{}"); });
  }
}

// Writes unknown sections and those of CiA 405, without duplicates.
void Writer::other_sections() {
  for (const OpaquePart& other : device_.others) {
    const bool is_unwritten = others_.count(other.name) != 0;
    const bool is_word =
        may_be_word(other.name) && std::none_of(other.children.begin(), other.children.end(),
                                                [](const OpaquePart& key) { return is_key_of_object(key.name); });
    if (is_of_eds(device_) && is_unwritten && !other.name.empty() &&
        (is_word || section_name(other.name).kind == SectionKind::other)) {
      section(other.name);
      opaque_keys_of(other.name);
    }
  }
}

}  // namespace

std::string write(const Device& device, const WriteOptions& options) {
  Writer writer(device, options);
  writer.headers();
  writer.object_list(ListKind::mandatory);
  writer.object_list(ListKind::optional);
  writer.object_list(ListKind::manufacturer);
  writer.modules();
  writer.other_sections();
  return writer.take_text();
}

}  // namespace lexican::codict::eds
