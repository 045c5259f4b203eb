// SPDX-License-Identifier: Apache-2.0
#include "catalogue/pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "catalogue/rules.hpp"

namespace lexican::codict::catalogue {

namespace {

constexpr std::string_view introduction =
    R"(# Rules of codict

This page explains every finding of `codict check`, `codict gen` and `codict network` to those who write device
descriptions or plan networks: the fault, its consequences, the remedy, and an example.

`codict explain RULE` prints the section of a rule. Rule ids never change. To disable a rule for a key, a section
or a file, see [known findings](codict.md#findings-that-are-known).

Examples show only the relevant part of a description. The tests add it to a device without faults; examples marked
`whole` are complete files, and so are plans of networks, whose descriptions are in
`tools/codict/tests/fixtures/network`. The wrong example breaks its rule, the right one does not.

`codict explain --all` writes severities, faults and tables from `rules.cpp` next to the checks. All other text of the
sections is written in this page.
)";

struct Chapter {
  std::string_view prefix;  // of the rules' ids; empty: all rules without a chapter of their own
  std::string_view title;
};

constexpr std::array<Chapter, 7> chapters = {{{"eds-", "Form of an EDS or DCF"},
                                              {"", "Objects, values and services, in any format"},
                                              {"xdd-", "Form of an XDD, XDC or XPD"},
                                              {"json-", "Form of JSON"},
                                              {"gen-", "Generated dictionaries"},
                                              {"net-", "Networks"},
                                              {"suppression-", "Comments that suppress rules"}}};

bool begins_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

const Chapter& chapter_of(const Rule& rule) {
  const auto* const own = std::find_if(chapters.begin(), chapters.end(), [&rule](const Chapter& chapter) {
    return !chapter.prefix.empty() && begins_with(rule.id, chapter.prefix);
  });
  return own != chapters.end() ? *own : chapters[1];
}

// Returns the text behind the title of a section, without severity and fault.
std::string_view text_of(std::string_view section) {
  section.remove_prefix(std::min(section.size(), section.find('\n') + 2));
  for (const std::string_view severity : {"error: ", "warning: ", "note: "}) {
    if (begins_with(section, severity)) {
      section.remove_prefix(std::min(section.size(), section.find('\n') + 2));
      break;
    }
  }
  return section;
}

std::string_view page_of(const Rule& rule) {
  const auto place =
      std::find_if(all_pages().begin(), all_pages().end(), [&rule](const Page& page) { return page.id == rule.id; });
  return place != all_pages().end() ? place->text : "";
}

std::string table_of(const Chapter& chapter) {
  std::string text = "| Rule | Severity | Fault |\n|---|---|---|\n";
  for (const Rule* rule : all_rules()) {
    if (&chapter_of(*rule) == &chapter) {
      text += fmt::format("| [{0}](#{0}) | {1} | {2} |\n", rule->id, name_of(rule->severity), rule->about);
    }
  }
  return text;
}

}  // namespace

const std::vector<Page>& all_pages() {
  static const std::vector<Page> all = [] {
    std::vector<Page> pages;
    for (std::size_t n = 1; n < parts_of_page().size(); ++n) {
      const std::string_view part = parts_of_page()[n];
      const std::string_view section = part.substr(0, part.find("\n## "));  // a chapter may follow
      pages.push_back({section.substr(0, section.find('\n')), text_of(section)});
    }
    return pages;
  }();
  return all;
}

std::string section_of(const Rule& rule) {
  return fmt::format("### {}\n\n{}: {}\n\n{}", rule.id, name_of(rule.severity), rule.about, page_of(rule));
}

std::string reference() {
  std::string text(introduction);
  for (const Chapter& chapter : chapters) {
    text += fmt::format("\n## {}\n\n{}", chapter.title, table_of(chapter));
    for (const Rule* rule : all_rules()) {
      if (&chapter_of(*rule) == &chapter) {
        text += "\n" + section_of(*rule);
      }
    }
  }
  return text;
}

std::string link_to(const Rule& rule) { return fmt::format("tools/codict/docs/rules.md#{}", rule.id); }

}  // namespace lexican::codict::catalogue
