// SPDX-License-Identifier: Apache-2.0
/// \file names.hpp
/// What the name of a section says.
#pragma once

#include <cstdint>
#include <string_view>

namespace lexican::codict::eds {

enum class SectionKind : unsigned char {
  other,
  header,            ///< of the whole file: FileInfo and so on
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
  bool is_sub = false;         ///< of module_fixed: with a sub-index
  std::string_view large_sub;  ///< digits of a sub-index beyond FFh, of the object index; kind is other
  std::uint16_t module = 0;
  std::string_view word;       ///< of header and module: as the standard writes it
  bool has_odd_zeros = false;  ///< the index not of four digits, or zeros before the sub-index
  bool has_odd_case = false;   ///< digits in small letters, or Sub
};

SectionName section_name(std::string_view name);

/// Of an object, or of what belongs to one.
inline bool has_index(const SectionName& name) {
  return name.kind >= SectionKind::object && name.kind <= SectionKind::links;
}

}  // namespace lexican::codict::eds
