// SPDX-License-Identifier: Apache-2.0
#include "cli/services.hpp"

#include <fmt/format.h>

#include <utility>

#include "catalogue/pages.hpp"
#include "cli/letters.hpp"

namespace lexican::codict::cli {

namespace {

// Escapes characters of a workflow command as % and two digits; colons and commas are escaped in properties only.
std::string escaped(std::string_view text, std::string_view signs) {
  std::string result;
  for (const char c : text) {
    result += signs.find(c) == std::string_view::npos
                  ? std::string(1, c)
                  : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return result;
}

std::string escaped_message(std::string_view text) { return escaped(text, "%\r\n"); }
std::string escaped_property(std::string_view text) { return escaped(text, "%\r\n:,"); }

std::string_view github_word(Severity severity) { return severity == Severity::note ? "notice" : name_of(severity); }

// Returns a path as relative reference: all characters but the unreserved ones and "/" are percent-encoded. [RFC 3986]
std::string to_uri(std::string_view path) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri;
  for (const char c : path) {
    uri += plain.find(c) != std::string_view::npos
               ? std::string(1, c)
               : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return path.substr(0, 1) == "/" ? "file://" + uri : uri;
}

std::string message_with_hint(const Finding& finding) {
  return message_of(finding) + (finding.hint.empty() ? "" : "\nfix: " + finding.hint);
}

// Returns the column in characters, not bytes, as SARIF counts them.
std::size_t column_of(const Input& input, std::uint32_t offset) {
  const Source& source = input.source();
  const Position position = source.position(offset);
  const std::string before = to_utf8(source.slice({offset - (position.column - 1), offset}), input.encoding());
  return 1 + letters(before);
}

Json region_of(const Input& input, Span span) {
  return {{"startLine", input.source().position(span.begin).line},
          {"startColumn", column_of(input, span.begin)},
          {"endLine", input.source().position(span.end).line},
          {"endColumn", column_of(input, span.end)}};
}

}  // namespace

std::string to_github(const Source& source, const std::vector<FoldedFindings>& findings) {
  std::string text;
  for (const FoldedFindings& folded : findings) {
    const Finding& finding = *folded.first;
    const Position position = source.position(finding.span.begin);
    const std::string more = folded.more == 0 ? "" : fmt::format("\nand {} more", folded.more);
    text += fmt::format("::{} file={},line={},col={},title={}::{}\n", github_word(finding.severity),
                        escaped_property(source.name()), position.line, position.column,
                        escaped_property(finding.rule->id), escaped_message(message_with_hint(finding) + more));
  }
  return text;
}

std::size_t Sarif::number_of(const Rule& rule) {
  const auto [place, is_new] = numbers_.try_emplace(&rule, numbers_.size());
  if (is_new) {
    rules_.push_back({{"id", rule.id},
                      {"shortDescription", {{"text", rule.about}}},
                      {"help",
                       {{"text", fmt::format("codict explain {}, or {}", rule.id, catalogue::link_to(rule))},
                        {"markdown", catalogue::section_of(rule)}}},
                      {"defaultConfiguration", {{"level", name_of(rule.severity)}}}});
  }
  return place->second;
}

void Sarif::add(const Input& input, const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    const Json location{{"artifactLocation", {{"uri", to_uri(input.source().name())}}},
                        {"region", region_of(input, finding.span)}};
    results_.push_back({{"ruleId", finding.rule->id},
                        {"ruleIndex", number_of(*finding.rule)},
                        {"level", name_of(finding.severity)},
                        {"message", {{"text", message_with_hint(finding)}}},
                        {"locations", Json::array({Json{{"physicalLocation", location}}})}});
  }
}

Json Sarif::document(bool is_complete) const {
  const Json driver{{"name", "codict"}, {"semanticVersion", LEXICAN_VERSION}, {"rules", rules_}};
  const Json run{{"tool", {{"driver", driver}}},
                 {"columnKind", "unicodeCodePoints"},
                 {"invocations", Json::array({Json{{"executionSuccessful", is_complete}}})},
                 {"results", results_}};
  return {
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}, {"runs", Json::array({run})}};
}

}  // namespace lexican::codict::cli
