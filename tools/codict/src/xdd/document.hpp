// SPDX-License-Identifier: Apache-2.0
/// \file document.hpp
/// The text of an XML description without loss: elements, attributes and texts are spans of the source, and edits are
/// splices. An unedited document is written byte for byte as it was read.
///
/// Reads nothing outside the source, and expands no entities of a DTD. The elements need several times the memory of
/// the source: they exist until the description has been read.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/value.hpp"
#include "text/edit.hpp"
#include "text/encoding.hpp"
#include "text/finding.hpp"
#include "text/source.hpp"
#include "text/suppression.hpp"

namespace lexican::codict::xdd {

/// Returns a name without its prefix. Namespaces are not compared, because too many files declare wrong ones.
std::string_view local_name(std::string_view name);
inline std::string_view local_name(pugi::xml_node node) { return local_name(node.name()); }
inline std::string_view local_name(pugi::xml_attribute attribute) { return local_name(attribute.name()); }

class Document {
 public:
  /// Limit of nested elements. Deeper documents are not descriptions, and would need too much stack.
  static constexpr std::size_t most_levels = 64;

  /// Parses any bytes. Adds findings for text that is not well-formed, and reads the part before the fault.
  Document(Source source, Findings& findings);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const Source& source() const { return source_; }
  Encoding encoding() const { return encoding_; }
  pugi::xml_node root() const { return root_; }      ///< null if there is none, or after release()
  bool is_too_deep() const { return is_too_deep_; }  ///< root() is null then

  const std::vector<Suppression>& suppressions() const { return suppressions_; }
  /// Frees the elements. The source, the suppressions and all functions with a span remain usable.
  void release();

  std::string_view raw(Span span) const { return source_.slice(span); }
  Span tag(pugi::xml_node element) const;          ///< span of the start tag with its brackets
  Span whole(pugi::xml_node element) const;        ///< span from the start tag to the end of the content
  Span span(pugi::xml_attribute attribute) const;  ///< span of the value, without the quotes
  Text text(pugi::xml_attribute attribute) const;
  /// Returns the text in an element outside its child elements. Its span is that of all text, or an empty place behind
  /// the start tag.
  Text text(pugi::xml_node element) const;

  /// Replaces a text of the source: the value of an attribute, or the content of an element. Text is UTF-8. Returns
  /// false if the encoding of the source lacks a character of it, or if XML cannot represent it.
  bool set_text(Span span, std::string_view text, Edits& edits) const;
  /// Adds an attribute at the end of a start tag. `at` is any offset in the start tag.
  bool add_attribute(std::uint32_t at, std::string_view name, std::string_view text, Edits& edits) const;
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;
  /// Adds an element as the last child of another one, indented like its first child. `whole`: that of the parent,
  /// which must not contain elements of the same name. Returns false if the parent has no end tag, too.
  bool add_element(Span whole, std::string_view name, Attributes attributes, Edits& edits) const;

 private:
  std::uint32_t offset(const char* place) const { return static_cast<std::uint32_t>(place - buffer_.data()); }
  void find_root(Findings& findings);
  std::string decoded(Span span, bool is_attribute) const;
  bool encoded(std::string_view text, bool is_attribute, std::string& bytes) const;
  std::uint32_t tag_begin(std::uint32_t at) const;
  std::uint32_t tag_end(std::uint32_t at) const;  ///< `at` is an offset outside of quoted values

  Source source_;
  std::string buffer_;  // copy of the source, into which the parser writes terminators
  pugi::xml_document tree_;
  pugi::xml_node root_;
  std::vector<Suppression> suppressions_;
  Encoding encoding_ = Encoding::utf8;
  bool is_too_deep_ = false;
};

/// Replace signs of markup by references; in attributes, both kinds of quotes and line ends, too. Characters that XML
/// does not allow become U+FFFD.
std::string escaped(std::string_view text);
std::string escaped_attribute(std::string_view text);

}  // namespace lexican::codict::xdd
