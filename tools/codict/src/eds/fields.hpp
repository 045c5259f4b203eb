// SPDX-License-Identifier: Apache-2.0
/// \file fields.hpp
/// Assignment of the keys of a section to members of the model, by tables.
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

/// Context of a read, shared by all parts of the reader.
struct Reader {
  const Document& document;
  Device& device;
  Findings& findings;
  std::size_t& implied_subs;  ///< number of sub-objects that compact storage has created so far
};

Text text_of(const Document& document, const Key& key);
/// Return a key or a section as a part that the model does not interpret.
OpaquePart opaque_part(const Document& document, const Key& key);
OpaquePart opaque_part(const Document& document, const Section& section);

/// A key of CiA 306 and the member of the model that holds its value.
template <typename T>
struct Slot {
  std::string_view key;
  Text& (*member)(T&);
  std::size_t longest = 0;  ///< limit of CiA 306 in characters; 0: no limit
};

/// Reports a text that exceeds a limit in characters; 0: no limit.
void report_length(const Text& text, std::size_t longest, Findings& findings);

/// Returns the span of a section from its header to its last line.
Span extent_of(const Document& document, const Section& section);

/// Keys that CANopenEditor (libEDSsharp) stores in comments: ";StorageLocation=PERSIST".
inline constexpr std::string_view storage_key = "StorageLocation";
inline constexpr std::string_view trigger_key = "TPDODetectCos";

/// Returns a key in a comment; none if there is none.
std::optional<Key> comment_key(const Document& document, const Section& section, std::string_view name);
/// Adds a key in a comment behind the last line of a section. Returns false in the cases of Document::set_value().
bool add_comment_key(const Document& document, const Section& section, std::string_view name, std::string_view text,
                     Edits& edits);

/// Sets the member of a key. Returns false if no slot has this key.
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

/// Reads all keys of a section. Duplicates and keys without a slot are added to `others`; unknown ones are reported.
template <typename T, std::size_t size>
void read_section(T& target, const Section& section, const std::array<Slot<T>, size>& slots,
                  std::vector<OpaquePart>& others, const Reader& reader);

/// Adds a key without a slot to `others`. Reports it as unknown, unless it is a duplicate or has no value.
void store_opaque_key(const Key& key, std::vector<OpaquePart>& others, const Reader& reader);

template <typename T, std::size_t size>
void read_section(T& target, const Section& section, const std::array<Slot<T>, size>& slots,
                  std::vector<OpaquePart>& others, const Reader& reader) {
  for (const Key& key : section.keys) {
    if (key.is_duplicate || !read_into(target, key, slots, reader)) {
      store_opaque_key(key, others, reader);
    }
  }
}

/// A key that consists of a word and a decimal number, or of a number alone.
struct NumberedKey {
  std::uint32_t number = 0;
  const Key* key = nullptr;
};

/// A list of CiA 306: a key with the number of entries, and numbered entries.
struct NumberedList {
  Field<std::uint32_t> count;
  std::vector<NumberedKey> entries;  ///< sorted by number
  std::vector<const Key*> others;    ///< keys of the section that do not belong to the list
};

/// Whether the numbers of a list may have gaps.
enum class Gaps : bool { are_wrong, are_right };

/// Reads a section that is a list with a count (count_key: "NrOfEntries"). Reports a wrong count, entries without a
/// value, and gaps in the numbers if they are wrong.
NumberedList read_list(const Section& section, std::string_view count_key, std::string_view word, Gaps gaps,
                       const Reader& reader);

/// Reads the number at the end of a key. Returns false if the key is not `word` and a number.
bool number_of(std::string_view key, std::string_view word, std::uint32_t& number);

}  // namespace lexican::codict::eds
