// SPDX-License-Identifier: Apache-2.0
/// \file document.hpp
/// The text of an EDS or DCF without loss: sections, keys and values are spans of the source, and edits are splices. An
/// unedited document is written byte for byte as it was read. [CiA 306: 4]
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "text/edit.hpp"
#include "text/encoding.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::eds {

/// A line "key=value". Name and value exclude surrounding blanks.
struct Key {
  Span name;
  Span value;
  std::uint32_t line = 0;
  bool is_duplicate = false;  ///< an earlier key in its section has the same name
};

struct Section {
  Span name;               ///< inside the brackets
  std::uint32_t line = 0;  ///< line of its header
  std::uint32_t end = 0;   ///< number of the line after its last one
  bool is_duplicate = false;
  std::vector<Key> keys;
  std::vector<std::uint32_t> by_name;  ///< indexes in `keys`, sorted by name and position
};

class Document {
 public:
  /// Parses any bytes. Adds a finding for each deviation from the standard.
  Document(Source source, Findings& findings);

  const Source& source() const { return source_; }
  Encoding encoding() const { return encoding_; }
  const std::vector<Section>& sections() const { return sections_; }
  const std::vector<Key>& keys_outside() const { return keys_outside_; }  ///< before the first section

  /// Return the first section or key whose name is equal by compare_names(); null if there is none.
  const Section* find(std::string_view section) const;
  const Key* find(const Section& section, std::string_view key) const;

  std::string_view raw(Span span) const { return source_.slice(span); }
  std::string text(Span span) const { return to_utf8(raw(span), encoding_); }

  /// Returns a line without surrounding blanks, and the first one without byte order mark.
  Span content(std::uint32_t line) const;

  /// Returns the comments of a section that begin with a semicolon, without the semicolon, as spans of the source.
  std::vector<Span> comments(const Section& section) const;

  /// Returns the number of the section's last line that is neither empty nor a comment. Comments after it belong to
  /// the next section. A key that a tool has hidden in a comment (";StorageLocation=RAM") counts as a key.
  std::uint32_t last_line(const Section& section) const;

  /// Replace the value of a key, or add a key at the end of a section, with the line end and the blanks around "=" of
  /// the preceding key. Text is UTF-8; return false if the encoding of the source lacks a character of it, or if it
  /// contains a line end or NUL.
  bool set_value(const Key& key, std::string_view text, Edits& edits) const;
  bool add_key(const Section& section, std::string_view name, std::string_view text, Edits& edits) const;

  /// Returns the line end of the source.
  std::string_view line_end() const;
  /// Converts a line of UTF-8 to the encoding of the source. Returns false in the cases of set_value().
  bool to_source(std::string_view text, std::string& bytes) const;

 private:
  void read_line(std::uint32_t number, Findings& findings);
  void read_section(std::uint32_t number, Span line, Findings& findings);
  void read_key(std::uint32_t number, Span line, Findings& findings);
  void sort_names(Findings& findings);

  Source source_;
  Encoding encoding_ = Encoding::ascii;
  std::vector<Section> sections_;
  std::vector<Key> keys_outside_;
  std::vector<std::uint32_t> by_name_;  // indexes in `sections_`, sorted by name and position
};

/// Compares names of sections or keys: ASCII letters in any case are equal, blanks are ignored. Returns a number below,
/// equal to or above 0.
int compare_names(std::string_view a, std::string_view b);

}  // namespace lexican::codict::eds
