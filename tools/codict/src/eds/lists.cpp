// SPDX-License-Identifier: Apache-2.0
// Reads the three object lists, and compares them with the sections, which take precedence. [306: 4.6.2]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "eds/numbered.hpp"
#include "eds/parts.hpp"
#include "eds/rules.hpp"
#include "model/parse.hpp"
#include "model/subject.hpp"

namespace lexican::codict::eds {

namespace {

struct List {
  ObjectList Device::*list;
  ListKind kind;
};

constexpr std::array<List, 3> lists = {{{&Device::mandatory, ListKind::mandatory},
                                        {&Device::optional, ListKind::optional},
                                        {&Device::manufacturer, ListKind::manufacturer}}};

void check_entry(const Field<std::uint16_t>& entry, ListKind kind, const Reader& reader) {
  if (entry.value == 0) {
    return;  // not a number, already reported
  }
  Object* const object = reader.device.find(entry.value);
  if (object == nullptr) {
    reader.findings.add(rules::list_no_section, entry.span,
                        fmt::format("listed object {:04X}h has no section", entry.value),
                        fmt::format("describe it in [{:04X}], or remove the entry", entry.value));
    return;
  }
  if (object->is_listed) {
    reader.findings.add(rules::list_twice, entry.span,
                        fmt::format("object {} is listed more than once", subject_of(*object)), "remove the entry");
  }
  object->is_listed = true;
  if (list_of(entry.value) != kind) {
    const std::string_view right = list_name(list_of(entry.value));
    reader.findings.add(rules::list_wrong, entry.span,
                        fmt::format("object {} belongs to [{}]", subject_of(*object), right),
                        fmt::format("move it to [{}]", right));
  }
}

}  // namespace

ObjectList read_indexes(const Section& section, std::string_view count_key, const Reader& reader) {
  const NumberedList numbered = read_list(section, count_key, "", Gaps::are_wrong, reader);
  ObjectList list;
  list.count = numbered.count;
  list.is_given = true;
  list.span = section.name;
  for (const NumberedKey& entry : numbered.entries) {
    Field<std::uint16_t>& index = list.indexes.emplace_back();
    static_cast<Text&>(index) = text_of(reader.document, *entry.key);
    interpret_number(index, 0xFFFF, reader.findings);
  }
  OpaquePart opaque{reader.document.text(section.name), {}, {}, section.name};
  for (const Key* key : numbered.others) {
    store_opaque_key(*key, opaque.children, reader);
  }
  if (!opaque.children.empty()) {
    reader.device.others.push_back(std::move(opaque));
  }
  return list;
}

void read_object_list(const NamedSection& header, const Reader& reader) {
  for (const List& list : lists) {
    if (header.name.word == list_name(list.kind)) {
      reader.device.*list.list = read_indexes(*header.section, "SupportedObjects", reader);
    }
  }
}

void check_lists(const Reader& reader) {
  bool has_lists = false;
  for (const List& list : lists) {
    has_lists = has_lists || (reader.device.*list.list).is_given;
    for (const Field<std::uint16_t>& entry : (reader.device.*list.list).indexes) {
      check_entry(entry, list.kind, reader);
    }
  }
  for (Object& object : reader.device.objects) {
    const bool is_type = object.index < 0x1000;  // the lists begin at 1000h
    if (!object.is_listed && !is_type) {
      reader.findings.add(rules::list_unlisted, object.span,
                          has_lists ? "object is in no list" : "object lists are missing; all objects are read",
                          fmt::format("add it to [{}]", list_name(list_of(object.index))));
    }
  }
}

}  // namespace lexican::codict::eds
