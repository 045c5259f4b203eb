// SPDX-License-Identifier: Apache-2.0
// The rules are known to their users.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "check/check.hpp"
#include "check/network.hpp"
#include "eds/rules.hpp"
#include "gen/rules.hpp"
#include "model/parse.hpp"
#include "xdd/rules.hpp"

using namespace lexican::codict;

TEST_CASE("each rule has an id of its own, and its line in docs/codict.md") {
  std::ifstream file(LEXICAN_SOURCE_DIR "/docs/codict.md");
  const std::string manual{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::set<std::string_view> ids;
  for (const auto* rules : {&eds::all_rules(), &xdd::all_rules(), &value_rules(), &check::all_rules(),
                            &check::network_rules(), &gen::all_rules()}) {
    for (const Rule* rule : *rules) {
      CHECK_MESSAGE(ids.insert(rule->id).second, rule->id);
      const std::string line = fmt::format("\n| `{}` | {} | {} |\n", rule->id, name_of(rule->severity), rule->about);
      CHECK_MESSAGE(manual.find(line) != std::string::npos, line);
    }
  }
}
