// SPDX-License-Identifier: Apache-2.0
#include "eds/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

#include "eds/rules.hpp"
#include "model/parse.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

Text text_of(const Document& document, const Key& key) { return {document.text(key.value), key.value, true}; }

OpaquePart opaque_part(const Document& document, const Key& key) {
  return {document.text(key.name), text_of(document, key), {}, {key.name.begin, key.value.end}};
}

OpaquePart opaque_part(const Document& document, const Section& section) {
  OpaquePart result;
  result.name = document.text(section.name);
  result.span = section.name;
  for (const Key& key : section.keys) {
    result.children.push_back(opaque_part(document, key));
  }
  return result;
}

Span extent_of(const Document& document, const Section& section) {
  const Source& source = document.source();
  return {source.line(section.line).begin, source.line(section.end - 1).end};
}

std::optional<Key> comment_key(const Document& document, const Section& section, std::string_view name) {
  for (const Span comment : document.comments(section)) {
    const std::string_view text = document.raw(comment);
    if (equal_ignoring_case(text.substr(0, name.size()), name) && text.substr(name.size(), 1) == "=") {
      const std::uint32_t end = comment.begin + static_cast<std::uint32_t>(name.size());
      return Key{{comment.begin, end}, {end + 1, comment.end}, 0, false};
    }
  }
  return std::nullopt;
}

bool add_comment_key(const Document& document, const Section& section, std::string_view name, std::string_view text,
                     Edits& edits) {
  std::string line;
  const bool is_possible = document.to_source(fmt::format(";{}={}", name, text), line);
  edits.insert(document.source().line(document.last_line(section)).end, std::string(document.line_end()) + line);
  return is_possible;
}

void report_length(const Text& text, std::size_t longest, Findings& findings) {
  if (longest != 0 && text.span.size() > longest) {
    findings.add(rules::key_length, text.span,
                 fmt::format("text has {} characters, more than {}", text.span.size(), longest), "shorten it");
  }
}

void store_opaque_key(const Key& key, std::vector<OpaquePart>& others, const Reader& reader) {
  others.push_back(opaque_part(reader.document, key));
  if (!key.is_duplicate && !key.value.is_empty()) {  // an empty value counts as a missing key
    reader.findings.add(rules::key_unknown, key.name,
                        fmt::format("key {} is unknown to CiA 306", in_quotes(reader.document.text(key.name))),
                        "check the spelling");
  }
}

bool number_of(std::string_view key, std::string_view word, std::uint32_t& number) {
  if (key.size() <= word.size() || !equal_ignoring_case(key.substr(0, word.size()), word)) {
    return false;
  }
  const std::string_view digits = key.substr(word.size());
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  return error == std::errc() && stop == end;
}

NumberedList read_list(const Section& section, std::string_view count_key, std::string_view word, Gaps gaps,
                       const Reader& reader) {
  const Document& document = reader.document;
  NumberedList list;
  for (const Key& key : section.keys) {
    NumberedKey entry{0, &key};
    const std::string_view name = document.raw(key.name);
    const bool is_count = compare_names(name, count_key) == 0;
    const bool is_entry = number_of(name, word, entry.number);
    const bool is_empty = is_entry && word.empty() && key.value.is_empty();
    if (key.is_duplicate || is_empty || !(is_count || is_entry)) {
      list.others.push_back(&key);
    } else if (is_entry) {
      list.entries.push_back(entry);
    } else {
      static_cast<Text&>(list.count) = text_of(document, key);
      interpret_number(list.count, std::numeric_limits<std::uint32_t>::max(), reader.findings);
    }
    if (is_empty) {
      reader.findings.add(rules::list_entry, key.name, fmt::format("list entry {} has no value", entry.number),
                          "write the index of an object, or remove the entry");
    }
  }
  std::stable_sort(list.entries.begin(), list.entries.end(),
                   [](const NumberedKey& a, const NumberedKey& b) { return a.number < b.number; });
  const std::size_t size = list.entries.size();
  if (list.count.value != size || !list.count.is_given) {
    const Span place = list.count.is_given ? list.count.span : section.name;
    const std::string count = list.count.is_given ? in_quotes(list.count.text) : "missing";
    reader.findings.add(rules::list_count, place,
                        fmt::format("{} is {}, but the number of entries is {}", count_key, count, size),
                        fmt::format("{}={}", count_key, size));
  }
  for (std::size_t n = 0; n < size && gaps == Gaps::are_wrong; ++n) {
    if (list.entries[n].number != n + 1) {
      reader.findings.add(rules::list_numbers, list.entries[n].key->name,
                          fmt::format("list entry {} instead of {}", list.entries[n].number, n + 1),
                          "number the entries from 1 without gaps");
      break;
    }
  }
  return list;
}

}  // namespace lexican::codict::eds
