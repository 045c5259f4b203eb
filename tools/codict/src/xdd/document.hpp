// SPDX-License-Identifier: Apache-2.0
/// \file document.hpp
/// The text of an XML description, with nothing lost: elements, attributes and texts are spans of the source, and
/// changes of it are splices. Without a change, what is written is what was read, byte for byte.
///
/// Nothing outside the source is ever read, and entities of a DTD are not expanded.
#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "model/value.hpp"
#include "text/edit.hpp"
#include "text/encoding.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"

namespace lexican::codict::xdd {

/// The name without its prefix: namespaces decide nothing, since too many files have wrong ones.
std::string_view local_name(std::string_view name);
inline std::string_view local_name(pugi::xml_node node) { return local_name(node.name()); }
inline std::string_view local_name(pugi::xml_attribute attribute) { return local_name(attribute.name()); }

class Document {
 public:
  /// Deeper descriptions are none, and would need much of the stack.
  static constexpr std::size_t most_levels = 64;

  /// Takes any bytes; findings get what is not well-formed. What can be read of such a text, is.
  Document(Source source, Findings& findings);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const Source& source() const { return source_; }
  Encoding encoding() const { return encoding_; }
  pugi::xml_node root() const { return root_; }      ///< null if there is none
  bool is_too_deep() const { return is_too_deep_; }  ///< then root() is null

  std::string_view raw(Span span) const { return source_.slice(span); }
  Span tag(pugi::xml_node element) const;          ///< its start tag, brackets with it
  Span whole(pugi::xml_node element) const;        ///< from its start tag to the end of its content
  Span span(pugi::xml_attribute attribute) const;  ///< of the value, without the quotes
  Text text(pugi::xml_attribute attribute) const;
  /// Of what stands in an element outside other elements; the span is that of an empty place, or of all of it.
  Text text(pugi::xml_node element) const;

  /// What replaces a text that the source has: the value of an attribute, the content of an element. Text is UTF-8;
  /// false if the encoding of the source lacks a letter of it, or XML has no way to write it.
  bool set_text(Span span, std::string_view text, Edits& edits) const;
  /// A new attribute as the last one of a start tag, a new element as the first one behind a start tag on a line of its
  /// own. `at` is any place in the start tag.
  bool add_attribute(std::uint32_t at, std::string_view name, std::string_view text, Edits& edits) const;
  bool add_element(std::uint32_t at, std::string_view name, std::string_view attribute, std::string_view text,
                   Edits& edits) const;

 private:
  std::uint32_t offset(const char* place) const { return static_cast<std::uint32_t>(place - buffer_.data()); }
  void find_root(Findings& findings);
  std::string decoded(Span span, bool is_attribute) const;
  bool encoded(std::string_view text, bool is_attribute, std::string& bytes) const;
  std::uint32_t tag_begin(std::uint32_t at) const;
  std::uint32_t tag_end(std::uint32_t at) const;  ///< at: outside of values

  Source source_;
  std::string buffer_;  // the source again: the parser puts ends of strings into it
  pugi::xml_document tree_;
  pugi::xml_node root_;
  Encoding encoding_ = Encoding::utf8;
  bool is_too_deep_ = false;
};

/// Signs of markup become references; in attributes, quotes of both kinds and line ends, too.
/// What XML has no character for becomes U+FFFD.
std::string escaped(std::string_view text);
std::string escaped_attribute(std::string_view text);

}  // namespace lexican::codict::xdd
