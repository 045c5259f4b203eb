// SPDX-License-Identifier: Apache-2.0
#include "eds/names.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

constexpr std::array<std::string_view, 12> header_words = {
    "FileInfo",
    "DeviceInfo",
    "DummyUsage",
    "Comments",
    "MandatoryObjects",
    "OptionalObjects",
    "ManufacturerObjects",
    "DeviceComissioning",
    "DeviceCommissioning",
    "SupportedModules",
    "ConnectedModules",
    "DynamicChannels",
};
constexpr std::array<std::string_view, 4> module_words = {"ModuleInfo", "Comments", "FixedObjects", "SubExtends"};

struct Suffix {
  std::string_view word;
  SectionKind kind;
};
constexpr std::array<Suffix, 4> suffixes = {{{"Name", SectionKind::names},
                                             {"Value", SectionKind::values},
                                             {"Denotation", SectionKind::denotations},
                                             {"ObjectLinks", SectionKind::links}}};

bool is_hex(char c) { return is_digit(c) || (to_lower(c) >= 'a' && to_lower(c) <= 'f'); }
bool is_small(char c) { return c >= 'a' && c <= 'z'; }

constexpr std::string_view sub_word = "sub";

bool begins_with(std::string_view text, std::string_view word) {
  return equal_ignoring_case(text.substr(0, word.size()), word);
}

// Removes and returns the index at the beginning: at most four digits, because hexadecimal letters may follow it
// (1A00Denotation). An index of two or three digits that begins with a letter (A0) is that of an object or sub-object.
std::string_view take_index(std::string_view& text) {
  const std::string_view start = text.substr(0, 4);
  const auto end = std::find_if_not(start.begin(), start.end(), is_hex);
  const std::string_view digits = start.substr(0, static_cast<std::size_t>(end - start.begin()));
  const std::string_view rest = text.substr(digits.size());
  const bool is_short = digits.size() < 4 && (digits.empty() || !is_digit(digits.front()));
  const std::string_view behind = rest.substr(begins_with(rest, "h") ? 1 : 0);
  if (is_short && (digits.size() < 2 || !(behind.empty() || begins_with(behind, sub_word)))) {
    return {};
  }
  text = rest;
  return digits;
}

// Removes 0x before an index, or h behind one, which CiA 306 does not allow. Returns false if there is none.
bool take_mark(std::string_view& text, std::string_view mark) {
  const bool is_there = begins_with(text, mark);
  text.remove_prefix(is_there ? mark.size() : 0);
  return is_there;
}

bool to_number(std::string_view digits, std::uint64_t largest, std::uint64_t& number) {
  return !digits.empty() && parse_hex(digits, number) && number <= largest;
}

// Reads "sub" and a sub-index behind an index. Returns false for any other text.
bool read_sub_index(std::string_view suffix, SectionName& name) {
  const std::string_view digits = suffix.substr(std::min(sub_word.size(), suffix.size()));
  std::uint64_t sub_index = 0;
  if (!begins_with(suffix, sub_word) || !to_number(digits, std::numeric_limits<std::uint64_t>::max(), sub_index)) {
    return false;
  }
  if (sub_index > 0xFF) {
    name.large_sub = digits;
    return false;
  }
  name.sub_index = static_cast<std::uint8_t>(sub_index);
  name.is_sub = true;
  name.has_odd_zeros = name.has_odd_zeros || (digits.size() > 1 && digits.front() == '0');
  name.has_odd_case = name.has_odd_case || suffix.substr(0, sub_word.size()) != sub_word ||
                      std::any_of(digits.begin(), digits.end(), is_small);
  return true;
}

// Returns the kind of list that the word behind an index names; other if it names none.
SectionKind list_kind(std::string_view suffix) {
  const auto* const found = std::find_if(suffixes.begin(), suffixes.end(), [suffix](const Suffix& candidate) {
    return equal_ignoring_case(suffix, candidate.word);
  });
  return found != suffixes.end() ? found->kind : SectionKind::other;
}

// Reads an index and the text behind it. Leaves name.kind unchanged if the text has another form.
void read_indexed(std::string_view text, SectionKind alone, SectionKind with_sub, SectionName& name) {
  const bool has_prefix = take_mark(text, "0x");
  const std::string_view digits = take_index(text);
  std::uint64_t index = 0;
  if (!to_number(digits, 0xFFFF, index)) {
    return;
  }
  SectionName read = name;
  read.has_mark = take_mark(text, "h") || has_prefix;
  read.index = static_cast<std::uint16_t>(index);
  read.has_odd_zeros = digits.size() != 4;
  read.has_odd_case = std::any_of(digits.begin(), digits.end(), is_small);
  if (text.empty()) {
    read.kind = alone;
  } else if (read_sub_index(text, read)) {
    read.kind = with_sub;
  } else if (alone == SectionKind::object) {
    read.kind = list_kind(text);
  }
  if (!read.large_sub.empty()) {
    name.index = read.index;
    name.large_sub = read.large_sub;
  } else if (read.kind != SectionKind::other) {
    name = read;
  }
}

void read_module(std::string_view text, SectionName& name) {
  std::uint16_t number = 0;
  std::size_t size = 0;
  while (size < text.size() && size < 4 && is_digit(text[size])) {
    number = static_cast<std::uint16_t>(number * 10 + (text[size] - '0'));
    ++size;
  }
  if (size == 0) {
    return;
  }
  text.remove_prefix(size);
  name.module = number;
  for (const std::string_view word : module_words) {
    if (equal_ignoring_case(text, word)) {
      name.kind = SectionKind::module;
      name.word = word;
      return;
    }
  }
  constexpr std::string_view fixed = "Fixed";
  constexpr std::string_view extension = "SubExt";
  if (equal_ignoring_case(text.substr(0, fixed.size()), fixed)) {
    read_indexed(text.substr(fixed.size()), SectionKind::module_fixed, SectionKind::module_fixed, name);
  } else if (equal_ignoring_case(text.substr(0, extension.size()), extension)) {
    read_indexed(text.substr(extension.size()), SectionKind::module_extension, SectionKind::other, name);
  }
}

}  // namespace

bool may_be_word(std::string_view name) {
  const bool has_h = !name.empty() && to_lower(name.back()) == 'h';
  const std::string_view digits = name.substr(0, name.size() - (has_h ? 1 : 0));
  const bool are_letters = std::none_of(digits.begin(), digits.end(), is_digit);
  const bool is_short = digits.size() < 4 && !digits.empty() && !is_digit(digits.front());
  return digits.size() >= 2 && digits.size() <= 4 && std::all_of(digits.begin(), digits.end(), is_hex) &&
         (are_letters || (has_h && is_short));
}

bool is_key_of_object(std::string_view key) {
  constexpr std::string_view keys[] = {"ObjectType",   "DataType",       "ParameterName", "AccessType",
                                       "DefaultValue", "ParameterValue", "SubNumber"};
  return std::any_of(std::begin(keys), std::end(keys),
                     [key](std::string_view each) { return compare_names(key, each) == 0; });
}

SectionName section_name(const Document& document, const Section& section) {
  const std::string_view name = document.raw(section.name);
  const bool is_word = may_be_word(name) &&
                       std::none_of(section.keys.begin(), section.keys.end(),
                                    [&document](const Key& key) { return is_key_of_object(document.raw(key.name)); });
  return is_word ? SectionName() : section_name(name);
}

SectionName section_name(std::string_view name) {
  SectionName result;
  for (const std::string_view word : header_words) {
    if (compare_names(name, word) == 0) {
      result.kind = SectionKind::header;
      result.word = word;
      return result;
    }
  }
  if (!name.empty() && to_lower(name.front()) == 'm') {
    read_module(name.substr(1), result);
  } else {
    read_indexed(name, SectionKind::object, SectionKind::sub, result);
  }
  return result;
}

}  // namespace lexican::codict::eds
