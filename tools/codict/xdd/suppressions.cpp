// SPDX-License-Identifier: Apache-2.0
#include "xdd/suppressions.hpp"

#include <algorithm>
#include <cstddef>

namespace lexican::codict::xdd {

namespace {

bool begins(std::string_view bytes, std::size_t at, std::string_view word) {
  return bytes.substr(at, word.size()) == word;
}

// Behind the next occurrence of a word, or at the end.
std::size_t behind(std::string_view bytes, std::size_t at, std::string_view word) {
  const std::size_t found = bytes.find(word, at);
  return found == std::string_view::npos ? bytes.size() : found + word.size();
}

// In the order of their start tags.
void collect(const Document& document, pugi::xml_node element, std::vector<Span>& elements) {
  elements.push_back(document.whole(element));
  for (const pugi::xml_node child : element.children()) {
    if (child.type() == pugi::node_element) {
      collect(document, child, elements);  // as deep as most_levels at most
    }
  }
}

// Of the element that begins next, if anything does before another one ends.
std::optional<Span> scope_behind(std::string_view bytes, std::size_t at, const std::vector<Span>& elements) {
  for (at = bytes.find('<', at); at != std::string_view::npos; at = bytes.find('<', at)) {
    if (begins(bytes, at, "<!--")) {
      at = behind(bytes, at, "-->");
    } else if (begins(bytes, at, "<!") || begins(bytes, at, "<?")) {
      at = behind(bytes, at, ">");
    } else {
      break;
    }
  }
  const auto element = std::lower_bound(elements.begin(), elements.end(), at,
                                        [](const Span& each, std::size_t begin) { return each.begin < begin; });
  if (element == elements.end() || element->begin != at) {
    return std::nullopt;
  }
  return element == elements.begin() ? Span{0, static_cast<std::uint32_t>(bytes.size())} : *element;
}

}  // namespace

std::vector<Suppression> suppressions(const Document& document) {
  const std::string_view bytes = document.source().bytes();
  std::vector<Suppression> all;
  std::vector<Span> elements;
  for (std::size_t at = bytes.find("<!"); at != std::string_view::npos; at = bytes.find("<!", at)) {
    if (!begins(bytes, at, "<!--")) {
      at = begins(bytes, at, "<![CDATA[") ? behind(bytes, at, "]]>") : at + 2;
      continue;
    }
    const std::size_t begin = at + 4;
    at = std::max(begin, behind(bytes, begin, "-->"));
    const std::size_t end = std::max(begin, at - std::min<std::size_t>(at, 3));
    for (Suppression each :
         suppressions_in(document.source(), {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)})) {
      if (elements.empty() && document.root()) {
        collect(document, document.root(), elements);
      }
      each.scope = scope_behind(bytes, at, elements);
      all.push_back(each);
    }
  }
  return all;
}

}  // namespace lexican::codict::xdd
