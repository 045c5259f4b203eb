// SPDX-License-Identifier: Apache-2.0
/// \file fields.hpp
/// Keys of a section become members of the model, by tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "eds/document.hpp"
#include "model/device.hpp"
#include "text/finding.hpp"

namespace lexican::codict::eds {

/// What the parts of the reader share.
struct Reader {
  const Document& document;
  Device& device;
  Findings& findings;
  std::size_t& implied_subs;  ///< that compact storage has made up so far
};

Text text_of(const Document& document, const Key& key);
Kept kept(const Document& document, const Key& key);
Kept kept(const Document& document, const Section& section);

/// The key of a section, and the member that it becomes.
template <typename T>
struct Slot {
  std::string_view key;
  Text& (*member)(T&);
  std::size_t longest = 0;  ///< characters that CiA 306 allows; 0: any number
};

void report_length(const Text& text, std::size_t longest, Findings& findings);

/// Returns the text of a section from its header to its last line.
Span extent_of(const Document& document, const Section& section);

/// ";StorageLocation=PERSIST", a key that libEDSsharp hides in a comment; none if there is none.
std::optional<Key> storage_location(const Document& document, const Section& section);

/// False if no slot is that of the key.
template <typename T, std::size_t size>
bool read_into(T& target, const Key& key, const std::array<Slot<T>, size>& slots, const Reader& reader) {
  for (const Slot<T>& slot : slots) {
    if (compare_names(reader.document.raw(key.name), slot.key) == 0) {
      Text& member = slot.member(target);
      member = text_of(reader.document, key);
      report_length(member, slot.longest, reader.findings);
      return true;
    }
  }
  return false;
}

/// All keys of a section; what is no slot's, or there twice, is kept in others, and reported if it is unknown.
template <typename T, std::size_t size>
void read_section(T& target, const Section& section, const std::array<Slot<T>, size>& slots, std::vector<Kept>& others,
                  const Reader& reader);

void keep_key(const Key& key, std::vector<Kept>& others, const Reader& reader);

template <typename T, std::size_t size>
void read_section(T& target, const Section& section, const std::array<Slot<T>, size>& slots, std::vector<Kept>& others,
                  const Reader& reader) {
  for (const Key& key : section.keys) {
    if (key.is_duplicate || !read_into(target, key, slots, reader)) {
      keep_key(key, others, reader);
    }
  }
}

/// Keys that are a word and a decimal number, or a number alone, by number.
struct NumberedKey {
  std::uint32_t number = 0;
  const Key* key = nullptr;
};

struct NumberedList {
  Field<std::uint32_t> count;
  std::vector<NumberedKey> entries;  ///< with a value
  std::vector<const Key*> others;
};

enum class Gaps : bool { are_wrong, are_right };

/// count_key: "NrOfEntries". What does not fit together is reported.
NumberedList read_list(const Section& section, std::string_view count_key, std::string_view word, Gaps gaps,
                       const Reader& reader);

/// The number at the end of a key; false if the key is not the word and a number.
bool number_of(std::string_view key, std::string_view word, std::uint32_t& number);

}  // namespace lexican::codict::eds
