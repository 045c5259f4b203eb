// SPDX-License-Identifier: Apache-2.0
#include "report/catalogue.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "check/check.hpp"
#include "check/network.hpp"
#include "eds/rules.hpp"
#include "gen/rules.hpp"
#include "json/read.hpp"
#include "model/parse.hpp"
#include "report/suppress.hpp"
#include "xdd/rules.hpp"

namespace lexican::codict::report {

namespace {

// Letters that have to be changed, added or left out. [Levenshtein]
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t m = 0; m < a.size(); ++m) {
    std::size_t diagonal = row[0];
    row[0] = m + 1;
    for (std::size_t n = 0; n < b.size(); ++n) {
      const std::size_t replaced = diagonal + (a[m] == b[n] ? 0 : 1);
      diagonal = row[n + 1];
      row[n + 1] = std::min({replaced, row[n] + 1, row[n + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

const std::vector<const Rule*>& all_rules() {
  static const std::vector<const Rule*> all = [] {
    std::vector<const Rule*> joined;
    for (const auto* rules : {&eds::all_rules(), &value_rules(), &check::all_rules(), &check::network_rules(),
                              &xdd::all_rules(), &json::all_rules(), &gen::all_rules(), &suppression_rules()}) {
      joined.insert(joined.end(), rules->begin(), rules->end());
    }
    return joined;
  }();
  return all;
}

const Rule* find_rule(std::string_view id) {
  const auto place =
      std::find_if(all_rules().begin(), all_rules().end(), [id](const Rule* rule) { return rule->id == id; });
  return place != all_rules().end() ? *place : nullptr;
}

std::vector<std::string_view> similar_rules(std::string_view id) {
  constexpr std::size_t longest = 64;  // no id is longer: what is, is like none
  std::vector<std::string_view> similar;
  if (id.size() > longest) {
    return similar;
  }
  std::size_t least = 2 + id.size() / 8;
  for (const Rule* rule : all_rules()) {
    const std::size_t far = distance(id, rule->id);
    if (far < least) {
      least = far;
      similar.clear();
    }
    if (far <= least) {
      similar.push_back(rule->id);
    }
  }
  return similar;
}

bool is_of_generator(const Rule& rule) {
  return std::find(gen::all_rules().begin(), gen::all_rules().end(), &rule) != gen::all_rules().end();
}

}  // namespace lexican::codict::report
