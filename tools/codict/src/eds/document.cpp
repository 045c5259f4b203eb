// SPDX-License-Identifier: Apache-2.0
#include "eds/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "eds/rules.hpp"
#include "text/number.hpp"

namespace lexican::codict::eds {

namespace {

constexpr std::uint32_t standard_line = 255;

// Returns a span of the source without leading and trailing blanks.
Span trimmed_span(const Source& source, Span span) {
  while (!span.is_empty() && is_blank(source.bytes()[span.begin])) {
    ++span.begin;
  }
  while (!span.is_empty() && is_blank(source.bytes()[span.end - 1])) {
    --span.end;
  }
  return span;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t') || byte == 0x7F;
}

bool is_comment(std::string_view line) {
  return line.front() == ';' || line.front() == '#' || line.substr(0, 2) == "//";
}

// Returns whether a comment holds a key of a tool: ";Key=" without a blank.
bool is_hidden_key(std::string_view line) {
  const std::size_t end = line.find_first_of("= \t");
  return end != std::string_view::npos && end > 1 && line[end] == '=';
}

std::string_view line_end_of(const Source& source, std::uint32_t line) {
  const std::uint32_t begin = source.line(line).end;
  const std::uint32_t next = line < source.lines() ? source.line(line + 1).begin : source.size();
  return source.slice({begin, next});
}

void report_encoding(const Source& source, Encoding encoding, Findings& findings) {
  const std::string_view bytes = source.bytes();
  const auto mark = static_cast<std::uint32_t>(mark_size(bytes));
  if (mark != 0) {
    findings.add(rules::encoding_mark, {0, mark}, "UTF-8 byte order mark, ignored", "save the file without it");
  }
  if (is_ascii(bytes.substr(mark))) {
    return;
  }
  const auto first = std::find_if(bytes.begin() + mark, bytes.end(), [](char c) { return !is_ascii({&c, 1}); });
  const auto last = std::find_if(first, bytes.end(), [](char c) { return is_ascii({&c, 1}); });
  const Span letters{static_cast<std::uint32_t>(first - bytes.begin()),
                     static_cast<std::uint32_t>(last - bytes.begin())};
  if (encoding == Encoding::utf8) {
    findings.add(rules::encoding_utf8, letters, "characters outside ASCII, read as UTF-8",
                 "use ASCII if old tools read the file");
  } else {
    findings.add(rules::encoding_guess, letters,
                 "characters in an unknown code page, read as " + std::string(name_of(encoding)),
                 "save the file as UTF-8");
  }
}

void report_line_ends(const Source& source, Findings& findings) {
  const std::string_view first = line_end_of(source, 1);
  for (std::uint32_t line = 2; line < source.lines(); ++line) {
    if (line_end_of(source, line) != first) {
      const std::uint32_t end = source.line(line).end;
      findings.add(rules::syntax_line_end, {end, end}, "mixed line ends: LF and CR LF",
                   "save the file with one kind of line end");
      return;
    }
  }
}

std::size_t pass_blanks(std::string_view text, std::size_t at) {
  while (at != text.size() && is_blank(text[at])) {
    ++at;
  }
  return at;
}

// Returns the indexes of sections or keys, sorted by name, and by position for equal names.
template <typename Named>
std::vector<std::uint32_t> sorted(const Source& source, const std::vector<Named>& all) {
  std::vector<std::uint32_t> places(all.size());
  std::iota(places.begin(), places.end(), 0U);
  std::sort(places.begin(), places.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int difference = compare_names(source.slice(all[a].name), source.slice(all[b].name));
    return difference != 0 ? difference < 0 : a < b;
  });
  return places;
}

// Marks and reports each section or key whose name an earlier one has. text: returns the message about a name.
template <typename Named, typename Text>
void mark_duplicates(const Source& source, const std::vector<std::uint32_t>& by_name, std::vector<Named>& all,
                     const Rule& rule, Text text, Findings& findings) {
  for (std::size_t n = 1; n < by_name.size(); ++n) {
    Named& one = all[by_name[n]];
    if (compare_names(source.slice(all[by_name[n - 1]].name), source.slice(one.name)) == 0) {
      one.is_duplicate = true;
      findings.add(rule, one.name, text(one.name), "remove one of them, or correct its name");
    }
  }
}

// Returns the first section or key that has a name; null if there is none.
template <typename Named>
const Named* find_named(const Source& source, const std::vector<std::uint32_t>& by_name, const std::vector<Named>& all,
                        std::string_view name) {
  const auto place = std::lower_bound(
      by_name.begin(), by_name.end(), name,
      [&](std::uint32_t n, std::string_view wanted) { return compare_names(source.slice(all[n].name), wanted) < 0; });
  const bool is_found = place != by_name.end() && compare_names(source.slice(all[*place].name), name) == 0;
  return is_found ? &all[*place] : nullptr;
}

}  // namespace

int compare_names(std::string_view a, std::string_view b) {
  std::size_t n = 0;
  std::size_t m = 0;
  for (;;) {
    n = pass_blanks(a, n);
    m = pass_blanks(b, m);
    if (n == a.size() || m == b.size()) {
      return static_cast<int>(n != a.size()) - static_cast<int>(m != b.size());
    }
    const int difference = static_cast<unsigned char>(to_lower(a[n])) - static_cast<unsigned char>(to_lower(b[m]));
    if (difference != 0) {
      return difference;
    }
    ++n;
    ++m;
  }
}

Document::Document(Source source, Findings& findings)
    : source_(std::move(source)), encoding_(guess_encoding(source_.bytes())) {
  report_encoding(source_, encoding_, findings);
  report_line_ends(source_, findings);
  for (std::uint32_t line = 1; line <= source_.lines(); ++line) {
    read_line(line, findings);
  }
  if (!sections_.empty()) {
    sections_.back().end = source_.lines() + 1;
  }
  sort_names(findings);
}

void Document::read_line(std::uint32_t number, Findings& findings) {
  const Span all = source_.line(number);
  if (all.size() > standard_line) {
    findings.add(rules::syntax_length, {all.begin + standard_line, all.end},
                 fmt::format("line has {} characters, more than {}", all.size(), standard_line), "shorten the value");
  }
  const std::string_view bytes = raw(all);
  if (const auto found = std::find_if(bytes.begin(), bytes.end(), is_control); found != bytes.end()) {
    const std::uint32_t at = all.begin + static_cast<std::uint32_t>(found - bytes.begin());
    findings.add(rules::syntax_control, {at, at + 1},
                 fmt::format("control character {:02X}h", static_cast<unsigned char>(*found)), "remove it");
  }
  const Span line = content(number);
  if (line.is_empty()) {
    return;
  }
  const std::string_view text = raw(line);
  const bool is_indented = line.begin != all.begin && number != 1;
  if (text.front() == '#' || text.substr(0, 2) == "//") {
    findings.add(rules::syntax_comment, line, "comment does not begin with a semicolon", "begin it with ;");
  } else if (is_indented) {
    findings.add(rules::syntax_indent, {all.begin, line.begin}, "leading blanks in the line", "remove them");
  }
  if (text.front() == '[') {
    read_section(number, line, findings);
  } else if (!is_comment(text)) {
    read_key(number, line, findings);
  }
}

void Document::read_section(std::uint32_t number, Span line, Findings& findings) {
  const std::string_view content = raw(line);
  const std::size_t close = content.find(']');
  Span name{line.begin + 1,
            close == std::string_view::npos ? line.end : line.begin + static_cast<std::uint32_t>(close)};
  if (close == std::string_view::npos) {
    findings.add(rules::syntax_section, line, fmt::format("no ] after section name {}", in_quotes(text(name))),
                 "write [name] on a line of its own");
  } else if (close + 1 != content.size()) {
    findings.add(rules::syntax_section_tail, trimmed_span(source_, {name.end + 1, line.end}),
                 "text after the section header is ignored", "move it to a line that begins with ;");
  }
  name = trimmed_span(source_, name);
  if (name.is_empty()) {
    findings.add(rules::syntax_section, line, "section header without a name", "write the name between the brackets");
  }
  if (!sections_.empty()) {
    sections_.back().end = number;
  }
  sections_.push_back({name, number, number + 1, false, {}, {}});
}

void Document::read_key(std::uint32_t number, Span line, Findings& findings) {
  const std::size_t equals = raw(line).find('=');
  if (equals == std::string_view::npos) {
    findings.add(rules::syntax_line, line,
                 fmt::format("{} is not a section, key or comment; ignored", in_quotes(text(line))),
                 "join it with the line above, or begin it with ;");
    return;
  }
  const std::uint32_t at = line.begin + static_cast<std::uint32_t>(equals);
  const Span name = trimmed_span(source_, {line.begin, at});
  const Span value = at + 1 == line.end ? Span{line.end, line.end} : trimmed_span(source_, {at + 1, line.end});
  if (name.is_empty()) {
    findings.add(rules::syntax_line, line, "value without a key; ignored", "write key=value");
    return;
  }
  if (raw(name).find_first_of(" \t\r") != std::string_view::npos) {
    findings.add(rules::syntax_key, name, fmt::format("blanks in key {} are ignored", in_quotes(text(name))),
                 "write it without blanks");
  }
  if (text(name).find("\xC2\xA0") != std::string::npos) {
    findings.add(rules::syntax_key, name,
                 fmt::format("no-break space in key {}, which is unknown", in_quotes(text(name))));
  }
  if (sections_.empty()) {
    findings.add(rules::syntax_outside, name,
                 fmt::format("key {} before the first section is not used", in_quotes(text(name))),
                 "move it into its section");
    keys_outside_.push_back({name, value, number, false});
  } else {
    sections_.back().keys.push_back({name, value, number, false});
  }
}

void Document::sort_names(Findings& findings) {
  by_name_ = sorted(source_, sections_);
  mark_duplicates(
      source_, by_name_, sections_, rules::duplicate_section,
      [this](Span name) { return "duplicate section [" + shortened(text(name)) + "]; the first is used"; }, findings);
  for (Section& section : sections_) {
    section.by_name = sorted(source_, section.keys);
    mark_duplicates(
        source_, section.by_name, section.keys, rules::duplicate_key,
        [this](Span name) { return "duplicate key " + in_quotes(text(name)) + "; the first is used"; }, findings);
  }
}

const Section* Document::find(std::string_view section) const {
  return find_named(source_, by_name_, sections_, section);
}

const Key* Document::find(const Section& section, std::string_view key) const {
  return find_named(source_, section.by_name, section.keys, key);
}

Span Document::content(std::uint32_t line) const {
  Span span = source_.line(line);
  span.begin += line == 1 ? static_cast<std::uint32_t>(mark_size(raw(span))) : 0;
  return trimmed_span(source_, span);
}

std::vector<Span> Document::comments(const Section& section) const {
  std::vector<Span> found;
  for (std::uint32_t number = section.line + 1; number < section.end; ++number) {
    const Span line = content(number);
    if (raw(line).substr(0, 1) == ";") {
      found.push_back({line.begin + 1, line.end});
    }
  }
  return found;
}

std::uint32_t Document::last_line(const Section& section) const {
  std::uint32_t last = section.line;
  for (std::uint32_t number = section.line + 1; number < section.end; ++number) {
    const std::string_view line = raw(content(number));
    if (!line.empty() && (!is_comment(line) || is_hidden_key(line))) {
      last = number;
    }
  }
  return last;
}

bool Document::to_source(std::string_view text, std::string& bytes) const {
  const bool has_line_end = text.find_first_of(std::string_view("\r\n\0", 3)) != std::string_view::npos;
  return !has_line_end && from_utf8(text, encoding_ == Encoding::ascii ? Encoding::utf8 : encoding_, bytes);
}

std::string_view Document::line_end() const { return source_.lines() > 1 ? line_end_of(source_, 1) : "\n"; }

bool Document::set_value(const Key& key, std::string_view text, Edits& edits) const {
  std::string bytes;
  if (!to_source(text, bytes)) {
    return false;
  }
  edits.replace(key.value, std::move(bytes));
  return true;
}

bool Document::add_key(const Section& section, std::string_view name, std::string_view text, Edits& edits) const {
  std::string bytes;
  if (!to_source(text, bytes)) {
    return false;
  }
  const std::uint32_t neighbour = section.keys.empty() ? section.line : section.keys.back().line;
  std::string_view end = line_end_of(source_, neighbour);
  if (end.find('\n') == std::string_view::npos) {  // the line is the last one of the file, without a line end
    end = line_end();
  }
  std::string between = "=";
  if (!section.keys.empty() && !section.keys.back().value.is_empty()) {
    const Key& last = section.keys.back();
    between = raw({last.name.end, last.value.begin});
  }
  // Inserted before the line end of the preceding line, so that this line end now ends the new line.
  edits.insert(source_.line(neighbour).end, std::string(end) + std::string(name) + between + bytes);
  return true;
}

}  // namespace lexican::codict::eds
