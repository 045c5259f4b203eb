// SPDX-License-Identifier: Apache-2.0
#include "xdd/document.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <utility>

#include "text/memory.hpp"
#include "text/number.hpp"
#include "xdd/rules.hpp"
#include "xdd/suppressions.hpp"

namespace lexican::codict::xdd {

namespace {

// Leaves values as they are in the source; references are resolved by text().
constexpr unsigned parse_options = pugi::parse_cdata | pugi::parse_doctype;

constexpr std::string_view white = " \t\r\n";

std::string_view without_white(std::string_view text) {
  const std::size_t first = text.find_first_not_of(white);
  return first == std::string_view::npos ? text.substr(0, 0)
                                         : text.substr(first, text.find_last_not_of(white) - first + 1);
}

void append_utf8(std::uint32_t code, std::string& text) {
  const auto put = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3F));
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

bool is_character(std::uint32_t code) { return code != 0 && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF); }

// Appends the character of a reference such as "#10" or "#xA". Returns false for any other text.
bool append_number_reference(std::string_view name, std::string& text) {
  if (name.size() < 2 || name.front() != '#') {
    return false;
  }
  const bool is_hex = name[1] == 'x';
  const std::string_view digits = name.substr(is_hex ? 2 : 1);
  std::uint32_t code = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, code, is_hex ? 16 : 10);
  if (error != std::errc() || stop != end || !is_character(code)) {
    return false;
  }
  append_utf8(code, text);
  return true;
}

struct Reference {
  std::string_view name;
  char sign;
};
constexpr std::array<Reference, 5> xml_references = {
    {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};

bool append_reference(std::string_view name, std::string& text) {
  for (const Reference& reference : xml_references) {
    if (reference.name == name) {
      text += reference.sign;
      return true;
    }
  }
  return append_number_reference(name, text);
}

// Resolves the references of XML itself. Other references, such as those of a DTD, are unchanged.
std::string without_references(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const std::size_t sign = std::min(text.find('&'), text.size());
    plain += text.substr(0, sign);
    text.remove_prefix(sign);
    const std::size_t end = text.substr(0, 16).find(';');
    if (end != std::string_view::npos && append_reference(text.substr(1, end - 1), plain)) {
      text.remove_prefix(end + 1);
    } else if (!text.empty()) {
      plain += '&';
      text.remove_prefix(1);
    }
  }
  return plain;
}

// Normalises line ends to LF and, in attributes, all white space to blanks. [XML 1.0: 2.11, 3.3.3]
std::string with_plain_white(std::string_view text, bool is_attribute) {
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const char c = text[n];
    const bool is_of_line_end = c == '\r' && n + 1 < text.size() && text[n + 1] == '\n';
    const bool is_blank = is_attribute && (c == '\r' || c == '\n' || c == '\t');
    if (!is_of_line_end) {
      plain += is_blank ? ' ' : (c == '\r' ? '\n' : c);
    }
  }
  return plain;
}

// Returns the encoding of <?xml encoding="…"?>; UTF-8 if it is missing or unknown.
Encoding declared_encoding(std::string_view bytes) {
  const std::size_t begin = mark_size(bytes);
  const std::string_view declaration = bytes.substr(begin, bytes.find("?>", begin) - begin);
  const std::size_t word = declaration.find("encoding");
  if (declaration.substr(0, 5) != "<?xml" || word == std::string_view::npos) {
    return Encoding::utf8;
  }
  const std::size_t quote = declaration.find_first_of("\"'", word);
  const std::string_view name = declaration.substr(std::min(quote, declaration.size() - 1) + 1);
  for (const std::string_view latin : {"iso-8859-1", "windows-1252", "latin1", "cp1252"}) {
    if (equal_ignoring_case(name.substr(0, latin.size()), latin)) {
      return Encoding::cp1252;
    }
  }
  return Encoding::utf8;
}

Encoding encoding_of(const Source& source, Findings& findings) {
  const Encoding declared = declared_encoding(source.bytes());
  const Encoding guess = guess_encoding(source.bytes());
  if (guess == Encoding::ascii || guess == Encoding::utf8 || declared == guess) {
    return declared == Encoding::utf8 ? Encoding::utf8 : declared;
  }
  if (declared == Encoding::utf8) {
    findings.add(rules::encoding, {0, 0}, "bytes are not UTF-8, read as " + std::string(name_of(guess)),
                 "save the file as UTF-8, or declare its encoding");
  }
  return declared == Encoding::utf8 ? guess : declared;
}

// Returns whether XML forbids a control character; CR is escaped before. [XML 1.0: 2.2]
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'; }

bool is_deeper_than(pugi::xml_node root, std::size_t most) {
  std::size_t level = 0;
  for (pugi::xml_node node = root; node;) {
    if (level > most) {
      return true;
    }
    if (const pugi::xml_node child = node.first_child()) {
      node = child;
      ++level;
      continue;
    }
    while (node && !node.next_sibling()) {
      node = node == root ? pugi::xml_node() : node.parent();
      --level;
    }
    node = node == root || !node ? pugi::xml_node() : node.next_sibling();
  }
  return false;
}

}  // namespace

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

Document::Document(Source source, Findings& findings)
    : source_(std::move(source)), buffer_(source_.bytes()), encoding_(encoding_of(source_, findings)) {
  const pugi::xml_parse_result result =
      tree_.load_buffer_inplace(buffer_.data(), buffer_.size(), parse_options, pugi::encoding_utf8);
  if (!result && result.status != pugi::status_no_document_element) {
    const auto at = static_cast<std::uint32_t>(std::clamp<std::int64_t>(result.offset, 0, source_.size()));
    findings.add(rules::syntax, {at, at}, std::string("not well-formed: ") + result.description(),
                 "correct the XML at this place");
  }
  find_root(findings);
  suppressions_ = find_suppressions(*this);
}

void Document::find_root(Findings& findings) {
  for (const pugi::xml_node node : tree_) {
    if (node.type() == pugi::node_doctype) {
      const std::uint32_t at = offset(node.value());
      findings.add(rules::doctype, {at, at}, "document type, whose entities are not used", "remove it");
    } else if (node.type() == pugi::node_element && !root_) {
      root_ = node;
    }
  }
  is_too_deep_ = is_deeper_than(root_, most_levels);
  if (is_too_deep_) {
    root_ = {};
  }
}

void Document::release() {
  root_ = {};
  tree_.reset();
  buffer_ = {};
  return_free_memory();
}

std::uint32_t Document::tag_end(std::uint32_t at) const {
  const std::string_view bytes = source_.bytes();
  char quote = 0;
  for (; at < bytes.size(); ++at) {
    const char c = bytes[at];
    if (quote != 0) {
      quote = c == quote ? '\0' : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at + 1;
    }
  }
  return source_.size();
}

std::uint32_t Document::tag_begin(std::uint32_t at) const {
  const std::size_t begin = source_.bytes().rfind('<', at);
  return begin == std::string_view::npos ? at : static_cast<std::uint32_t>(begin);
}

Span Document::tag(pugi::xml_node element) const {
  const std::uint32_t name = offset(element.name());
  const pugi::xml_attribute last = element.last_attribute();
  const std::uint32_t behind =
      last ? span(last).end + 1 : name + static_cast<std::uint32_t>(std::string_view(element.name()).size());
  return {name - 1, tag_end(std::min(behind, source_.size()))};
}

Span Document::whole(pugi::xml_node element) const {
  Span span = tag(element);
  for (pugi::xml_node last = element.last_child(); last; last = last.last_child()) {
    const std::string_view value = last.type() == pugi::node_element ? std::string_view() : last.value();
    span.end = value.empty() ? tag(last).end : offset(value.data()) + static_cast<std::uint32_t>(value.size());
  }
  return span;
}

Span Document::span(pugi::xml_attribute attribute) const {
  const std::string_view value = attribute.value();
  // The value of an attribute at which the parser stopped is not in the buffer.
  const bool is_here = value.data() >= buffer_.data() && value.data() <= buffer_.data() + buffer_.size();
  const std::uint32_t begin = offset(is_here ? value.data() : attribute.name());
  return {begin, begin + static_cast<std::uint32_t>(value.size())};
}

std::string Document::decoded(Span span, bool is_attribute) const {
  const std::string_view bytes = raw(span);
  const bool is_plain =
      std::none_of(bytes.begin(), bytes.end(), [](char c) { return c == '&' || c == '\r' || c == '\n' || c == '\t'; });
  if (is_plain && encoding_ == Encoding::utf8) {
    return std::string(bytes);
  }
  return without_references(with_plain_white(to_utf8(bytes, encoding_), is_attribute));
}

Text Document::text(pugi::xml_attribute attribute) const {
  const Span all = span(attribute);
  const std::string_view content = without_white(raw(all));
  const auto begin = all.begin + static_cast<std::uint32_t>(content.empty() ? 0 : content.data() - raw(all).data());
  const Span place{begin, begin + static_cast<std::uint32_t>(content.size())};
  return {decoded(place, true), content.empty() ? all : place, true};
}

Text Document::text(pugi::xml_node element) const {
  Text text;
  for (const pugi::xml_node child : element) {
    if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) {
      continue;
    }
    const std::string_view all = child.value();
    const std::string_view value = child.type() == pugi::node_pcdata ? without_white(all) : all;
    const std::uint32_t begin = offset(value.empty() ? all.data() : value.data());
    const Span span{begin, begin + static_cast<std::uint32_t>(value.size())};
    text.text += child.type() == pugi::node_pcdata ? decoded(span, false) : to_utf8(raw(span), encoding_);
    text.span = {text.is_given ? text.span.begin : begin, span.end};
    text.is_given = true;
  }
  if (!text.is_given) {
    const std::uint32_t behind = tag(element).end;
    text.span = {behind, behind};
  }
  return text;
}

bool Document::encoded(std::string_view text, bool is_attribute, std::string& bytes) const {
  const bool is_possible = std::all_of(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n'; });
  return is_possible && from_utf8(is_attribute ? escaped_attribute(text) : escaped(text), encoding_, bytes);
}

bool Document::set_text(Span span, std::string_view text, Edits& edits) const {
  const bool is_attribute = tag_end(tag_begin(span.begin)) > span.begin;
  if (decoded(span, is_attribute) == text) {
    return true;  // equal text, possibly written with other references
  }
  std::string bytes;
  if (!encoded(text, is_attribute, bytes)) {
    return false;
  }
  edits.replace(span, std::move(bytes));
  return true;
}

bool Document::add_attribute(std::uint32_t at, std::string_view name, std::string_view text, Edits& edits) const {
  std::string bytes;
  if (!encoded(text, true, bytes)) {
    return false;
  }
  std::uint32_t end = tag_end(tag_begin(at)) - 1;
  const std::string_view source = source_.bytes();
  while (end > at && (source[end - 1] == '/' || white.find(source[end - 1]) != std::string_view::npos)) {
    --end;
  }
  edits.insert(end, " " + std::string(name) + "=\"" + bytes + "\"");
  return true;
}

namespace {

// Returns the position of the next end tag of an element, outside of comments, CDATA sections and processing
// instructions; npos if there is none.
std::size_t find_end_tag(std::string_view bytes, std::string_view name, std::size_t from) {
  constexpr std::pair<std::string_view, std::string_view> skipped[] = {
      {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
  const std::string end_tag = "</" + std::string(name);
  while ((from = bytes.find('<', from)) != std::string_view::npos) {
    const std::string_view rest = bytes.substr(from);
    if (rest.substr(0, end_tag.size()) == end_tag) {
      return from;
    }
    const auto* const found = std::find_if(std::begin(skipped), std::end(skipped), [rest](const auto& each) {
      return rest.substr(0, each.first.size()) == each.first;
    });
    from = found == std::end(skipped) ? from + 1 : bytes.find(found->second, from);
  }
  return from;
}

}  // namespace

bool Document::add_element(Span whole, std::string_view name, Attributes attributes, Edits& edits) const {
  const std::string_view bytes = source_.bytes();
  const std::uint32_t begin = tag_end(whole.begin);
  const std::string_view opened = raw({whole.begin, begin}).substr(1);
  const std::string_view full = opened.substr(0, opened.find_first_of(" \t\r\n/>"));
  const std::size_t close = find_end_tag(bytes, full, std::max(begin, whole.end));
  if (close == std::string_view::npos || raw({begin - 2, begin}) == "/>") {
    return false;
  }
  std::string element(full.substr(0, full.size() - local_name(full).size()));  // the prefix of the parent
  element += name;
  for (const auto& [attribute, text] : attributes) {
    std::string value;
    if (!encoded(text, true, value)) {
      return false;
    }
    element += " " + std::string(attribute) + "=\"" + value + "\"";
  }
  const std::string_view behind = bytes.substr(begin);
  const std::string_view indent = behind.substr(0, std::min(behind.find_first_not_of(white), behind.size()));
  const std::size_t last = bytes.find_last_not_of(white, close - 1);
  edits.insert(static_cast<std::uint32_t>(last) + 1, std::string(indent) + "<" + element + "/>");
  return true;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\r': result += "&#13;"; break;
      default: result += is_control(c) ? replacement : std::string_view(&c, 1);
    }
  }
  return result;
}

std::string escaped_attribute(std::string_view text) {
  std::string result;
  for (const char c : escaped(text)) {
    switch (c) {
      case '\n': result += "&#10;"; break;
      case '\t': result += "&#9;"; break;
      case '\'': result += "&apos;"; break;
      default: result += c;
    }
  }
  return result;
}

}  // namespace lexican::codict::xdd
