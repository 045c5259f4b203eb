// SPDX-License-Identifier: Apache-2.0
#include "text/finding.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "text/number.hpp"

namespace lexican::codict {

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: break;
  }
  return "error";
}

namespace {

constexpr std::string_view no_break_space = "\xC2\xA0";  // UTF-8

// Writes the code of no-break spaces, which look like blanks, and adds the remedy.
void name_no_break_spaces(std::string& text, std::string& hint) {
  std::size_t at = text.find(no_break_space);
  if (at == std::string::npos) {
    return;
  }
  for (; at != std::string::npos; at = text.find(no_break_space, at)) {
    text.replace(at, no_break_space.size(), "<U+00A0>");
  }
  hint = "remove the no-break space (U+00A0)" + (hint.empty() ? "" : ", or " + hint);
}

}  // namespace

void Findings::add(const Rule& rule, Span span, std::string text, std::string hint) {
  std::size_t& number = rule.severity == Severity::error ? errors_ : others_;
  if (number == most) {
    ++dropped_[&rule];
    return;
  }
  ++number;
  name_no_break_spaces(text, hint);
  all_.push_back({&rule, span, std::move(text), std::move(hint), rule.severity, {}});
}

std::size_t Findings::count(const Rule& rule) const {
  const auto dropped = dropped_.find(&rule);
  const auto kept =
      std::count_if(all_.begin(), all_.end(), [&rule](const Finding& finding) { return finding.rule == &rule; });
  return static_cast<std::size_t>(kept) + (dropped != dropped_.end() ? dropped->second : 0);
}

std::size_t Findings::count(Severity severity) const {
  auto number = static_cast<std::size_t>(std::count_if(
      all_.begin(), all_.end(), [severity](const Finding& finding) { return finding.rule->severity == severity; }));
  for (const auto& [rule, dropped] : dropped_) {
    number += rule->severity == severity ? dropped : 0;
  }
  return number;
}

void Findings::sort() {
  std::stable_sort(all_.begin(), all_.end(), [](const Finding& a, const Finding& b) {
    return std::tie(a.span.begin, a.span.end) < std::tie(b.span.begin, b.span.end);
  });
}

namespace {

bool is_of_word(char c) { return is_digit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

// Returns the text with # for each number (word with a digit) and each quoted name.
std::string kind_of(const Finding& finding) {
  const std::string& text = finding.text;
  if (finding.span == Span{}) {
    return text;
  }
  std::string kind;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t quote = text[at] == '\'' ? text.find('\'', at + 1) : std::string::npos;
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(at);
    const auto word_end = std::find_if_not(begin, text.end(), is_of_word);
    const std::size_t end =
        quote != std::string::npos ? quote + 1 : std::max(at + 1, static_cast<std::size_t>(word_end - text.begin()));
    const bool is_value = quote != std::string::npos || std::any_of(begin, word_end, is_digit);
    kind += is_value ? "#" : text.substr(at, end - at);
    at = end;
  }
  return kind;
}

}  // namespace

std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::size_t size = std::min(text.size(), longest);
  while (size != 0 && size != text.size() && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80) {
    --size;  // inside of a UTF-8 character
  }
  return std::string(text.substr(0, size)) + (size != text.size() ? "..." : "");
}

std::string in_quotes(std::string_view text) { return "'" + shortened(text) + "'"; }

std::string message_of(const Finding& finding) {
  return finding.subject.empty() ? finding.text : finding.subject + ": " + finding.text;
}

std::vector<FoldedFindings> fold(const std::vector<Finding>& findings) {
  std::vector<FoldedFindings> folded;
  std::map<std::pair<const Rule*, std::string>, std::size_t> places;
  for (const Finding& finding : findings) {
    const auto [place, is_new] = places.try_emplace({finding.rule, kind_of(finding)}, folded.size());
    if (is_new) {
      folded.push_back({&finding, 0, place->first.second});
    } else {
      ++folded[place->second].more;
    }
  }
  return folded;
}

}  // namespace lexican::codict
