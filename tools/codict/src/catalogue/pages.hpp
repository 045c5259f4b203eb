// SPDX-License-Identifier: Apache-2.0
/// \file pages.hpp
/// Reference text of each rule: what goes wrong, the remedy, a wrong and a right example.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "text/finding.hpp"

namespace lexican::codict::catalogue {

/// Returns docs/rules.md, divided at the titles of its rules: the text before the first rule, then a part for each
/// rule, which begins with the id. Defined in rule_pages.cpp, which the build generates.
const std::vector<std::string_view>& parts_of_page();

/// A section of docs/rules.md.
struct Page {
  std::string_view id;    ///< id of the rule
  std::string_view text;  ///< Markdown without title, severity and fault
};

/// Returns the sections of all rules.
const std::vector<Page>& all_pages();

/// Returns the section of the reference about one rule: title, severity, fault, and its page.
std::string section_of(const Rule& rule);

/// Returns tools/codict/docs/rules.md with the rules' severities and faults, which `codict explain --all` prints.
std::string reference();

/// Returns the path of the reference in the repository, with the rule's anchor.
std::string link_to(const Rule& rule);

}  // namespace lexican::codict::catalogue
