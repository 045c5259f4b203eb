// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// Functions of the reader, grouped by the files that define them.
#pragma once

#include <vector>

#include "eds/fields.hpp"
#include "eds/names.hpp"

namespace lexican::codict::eds {

struct NamedSection {
  SectionName name;
  const Section* section = nullptr;
};

// headers.cpp
void read_header(const NamedSection& header, const Reader& reader);
/// Checks the headers after all of them have been read.
void check_headers(const Reader& reader);

// objects.cpp: reads sections of kind object, sub or module_fixed, in any order. Duplicates are added to `others`.
std::vector<Object> read_objects(std::vector<NamedSection> parts, std::vector<OpaquePart>& others,
                                 const Reader& reader);
/// Interpret the values. All objects must have been read, because they may define data types.
void interpret_values(Object& object, const Reader& reader);
void interpret_values(Entry& entry, const Reader& reader);
void interpret_entry(Entry& entry, bool has_subs, Findings& findings);
void read_key(Object& object, const Key& key, const Reader& reader);

// compact.cpp: creates the sub-objects of compact storage; reads lists of names, values and denotations, and object
// links.
void expand_compact(Object& object, const Reader& reader);
/// Returns false, with a finding, if `number` further sub-objects without sections would exceed the limit.
bool take_implied_subs(std::size_t number, Span place, const Reader& reader);
void read_addition(const NamedSection& addition, const Reader& reader);

// implied_pdos.cpp: adds the parameters of PDOs that only CompactPDO describes.
void add_implied_pdos(const Reader& reader);

// lists.cpp
void read_object_list(const NamedSection& header, const Reader& reader);
ObjectList read_indexes(const Section& section, std::string_view count_key, const Reader& reader);
void check_lists(const Reader& reader);

// modules.cpp
void read_modules(const std::vector<NamedSection>& sections, const Reader& reader);

}  // namespace lexican::codict::eds
