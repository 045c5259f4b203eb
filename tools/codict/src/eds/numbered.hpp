// SPDX-License-Identifier: Apache-2.0
/// \file numbered.hpp
/// Sections that are lists: a count, and numbered entries. [306: 4.6.2, 4.6.4]
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "eds/document.hpp"
#include "eds/names.hpp"
#include "model/device.hpp"

namespace lexican::codict::eds {

/// Returns the section name of an object list: "MandatoryObjects".
std::string_view list_name(ListKind kind);

/// Keys of a section that is a list.
struct ListForm {
  std::string_view count;    ///< key with the number of entries; empty: the section is not a list
  std::string_view word;     ///< prefix of the entries' numbers; may be empty
  bool has_indexes = false;  ///< the values of the entries are indexes of objects
};

ListForm list_form(const SectionName& name);

/// Returns the number of entries without duplicates. Entries without a value are not counted, except those of
/// [Comments], which are empty lines.
std::size_t entries_of(const Document& document, const Section& section, const ListForm& list);
/// Returns the highest number of an entry; 0 if there is none.
std::uint32_t last_number(const Document& document, const Section& section, const ListForm& list);

}  // namespace lexican::codict::eds
