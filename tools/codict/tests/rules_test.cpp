// SPDX-License-Identifier: Apache-2.0
// List of rules, and the reference page that is generated from it.
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <string_view>

#include "catalogue/pages.hpp"
#include "catalogue/rules.hpp"
#include "program.hpp"

using namespace lexican::codict;

namespace {

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace

TEST_CASE("rules: each id is used once") {
  std::set<std::string_view> ids;
  for (const Rule* rule : catalogue::all_rules()) {
    CHECK_MESSAGE(ids.insert(rule->id).second, rule->id);
  }
}

TEST_CASE("rules: docs/rules.md has the severities, faults and tables of the catalogue") {
  const bool is_current = test::bytes_of(LEXICAN_SOURCE_DIR "/tools/codict/docs/rules.md") == catalogue::reference();
  CHECK_MESSAGE(is_current, "build, then run: codict explain --all >tools/codict/docs/rules.md");
}

TEST_CASE("rules: the reference has a section and a table row for each rule") {
  const std::string all = catalogue::reference();
  for (const Rule* rule : catalogue::all_rules()) {
    const std::string id(rule->id);
    CHECK_MESSAGE(contains(all, "\n" + catalogue::section_of(*rule)), id);
    CHECK_MESSAGE(contains(all, "\n| [" + id + "](#" + id + ") | "), id);
  }
}

TEST_CASE("rules: each summary states a fault without a full stop") {
  for (const Rule* rule : catalogue::all_rules()) {
    CHECK_MESSAGE((rule->about.size() <= 90 && rule->about.back() != '.'), rule->id);
  }
}
