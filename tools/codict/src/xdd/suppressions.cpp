// SPDX-License-Identifier: Apache-2.0
#include "xdd/suppressions.hpp"

#include <algorithm>
#include <cstddef>

namespace lexican::codict::xdd {

namespace {

bool begins(std::string_view bytes, std::size_t at, std::string_view word) {
  return bytes.substr(at, word.size()) == word;
}

// Returns the offset behind the next occurrence of a word, or the size if there is none.
std::size_t behind(std::string_view bytes, std::size_t at, std::string_view word) {
  const std::size_t found = bytes.find(word, at);
  return found == std::string_view::npos ? bytes.size() : found + word.size();
}

// Collects the spans of an element and all elements in it, in the order of their start tags.
void collect(const Document& document, pugi::xml_node element, std::vector<Span>& elements) {
  elements.push_back(document.whole(element));
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      collect(document, child, elements);  // recursion is limited by most_levels
    }
  }
}

// Returns the span of the element that begins at an offset (the whole file for the root); none if there is no element.
std::optional<Span> scope_at(std::size_t at, const std::vector<Span>& elements, std::uint32_t size) {
  const auto element = std::lower_bound(elements.begin(), elements.end(), at,
                                        [](const Span& each, std::size_t begin) { return each.begin < begin; });
  if (element == elements.end() || element->begin != at) {
    return std::nullopt;
  }
  return element == elements.begin() ? Span{0, size} : *element;
}

// Returns the offset of the next tag before `end`, except comments and processing instructions; `end` if there is none.
std::size_t tag_behind(std::string_view bytes, std::size_t at, std::size_t end) {
  for (at = bytes.find('<', at); at < end; at = bytes.find('<', at)) {
    if (begins(bytes, at, "<!--")) {
      at = behind(bytes, at, "-->");
    } else if (begins(bytes, at, "<!") || begins(bytes, at, "<?")) {
      at = behind(bytes, at, ">");
    } else {
      return at;
    }
  }
  return end;
}

// Returns the content of the next comment; an empty span at the end if there is none.
Span next_comment(std::string_view bytes, std::size_t at) {
  for (at = bytes.find("<!", at); at != std::string_view::npos; at = bytes.find("<!", at)) {
    if (begins(bytes, at, "<!--")) {
      const std::size_t end = std::min(bytes.find("-->", at + 4), bytes.size());
      return {static_cast<std::uint32_t>(at + 4), static_cast<std::uint32_t>(end)};
    }
    at = begins(bytes, at, "<![CDATA[") ? behind(bytes, at, "]]>") : at + 2;
  }
  return {static_cast<std::uint32_t>(bytes.size()), static_cast<std::uint32_t>(bytes.size())};
}

}  // namespace

std::size_t number_of_comments(const Document& document) {
  const std::string_view bytes = document.source().bytes();
  std::size_t number = 0;
  for (Span comment = next_comment(bytes, 0); comment.begin < bytes.size();
       comment = next_comment(bytes, comment.end)) {
    ++number;
  }
  return number;
}

std::vector<Suppression> find_suppressions(const Document& document) {
  const std::string_view bytes = document.source().bytes();
  std::vector<Suppression> all;
  for (Span comment = next_comment(bytes, 0); comment.begin < bytes.size();
       comment = next_comment(bytes, comment.end)) {
    const std::vector<Suppression> here = suppressions_in(document.source(), comment);
    all.insert(all.end(), here.begin(), here.end());
  }
  std::vector<Span> elements;
  if (!all.empty() && document.root()) {
    collect(document, document.root(), elements);
  }
  // Iterates backwards, so that consecutive comments are scanned once: `tag` and `end` describe the later comment.
  std::size_t tag = bytes.size();
  std::size_t end = bytes.size();
  for (auto each = all.rbegin(); each != all.rend(); ++each) {
    const std::size_t next = tag_behind(bytes, behind(bytes, each->rule.end, "-->"), end);
    tag = next == end ? tag : next;
    end = std::min<std::size_t>(end, each->rule.begin);
    each->scope = scope_at(tag, elements, document.source().size());
  }
  return all;
}

}  // namespace lexican::codict::xdd
