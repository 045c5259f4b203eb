// SPDX-License-Identifier: Apache-2.0
#include "cli/field.hpp"

#include <algorithm>
#include <array>

#include "eds/names.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

namespace {

struct Word {
  std::string_view field;
  std::string_view key;
};

constexpr std::array<Word, 11> words = {{
    {"name", "ParameterName"},
    {"object", "ObjectType"},
    {"type", "DataType"},
    {"access", "AccessType"},
    {"default", "DefaultValue"},
    {"value", "ParameterValue"},
    {"low", "LowLimit"},
    {"high", "HighLimit"},
    {"pdo", "PDOMapping"},
    {"flags", "ObjFlags"},
    {"denotation", "Denotation"},
}};

// An object without sub-objects is its own sub-index 0, and its section has no sub-index.
bool is_section_of(const eds::SectionName& name, const Reference& reference, bool is_variable) {
  if (name.index != reference.index) {
    return false;
  }
  if (!reference.sub_index || (is_variable && *reference.sub_index == 0)) {
    return name.kind == eds::SectionKind::object;
  }
  return name.kind == eds::SectionKind::sub && name.sub_index == *reference.sub_index;
}

}  // namespace

std::string_view key_of(std::string_view field) {
  const auto* const word =
      std::find_if(words.begin(), words.end(), [field](const Word& w) { return equal_ignoring_case(w.field, field); });
  return word != words.end() ? word->key : field;
}

const eds::Section* find_section(const Input& input, const std::string& target, std::string& why) {
  const eds::Document& document = *input.document;
  if (const eds::Section* const section = document.find(target); section != nullptr) {
    return section;
  }
  Reference reference;
  if (!parse_reference(target, reference)) {
    why = "neither an object nor a section: " + target;
    return nullptr;
  }
  const Object* const object = input.device().find(reference.index);
  const bool is_variable = object != nullptr && object->subs.empty();
  for (const eds::Section& section : document.sections()) {
    if (is_section_of(eds::section_name(document.raw(section.name)), reference, is_variable)) {
      return &section;
    }
  }
  const bool is_implied = find(input.device(), reference) != nullptr;
  why = is_implied ? to_string(reference) + " has no section of its own: it is in compact storage"
                   : "there is no object " + to_string(reference);
  return nullptr;
}

}  // namespace lexican::codict::cli
