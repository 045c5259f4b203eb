// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "doc/contents.hpp"

namespace lexican::codict::doc {

namespace {

// Escapes characters with a meaning in Markdown or embedded HTML. Line ends become blanks, as they would end a table
// row.
std::string escaped(std::string_view text) {
  constexpr std::string_view special = "\\`*_{}[]<>#|&~!";
  std::string result;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      result += ' ';
      continue;
    }
    if (special.find(c) != std::string_view::npos) {
      result += '\\';
    }
    result += c;
  }
  return result;
}

class MarkdownPage {
 public:
  void heading(unsigned level, std::string_view title, std::string_view anchor) {
    gap();
    fmt::format_to(out(), "{} {}{}\n", std::string(level, '#'),
                   anchor.empty() ? "" : fmt::format("<a id=\"{}\"></a>", anchor), escaped(title));
  }

  void paragraph(std::string_view text) {
    if (!text.empty()) {
      gap();
      fmt::format_to(out(), "{}\n", escaped(text));
    }
  }

  // Begins a table. Callers of row() escape the cells.
  void table(const std::vector<std::string_view>& header) {
    gap();
    fmt::format_to(out(), "| {} |\n|", fmt::join(header, " | "));
    for (std::size_t column = 0; column < header.size(); ++column) {
      text_ += "---|";
    }
    text_ += '\n';
  }
  void row(const std::vector<std::string>& cells) { fmt::format_to(out(), "| {} |\n", fmt::join(cells, " | ")); }

  std::string take_text() { return std::move(text_); }

 private:
  std::back_insert_iterator<std::string> out() { return std::back_inserter(text_); }
  void gap() { text_ += text_.empty() ? "" : "\n"; }

  std::string text_;
};

void write_facts(std::string_view title, const std::vector<Fact>& facts, MarkdownPage& page) {
  if (facts.empty()) {
    return;
  }
  page.heading(2, title, "");
  page.table({"", ""});
  for (const Fact& fact : facts) {
    page.row({std::string(fact.name), escaped(fact.value)});
  }
}

void write_cob_ids(const std::vector<CobIdRow>& rows, const Options& options, MarkdownPage& page) {
  page.heading(2, fmt::format("COB-IDs of node {}", options.node_id), "cob-ids");
  page.table({"COB-ID", "service", "from"});
  for (const CobIdRow& row : rows) {
    page.row({row.identifier, escaped(row.service), row.source});
  }
}

void write_pdo(const PdoItem& pdo, MarkdownPage& page) {
  page.heading(3, pdo.title, pdo.anchor);
  page.paragraph(fmt::format("COB-ID {}; {}; {} bits.", pdo.cob_id.empty() ? "?" : pdo.cob_id,
                             pdo.transmission.empty() ? "?" : pdo.transmission, pdo.bits));
  if (pdo.parts.empty()) {
    return;
  }
  page.table({"bits", "object", "name"});
  for (const PdoPart& part : pdo.parts) {
    const std::string number = part.anchor.empty() ? part.number : fmt::format("[{}](#{})", part.number, part.anchor);
    page.row({fmt::format("{}…{}", part.first_bit, part.first_bit + part.bits - 1), number, escaped(part.name)});
  }
}

std::string remarks_of(const Item& item) {
  std::vector<std::string> parts;
  if (!item.unit.empty()) {
    parts.push_back("Unit: " + escaped(item.unit) + ".");
  }
  if (!item.range.empty()) {
    parts.push_back("Range: " + escaped(item.range) + ".");
  }
  for (const Fact& allowed : item.allowed) {
    parts.push_back(fmt::format("{}: {}.", escaped(allowed.name), escaped(allowed.value)));
  }
  if (!item.group.empty()) {
    parts.push_back("Stored in " + escaped(item.group) + ".");
  }
  for (const std::string& words : item.words) {
    parts.push_back(escaped(words));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

void write_item(const Item& item, MarkdownPage& page) {
  const std::string value = item.value.empty() ? item.default_value : item.default_value + " → " + item.value;
  page.row({fmt::format("<a id=\"{}\"></a>{}", item.anchor, item.number), escaped(item.name), escaped(item.type),
            item.access, item.mapping, escaped(value), remarks_of(item)});
}

void write_object(const ObjectItem& object, unsigned level, MarkdownPage& page) {
  page.heading(level, object.object.number + " " + object.object.name, object.has_subs ? object.object.anchor : "");
  if (object.has_subs) {
    page.paragraph(object.object.type);
    page.paragraph(remarks_of(object.object));
  }
  page.table({"object", "name", "type", "access", "PDO", "default", "remarks"});
  if (!object.has_subs) {
    write_item(object.object, page);
  }
  for (const Item& sub : object.subs) {
    write_item(sub, page);
  }
}

constexpr unsigned deepest_heading = 6;

unsigned heading_of(unsigned level) { return level < deepest_heading ? level : deepest_heading; }

}  // namespace

std::string markdown(const Device& device, const Options& options) {
  const Contents contents = contents_of(device, options);
  MarkdownPage page;
  page.heading(1, contents.title, "");
  write_facts("Device", contents.identity, page);
  write_facts("Features", contents.features, page);
  write_cob_ids(contents.cob_ids, options, page);
  if (!contents.pdos.empty()) {
    page.heading(2, "PDOs", "pdos");
  }
  for (const PdoItem& pdo : contents.pdos) {
    write_pdo(pdo, page);
  }
  for (const Chapter& chapter : contents.chapters) {
    page.heading(heading_of(2 + chapter.level), chapter.title, chapter.anchor);
    page.paragraph(chapter.words);
    for (const ObjectItem& object : chapter.objects) {
      write_object(object, heading_of(3 + chapter.level), page);
    }
  }
  return page.take_text();
}

}  // namespace lexican::codict::doc
