// SPDX-License-Identifier: Apache-2.0
// Reads the modules of a bus coupler, which extend its dictionary. [306: 4.7]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "eds/slots.hpp"
#include "model/parse.hpp"

namespace lexican::codict::eds {

namespace {

// Interprets Count: "3" sub-objects, or "0;2" for two bits.
void interpret_count(SubExtension& extension, Findings& findings) {
  const std::size_t semicolon = extension.count.text.find(';');
  if (semicolon != std::string::npos) {
    const auto offset = static_cast<std::uint32_t>(semicolon);
    extension.bits.text = extension.count.text.substr(semicolon + 1);
    extension.bits.span = {extension.count.span.begin + offset + 1, extension.count.span.end};
    extension.bits.is_given = true;
    extension.count.text.resize(semicolon);
    extension.count.span.end = extension.count.span.begin + offset;
    interpret_number(extension.bits, 0xFFFF, findings);
  }
  interpret_number(extension.count, 0xFFFF, findings);
}

SubExtension read_extension(const NamedSection& named, const Reader& reader) {
  SubExtension extension;
  extension.object.index = named.name.index;
  extension.object.span = named.section->name;
  extension.object.extent = extent_of(reader.document, *named.section);
  for (const Key& key : named.section->keys) {
    if (key.is_duplicate || !read_into(extension, key, extension_slots, reader)) {
      read_key(extension.object, key, reader);
    }
  }
  interpret_entry(extension.object, false, reader.findings);
  interpret_count(extension, reader.findings);
  interpret_number(extension.object_extension, 0xFFFFFFFF, reader.findings);
  return extension;
}

void read_part(Module& module, const NamedSection& named, const Reader& reader) {
  const Section& section = *named.section;
  if (named.name.word == "ModuleInfo") {
    read_section(module, section, module_slots, module.others, reader);
  } else if (named.name.word == "FixedObjects") {
    module.fixed_list = read_indexes(section, "NrOfEntries", reader);
  } else if (named.name.word == "SubExtends") {
    module.extension_list = read_indexes(section, "NrOfEntries", reader);
  } else {
    const NumberedList list = read_list(section, "Lines", "Line", Gaps::are_wrong, reader);
    for (const NumberedKey& entry : list.entries) {
      module.comments.push_back(text_of(reader.document, *entry.key));
    }
    for (const Key* key : list.others) {
      store_opaque_key(*key, module.others, reader);
    }
  }
}

}  // namespace

void read_modules(const std::vector<NamedSection>& sections, const Reader& reader) {
  std::map<std::uint16_t, Module> modules;
  std::map<std::uint16_t, std::vector<NamedSection>> fixed;
  for (const NamedSection& named : sections) {
    Module& module = modules[named.name.module];
    module.number = named.name.module;
    if (named.section->is_duplicate) {
      module.others.push_back(opaque_part(reader.document, *named.section));
    } else if (named.name.kind == SectionKind::module_fixed) {
      fixed[named.name.module].push_back(named);
    } else if (named.name.kind == SectionKind::module_extension) {
      module.extensions.push_back(read_extension(named, reader));
    } else {
      read_part(module, named, reader);
    }
  }
  for (auto& [number, module] : modules) {
    module.fixed = read_objects(std::move(fixed[number]), module.others, reader);
    for (Object& object : module.fixed) {
      interpret_values(object, reader);
    }
    for (SubExtension& extension : module.extensions) {
      interpret_values(static_cast<Entry&>(extension.object), reader);
    }
    reader.device.modules.push_back(std::move(module));
  }
  if (reader.device.module_count.value != modules.size() && reader.device.module_count.is_given) {
    reader.findings.add(rules::list_count, reader.device.module_count.span,
                        fmt::format("NrOfEntries is {}, but the number of modules is {}",
                                    in_quotes(reader.device.module_count.text), modules.size()),
                        fmt::format("NrOfEntries={}", modules.size()));
  }
}

}  // namespace lexican::codict::eds
