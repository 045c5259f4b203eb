// SPDX-License-Identifier: Apache-2.0
/// \file words.hpp
/// Words of enumerations. They belong to the schema, and are independent of the words of other formats.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "model/device.hpp"

namespace lexican::codict::json {

template <typename E>
struct Word {
  E value;
  std::string_view word;
};

inline constexpr std::array<Word<Access>, 8> access_words = {{
    {Access::unknown, "unknown"},
    {Access::none, "none"},
    {Access::ro, "ro"},
    {Access::wo, "wo"},
    {Access::rw, "rw"},
    {Access::rwr, "rwr"},
    {Access::rww, "rww"},
    {Access::constant, "const"},
}};
inline constexpr std::array<Word<PdoMapping>, 5> mapping_words = {{
    {PdoMapping::no, "no"},
    {PdoMapping::optional, "optional"},
    {PdoMapping::standard, "default"},
    {PdoMapping::tpdo, "tpdo"},
    {PdoMapping::rpdo, "rpdo"},
}};
inline constexpr std::array<Word<ObjectCode>, 7> code_words = {{
    {ObjectCode::null, "null"},
    {ObjectCode::domain, "domain"},
    {ObjectCode::deftype, "deftype"},
    {ObjectCode::defstruct, "defstruct"},
    {ObjectCode::variable, "var"},
    {ObjectCode::array, "array"},
    {ObjectCode::record, "record"},
}};
inline constexpr std::array<Word<SrdoAccess>, 4> srdo_words = {{
    {SrdoAccess::no, "no"},
    {SrdoAccess::tx, "tx"},
    {SrdoAccess::rx, "rx"},
    {SrdoAccess::trx, "trx"},
}};
inline constexpr std::array<Word<TypeDefinition::Kind>, 4> definition_words = {{
    {TypeDefinition::Kind::array, "array"},
    {TypeDefinition::Kind::structure, "struct"},
    {TypeDefinition::Kind::enumeration, "enum"},
    {TypeDefinition::Kind::derived, "derived"},
}};
inline constexpr std::array<Word<Format>, 10> format_words = {{
    {Format::eds, "eds"},
    {Format::dcf, "dcf"},
    {Format::xdd10, "xdd10"},
    {Format::xdd11, "xdd11"},
    {Format::xdc10, "xdc10"},
    {Format::xdc11, "xdc11"},
    {Format::xpd, "xpd"},
    {Format::nxdd, "nxdd"},
    {Format::project_xml, "project_xml"},
    {Format::other_xml, "other_xml"},
}};
inline constexpr std::array<Word<Value::Kind>, 6> value_words = {{
    {Value::Kind::none, "none"},
    {Value::Kind::integer, "integer"},
    {Value::Kind::real, "real"},
    {Value::Kind::text, "text"},
    {Value::Kind::octets, "octets"},
    {Value::Kind::malformed, "malformed"},
}};

template <typename E>
constexpr const auto& words_of() {
  if constexpr (std::is_same_v<E, Access>) {
    return access_words;
  } else if constexpr (std::is_same_v<E, PdoMapping>) {
    return mapping_words;
  } else if constexpr (std::is_same_v<E, ObjectCode>) {
    return code_words;
  } else if constexpr (std::is_same_v<E, SrdoAccess>) {
    return srdo_words;
  } else if constexpr (std::is_same_v<E, TypeDefinition::Kind>) {
    return definition_words;
  } else if constexpr (std::is_same_v<E, Format>) {
    return format_words;
  } else {
    static_assert(std::is_same_v<E, Value::Kind>);
    return value_words;
  }
}

template <typename E>
std::string_view word_of(E value) {
  for (const Word<E>& word : words_of<E>()) {
    if (word.value == value) {
      return word.word;
    }
  }
  return {};
}

}  // namespace lexican::codict::json
