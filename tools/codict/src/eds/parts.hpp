// SPDX-License-Identifier: Apache-2.0
/// \file parts.hpp
/// The parts of the reader, a file for each.
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
/// What is checked when all headers have been read.
void check_headers(const Reader& reader);

// objects.cpp: sections of kind object and sub, or module_fixed, in any order. What belongs to none is kept in others.
std::vector<Object> read_objects(std::vector<NamedSection> parts, std::vector<Kept>& others, const Reader& reader);
/// Values get their meaning; all types must be known.
void interpret_values(Object& object, const Reader& reader);
void interpret_values(Entry& entry, const Reader& reader);
void interpret_entry(Entry& entry, bool has_subs, Findings& findings);
void read_key(Object& object, const Key& key, const Reader& reader);

// compact.cpp: names, values, denotations and links.
void expand_compact(Object& object, const Reader& reader);
/// False, with a finding, if so many further sub-objects without sections are too many.
bool take_implied_subs(std::size_t number, Span place, const Reader& reader);
void read_addition(const NamedSection& addition, const Reader& reader);

// implied_pdos.cpp: adds the objects of PDOs that CompactPDO stands for.
void add_implied_pdos(const Reader& reader);

// lists.cpp
void read_object_list(const NamedSection& header, const Reader& reader);
ObjectList read_indexes(const Section& section, std::string_view count_key, const Reader& reader);
void check_lists(const Reader& reader);

// modules.cpp
void read_modules(const std::vector<NamedSection>& sections, const Reader& reader);

}  // namespace lexican::codict::eds
