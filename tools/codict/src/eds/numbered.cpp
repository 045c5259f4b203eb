// SPDX-License-Identifier: Apache-2.0
#include "eds/numbered.hpp"

#include <algorithm>
#include <array>

#include "eds/fields.hpp"

namespace lexican::codict::eds {

std::string_view list_name(ListKind kind) {
  constexpr std::array<std::string_view, 3> names = {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"};
  return names[static_cast<std::size_t>(kind)];
}

ListForm list_form(const SectionName& name) {
  const bool is_of_objects = name.word == list_name(ListKind::mandatory) ||
                             name.word == list_name(ListKind::optional) ||
                             name.word == list_name(ListKind::manufacturer);
  switch (name.kind) {
    case SectionKind::names:
    case SectionKind::values:
    case SectionKind::denotations: return {"NrOfEntries", "", false};
    case SectionKind::links: return {"ObjectLinks", "", true};
    case SectionKind::header:
      return name.word == "Comments" ? ListForm{"Lines", "Line", false}
             : is_of_objects         ? ListForm{"SupportedObjects", "", true}
                                     : ListForm{};
    default: return {};
  }
}

std::size_t entries_of(const Document& document, const Section& section, const ListForm& list) {
  return static_cast<std::size_t>(std::count_if(section.keys.begin(), section.keys.end(), [&](const Key& key) {
    std::uint32_t number = 0;
    const bool says_something = !list.word.empty() || !key.value.is_empty();
    return !key.is_duplicate && says_something && number_of(document.raw(key.name), list.word, number);
  }));
}

std::uint32_t last_number(const Document& document, const Section& section, const ListForm& list) {
  std::uint32_t last = 0;
  for (const Key& key : section.keys) {
    std::uint32_t number = 0;
    if (number_of(document.raw(key.name), list.word, number)) {
      last = std::max(last, number);
    }
  }
  return last;
}

}  // namespace lexican::codict::eds
