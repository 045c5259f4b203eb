// SPDX-License-Identifier: Apache-2.0
// The rules are known to their users.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "catalogue/rules.hpp"

using namespace lexican::codict;

TEST_CASE("each rule has an id of its own, and its line in docs/codict.md") {
  std::ifstream file(LEXICAN_SOURCE_DIR "/tools/codict/docs/codict.md");
  const std::string manual{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::set<std::string_view> ids;
  for (const Rule* rule : catalogue::all_rules()) {
    CHECK_MESSAGE(ids.insert(rule->id).second, rule->id);
    const std::string line = fmt::format("\n| `{}` | {} | {} |\n", rule->id, name_of(rule->severity), rule->about);
    CHECK_MESSAGE(manual.find(line) != std::string::npos, line);
  }
}
