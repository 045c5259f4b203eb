// SPDX-License-Identifier: Apache-2.0
#include "cli/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "cli/letters.hpp"

namespace lexican::codict::cli {

namespace {

constexpr std::uint32_t widest = 160;  // largest number of bytes of a line that are shown
constexpr std::uint32_t ahead = 60;    // number of these bytes in front of the place, in longer lines

constexpr std::string_view escape_bold = "\x1B[1m";
constexpr std::string_view escape_plain = "\x1B[0m";

std::string_view colour_of(Severity severity) {
  switch (severity) {
    case Severity::note: return "\x1B[1;36m";
    case Severity::warning: return "\x1B[1;35m";
    case Severity::error: break;
  }
  return "\x1B[1;31m";
}

std::string shown(const Source& source, Encoding encoding, Span span) {
  return visible(to_utf8(source.slice(span), encoding), "\t");
}

// Returns blanks of the same width as the text; tabs are kept.
std::string blanks_for(const std::string& text) {
  std::string blanks;
  for (const char c : text) {
    if (!continues_letter(c)) {
      blanks += c == '\t' ? '\t' : ' ';
    }
  }
  return blanks;
}

std::string excerpt(const Source& source, Encoding encoding, Span span) {
  const Span all = source.line(source.position(span.begin).line);
  Span line = all;
  if (line.size() > widest) {
    line.begin = std::max(line.begin, span.begin - std::min(span.begin, ahead));
    line.end = std::min(line.end, line.begin + widest);
  }
  if (line.is_empty()) {
    return {};
  }
  const std::uint32_t begin = std::clamp(span.begin, line.begin, line.end);
  const std::uint32_t end = std::clamp(span.end, begin, line.end);
  const std::string before = shown(source, encoding, {line.begin, begin});
  const std::string marked = shown(source, encoding, {begin, end});
  const std::string after = shown(source, encoding, {end, line.end});
  const std::string tail(std::max<std::size_t>(letters(marked), 1) - 1, '~');
  return fmt::format("    {}{}{}\n    {}^{}\n", before, marked, after, blanks_for(before), tail);
}

std::string plural(std::size_t number, std::string_view word) {
  return fmt::format("{} {}{}", number, word, number == 1 ? "" : "s");
}

}  // namespace

bool wants_colour() {
  const char* const refusal = std::getenv("NO_COLOR");
  return is_terminal() && (refusal == nullptr || *refusal == '\0');
}

std::string render(const Source& source, Encoding encoding, const std::vector<FoldedFindings>& findings,
                   bool has_colour) {
  std::string text;
  for (const FoldedFindings& folded : findings) {
    const Finding& finding = *folded.first;
    const Position position = source.position(finding.span.begin);
    const Severity severity = finding.severity;
    text += fmt::format("{}{}:{}:{}:{} {}{}:{} {} [{}]\n", has_colour ? escape_bold : "", visible(source.name()),
                        position.line, position.column, has_colour ? escape_plain : "",
                        has_colour ? colour_of(severity) : "", name_of(severity), has_colour ? escape_plain : "",
                        visible(message_of(finding)), finding.rule->id);
    text += excerpt(source, encoding, finding.span);
    if (!finding.hint.empty()) {
      text += fmt::format("    fix: {}\n", visible(finding.hint));
    }
    if (folded.more != 0) {
      text += fmt::format("    and {} more\n", folded.more);
    }
  }
  return text;
}

void show_findings(const Input& input, const Findings& findings, const std::function<bool(const Finding&)>& is_wanted) {
  std::vector<Finding> wanted;
  std::copy_if(findings.all().begin(), findings.all().end(), std::back_inserter(wanted), is_wanted);
  const std::string text = render(input.source(), input.encoding(), fold(wanted), false);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void show_findings(const Input& input, const Findings& findings, Severity least) {
  show_findings(input, findings, [least](const Finding& finding) { return finding.rule->severity >= least; });
}

Json to_json(const Source& source, const std::vector<FoldedFindings>& findings) {
  Json all = Json::array();
  for (const FoldedFindings& folded : findings) {
    const Finding& finding = *folded.first;
    const Position begin = source.position(finding.span.begin);
    const Position end = source.position(finding.span.end);
    Json json;
    json["severity"] = name_of(finding.severity);
    json["rule"] = finding.rule->id;
    json["text"] = message_of(finding);
    if (!finding.hint.empty()) {
      json["fix"] = finding.hint;
    }
    json["line"] = begin.line;
    json["column"] = begin.column;
    json["end_line"] = end.line;
    json["end_column"] = end.column;
    json["count"] = folded.more + 1;
    all.push_back(std::move(json));
  }
  return all;
}

std::string summary(std::size_t errors, std::size_t warnings, std::size_t notes) {
  std::string text;
  const auto append = [&text](std::size_t number, std::string_view word) {
    if (number != 0) {
      text += (text.empty() ? "" : ", ") + plural(number, word);
    }
  };
  append(errors, "error");
  append(warnings, "warning");
  append(notes, "note");
  return text;
}

}  // namespace lexican::codict::cli
