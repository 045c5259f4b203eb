// SPDX-License-Identifier: Apache-2.0
#include "cli/baseline.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "cli/letters.hpp"
#include "text/file.hpp"
#include "text/number.hpp"

namespace lexican::codict::cli {

namespace {

constexpr const char* schema = "codict-baseline-1";
constexpr std::size_t longest_place = 200;

// Limits a span to longest_place bytes, without splitting a UTF-8 character.
Span shortened(const Source& source, Span span) {
  const std::string_view bytes = source.slice(span);
  std::size_t size = std::min(bytes.size(), longest_place);
  while (size != 0 && size < bytes.size() && continues_letter(bytes[size])) {
    --size;
  }
  return {span.begin, span.begin + static_cast<std::uint32_t>(size)};
}

// Returns the section and line of a finding: "[2000] DefaultValue=5".
std::string place_in_eds(const eds::Document& document, Span span) {
  const Source& source = document.source();
  const std::uint32_t line = source.position(span.begin).line;
  const std::vector<eds::Section>& sections = document.sections();
  const auto behind =
      std::upper_bound(sections.begin(), sections.end(), line,
                       [](std::uint32_t number, const eds::Section& section) { return number < section.line; });
  const std::string section = behind == sections.begin() ? "" : document.text(std::prev(behind)->name);
  return "[" + section + "] " + document.text(shortened(source, source.line(line)));
}

// Returns the tag that contains the place, or the one before it.
std::string place_in_xml(const xdd::Document& document, Span span) {
  const Source& source = document.source();
  const std::size_t begin = source.bytes().rfind('<', span.begin);
  const std::size_t from = begin == std::string_view::npos ? 0 : begin;
  const std::size_t end = std::min(source.bytes().find('>', from), source.bytes().size());
  const Span tag{static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(end)};
  return to_utf8(source.slice(shortened(source, tag)), document.encoding());
}

std::string place_of(const Input& input, Span span) {
  if (span == Span{}) {
    return {};  // the finding concerns the whole file
  }
  if (input.eds != nullptr) {
    return place_in_eds(*input.eds, span);
  }
  const Source& source = input.source();
  return input.xdd != nullptr ? place_in_xml(*input.xdd, span) : std::string(source.slice(shortened(source, span)));
}

// Replaces each sequence of white space by one blank, so that changed indentation does not matter.
std::string with_single_blanks(std::string_view text) {
  std::string single;
  for (const char c : trimmed(text)) {
    const char plain = is_blank(c) || c == '\n' ? ' ' : c;
    if (plain != ' ' || (!single.empty() && single.back() != ' ')) {
      single += plain;
    }
  }
  return single;
}

// Returns the text of a member; empty if there is none or it is no string.
std::string text_in(const json::Node& entry, std::string_view name) {
  const json::Node* const member = entry.find(name);
  return member != nullptr && member->kind == json::Kind::string ? member->text : "";
}

}  // namespace

Baseline::Key Baseline::key_of(const Input& input, const Finding& finding) {
  return {input.source().name(), std::string(finding.rule->id), with_single_blanks(place_of(input, finding.span)),
          finding.text};
}

void Baseline::add(const Input& input, const Finding& finding) { ++counts_[key_of(input, finding)]; }

bool Baseline::remove_match(const Input& input, const Finding& finding) {
  if (counts_.empty()) {
    return false;
  }
  const auto place = counts_.find(key_of(input, finding));
  if (place == counts_.end() || place->second == 0) {
    return false;
  }
  --place->second;
  return true;
}

std::size_t Baseline::left(const Input& input, const std::function<bool(const std::string&)>& is_asked) const {
  std::size_t sum = 0;
  for (const auto& [key, count] : counts_) {
    if (std::get<0>(key) == input.source().name() && is_asked(std::get<1>(key))) {
      sum += count;
    }
  }
  return sum;
}

Json Baseline::to_json() const {
  Json files = Json::object();
  for (const auto& [key, count] : counts_) {
    const auto& [file, rule, place, text] = key;
    files[file].push_back({{"rule", rule}, {"place", place}, {"text", text}, {"count", count}});
  }
  return {{"schema", schema}, {"files", std::move(files)}};
}

bool Baseline::read_file_entries(const std::string& file, const json::Node& entries) {
  return entries.kind == json::Kind::array &&
         std::all_of(entries.children.begin(), entries.children.end(), [&](const json::Node& entry) {
           const Key key{file, text_in(entry, "rule"), text_in(entry, "place"), text_in(entry, "text")};
           const json::Node* const count = entry.find("count");
           if (std::get<1>(key).empty() || count == nullptr || count->kind != json::Kind::integer ||
               count->integer.is_negative) {
             return false;
           }
           counts_[key] += count->integer.magnitude;
           return true;
         });
}

std::optional<Baseline> Baseline::read(const std::string& path, std::string& why) {
  std::optional<Source> source = read_file(path, why);
  if (!source) {
    return std::nullopt;
  }
  const json::Document document(std::move(*source));
  const json::Node* const files = document.root().find("files");
  why = path + ": no baseline of codict check";
  if (!document.fault().empty() || text_in(document.root(), "schema") != schema || files == nullptr ||
      files->kind != json::Kind::object) {
    return std::nullopt;
  }
  Baseline baseline;
  for (const json::Node& file : files->children) {
    if (!baseline.read_file_entries(file.name, file)) {
      return std::nullopt;
    }
  }
  return baseline;
}

}  // namespace lexican::codict::cli
