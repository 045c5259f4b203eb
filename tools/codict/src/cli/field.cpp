// SPDX-License-Identifier: Apache-2.0
#include "cli/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "eds/fields.hpp"
#include "eds/names.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

namespace {

// Returns the data type as written. In XML it may be given by the parameter only.
const Text& type_of(const Entry& entry) {
  return entry.data_type.is_given || !entry.type->iec.is_given ? entry.data_type : entry.type->iec;
}

struct Word {
  std::string_view field;
  std::string_view key;  // of CiA 306, or in a comment (";StorageLocation"); empty: an EDS has none
  const Text& (*text)(const Entry&);
};

constexpr std::array<Word, 19> words = {{
    {"name", "ParameterName", [](const Entry& e) -> const Text& { return e.name; }},
    {"object", "ObjectType", [](const Entry& e) -> const Text& { return e.object_code; }},
    {"type", "DataType", type_of},
    {"access", "AccessType", [](const Entry& e) -> const Text& { return e.access; }},
    {"default", "DefaultValue", [](const Entry& e) -> const Text& { return e.default_value; }},
    {"value", "ParameterValue", [](const Entry& e) -> const Text& { return e.actual_value; }},
    {"low", "LowLimit", [](const Entry& e) -> const Text& { return e.low_limit; }},
    {"high", "HighLimit", [](const Entry& e) -> const Text& { return e.high_limit; }},
    {"pdo", "PDOMapping", [](const Entry& e) -> const Text& { return e.pdo_mapping; }},
    {"flags", "ObjFlags", [](const Entry& e) -> const Text& { return e.flags; }},
    {"denotation", "Denotation", [](const Entry& e) -> const Text& { return e.denotation; }},
    {"CO_storageGroup", ";StorageLocation", [](const Entry& e) -> const Text& { return e.node->storage_group; }},
    {"CO_flagsPDO", ";TPDODetectCos", [](const Entry& e) -> const Text& { return *e.node->flags_pdo; }},
    {"CO_extensionIO", "", [](const Entry& e) -> const Text& { return *e.node->extension_io; }},
    {"CO_disabled", "", [](const Entry& e) -> const Text& { return *e.node->disabled; }},
    {"CO_countLabel", "", [](const Entry& e) -> const Text& { return *e.node->count_label; }},
    {"CO_accessSRDO", "", [](const Entry& e) -> const Text& { return *e.node->srdo; }},
    {"CO_stringLengthMin", "", [](const Entry& e) -> const Text& { return *e.node->string_length_min; }},
    {"CO_byteLength", "", [](const Entry& e) -> const Text& { return *e.node->byte_length; }},
}};

bool is_in_comment(std::string_view key) { return key.substr(0, 1) == ";"; }

// A key in a comment is also the name of its field, without the semicolon.
const Word* find_word(std::string_view field) {
  const auto* const word = std::find_if(words.begin(), words.end(), [field](const Word& w) {
    return equal_ignoring_case(w.field, field) || (is_in_comment(w.key) && equal_ignoring_case(w.key.substr(1), field));
  });
  return word != words.end() ? word : nullptr;
}

// Returns true if the section describes the referenced entry. An object without sub-objects has a section without
// sub-index, which is its sub-index 0.
bool is_section_of(const eds::SectionName& name, const Reference& reference, bool is_variable) {
  if (name.index != reference.index) {
    return false;
  }
  if (!reference.sub_index || (is_variable && *reference.sub_index == 0)) {
    return name.kind == eds::SectionKind::object;
  }
  return name.kind == eds::SectionKind::sub && name.sub_index == *reference.sub_index;
}

// Returns the list of compact storage that contains a field of sub-objects; empty if there is none. [306: 4.6.4]
std::string_view list_of(std::string_view key) {
  return key == "ParameterName"    ? "Name"
         : key == "ParameterValue" ? "Value"
         : key == "Denotation"     ? "Denotation"
                                   : std::string_view();
}

}  // namespace

std::string_view key_of(std::string_view field) {
  const Word* const word = find_word(field);
  return word != nullptr ? word->key : field;
}

std::string_view property_of(std::string_view field) {
  const Word* const word = find_word(field);
  return word != nullptr && word->field.substr(0, 3) == "CO_" ? word->field : std::string_view();
}

std::optional<eds::Key> find_key(const eds::Document& document, const eds::Section& section, std::string_view key) {
  if (is_in_comment(key)) {
    return eds::comment_key(document, section, key.substr(1));
  }
  const eds::Key* const found = document.find(section, key);
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

bool add_key(const eds::Document& document, const eds::Section& section, std::string_view key, std::string_view text,
             Edits& edits) {
  return is_in_comment(key) ? eds::add_comment_key(document, section, key.substr(1), text, edits)
                            : document.add_key(section, key, text, edits);
}

bool parse_assignment(std::string_view text, Assignment& assignment, std::string& why) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || trimmed(text.substr(0, equals)).empty()) {
    why = "not of the form field=value: " + std::string(text);
    return false;
  }
  assignment = {trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
  return true;
}

bool has_one_line(std::string_view text, std::string& why) {
  const bool is_one = text.find_first_of("\r\n") == std::string_view::npos;
  why = is_one ? why : "a value has one line";
  return is_one;
}

const eds::Section* find_section(const Input& input, const std::string& target, std::string& why) {
  const eds::Document& document = *input.eds;
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
    if (is_section_of(eds::section_name(document, section), reference, is_variable)) {
      return &section;
    }
  }
  const bool is_implied = find(input.device(), reference) != nullptr;
  const bool is_in_compact_storage =
      cli::is_implied(input, reference) || input.device().features.compact_pdo.value == 0;
  why = is_implied ? to_string(reference) + " has no section: it is " +
                         (is_in_compact_storage ? "in compact storage" : "created by CompactPDO")
                   : "object " + to_string(reference) + " does not exist";
  return nullptr;
}

bool is_implied(const Input& input, const Reference& reference) {
  const Object* const object = input.device().find(reference.index);
  const Sub* const sub = object != nullptr && reference.sub_index ? object->find(*reference.sub_index) : nullptr;
  return sub != nullptr && sub->is_implied;
}

bool add_to_lists(const Reference& reference, const Assignment& assignment, std::string& lines, std::string& why) {
  const std::string_view list = list_of(key_of(assignment.field));
  if (!has_one_line(assignment.text, why)) {
    return false;
  }
  if (list.empty()) {
    why = to_string(reference) + " is in compact storage, where only name, value and denotation can be set";
    return false;
  }
  lines +=
      fmt::format("[{:04X}{}]\nNrOfEntries=1\n{}={}\n", reference.index, list, *reference.sub_index, assignment.text);
  return true;
}

const Entry* find_entry(const Input& input, const std::string& target, std::string& why) {
  Reference reference;
  const bool is_reference = parse_reference(target, reference);
  const Entry* const entry = is_reference ? find(input.device(), reference) : nullptr;
  if (entry == nullptr) {
    why = is_reference ? "object " + to_string(reference) + " does not exist"
                       : "no object: " + target + "; only an EDS or DCF has sections";
  }
  return entry;
}

const Text* find_text(const Entry& entry, std::string_view field) {
  const Word* const word = find_word(field);
  return word != nullptr ? &word->text(entry) : nullptr;
}

void for_each_text(const Entry& entry, const std::function<void(std::string_view, const Text&)>& call) {
  for (const Word& word : words) {
    if (word.text(entry).is_given) {
      call(word.field, word.text(entry));
    }
  }
}

}  // namespace lexican::codict::cli
