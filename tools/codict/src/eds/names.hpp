// SPDX-License-Identifier: Apache-2.0
/// \file names.hpp
/// Interpretation of section names.
#pragma once

#include <cstdint>
#include <string_view>

#include "eds/document.hpp"

namespace lexican::codict::eds {

enum class SectionKind : unsigned char {
  other,
  header,            ///< about the whole file: FileInfo, DeviceInfo and others
  object,            ///< 1A00
  sub,               ///< 1A00sub1
  names,             ///< 1A00Name
  values,            ///< 1A00Value
  denotations,       ///< 1A00Denotation
  links,             ///< 1A00ObjectLinks
  module,            ///< M1ModuleInfo, M1Comments, M1FixedObjects, M1SubExtends
  module_fixed,      ///< M1Fixed6000, M1Fixed6000sub1
  module_extension,  ///< M1SubExt6000
};

struct SectionName {
  SectionKind kind = SectionKind::other;
  std::uint16_t index = 0;
  std::uint8_t sub_index = 0;
  bool is_sub = false;         ///< for module_fixed: the name has a sub-index
  std::string_view large_sub;  ///< for 1A00sub100: the digits "100", which exceed FFh; kind is then `other`
  std::uint16_t module = 0;
  std::string_view word;       ///< for header and module: the word as CiA 306 spells it
  bool has_odd_zeros = false;  ///< the index has other than four digits, or the sub-index has leading zeros
  bool has_mark = false;       ///< 0x before the index, or h behind it
  bool has_odd_case = false;   ///< lower-case digits, or upper-case letters in "sub"
};

/// Returns true for names of objects that may be words of other tools: FACE, BACh, A0h. They are names of objects only
/// if the section has a key of objects.
bool may_be_word(std::string_view name);
/// Returns true for the keys ObjectType, DataType and ParameterName.
bool is_key_of_object(std::string_view key);

/// Interpret the name of a section; kind `other` if CiA 306 does not define such a name, or if it is a word.
SectionName section_name(const Document& document, const Section& section);
/// Like the other one, but names that may be words are names of objects.
SectionName section_name(std::string_view name);

/// Returns whether a section describes an object or a part of one.
inline bool has_index(const SectionName& name) {
  return name.kind >= SectionKind::object && name.kind <= SectionKind::links;
}

}  // namespace lexican::codict::eds
