// SPDX-License-Identifier: Apache-2.0
/// \file document.hpp
/// The text of an EDS or DCF, with nothing lost: sections, keys and values are spans of the source, and changes of it
/// are splices. Without a change, what is written is what was read, byte for byte. [CiA 306: 4]
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

/// A line "key=value". Both without blanks around them.
struct Key {
  Span name;
  Span value;
  std::uint32_t line = 0;
  bool is_duplicate = false;  ///< of an earlier one in its section
};

struct Section {
  Span name;               ///< inside the brackets
  std::uint32_t line = 0;  ///< of the brackets
  std::uint32_t end = 0;   ///< the line behind its last one
  bool is_duplicate = false;
  std::vector<Key> keys;
  std::vector<std::uint32_t> by_name;  ///< their places, sorted by name and place
};

class Document {
 public:
  /// Takes any bytes; findings get what is not as the standard has it.
  Document(Source source, Findings& findings);

  const Source& source() const { return source_; }
  Encoding encoding() const { return encoding_; }
  const std::vector<Section>& sections() const { return sections_; }
  const std::vector<Key>& keys_outside() const { return keys_outside_; }  ///< before the first section

  /// The first of a name; null if there is none. Neither has capitals and small letters of its own.
  const Section* find(std::string_view section) const;
  const Key* find(const Section& section, std::string_view key) const;

  std::string_view raw(Span span) const { return source_.slice(span); }
  std::string text(Span span) const { return to_utf8(raw(span), encoding_); }

  /// The comments of a section, each without the sign that begins it: offsets are those of the source.
  std::vector<Span> comments(const Section& section) const;

  /// The last line that says something. Comments behind it precede the next section, but for keys that tools hide in
  /// them (";StorageLocation=RAM").
  std::uint32_t last_line(const Section& section) const;

  /// What replaces a value, or adds a key as the last of a section, in the manner of the lines around it. Text is
  /// UTF-8; false if the encoding of the source lacks a letter of it, or if it has a line end.
  bool set_value(const Key& key, std::string_view text, Edits& edits) const;
  bool add_key(const Section& section, std::string_view name, std::string_view text, Edits& edits) const;

  /// What ends its lines.
  std::string_view line_end() const;
  /// One line of UTF-8 in the encoding of the source; false as above.
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
  std::vector<std::uint32_t> by_name_;  // sections, sorted by name and place
};

/// Of names: ASCII letters are the same in both cases, blanks count nothing.
int compare_names(std::string_view a, std::string_view b);

}  // namespace lexican::codict::eds
