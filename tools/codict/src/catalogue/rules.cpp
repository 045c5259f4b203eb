// SPDX-License-Identifier: Apache-2.0
#include "catalogue/rules.hpp"

#include <algorithm>

#include "catalogue/suppress.hpp"
#include "check/check.hpp"
#include "check/network.hpp"
#include "check/profile.hpp"
#include "eds/rules.hpp"
#include "gen/rules.hpp"
#include "json/read.hpp"
#include "model/parse.hpp"
#include "network/rules.hpp"
#include "xdd/rules.hpp"

namespace lexican::codict::catalogue {

namespace {

bool has(const std::vector<const Rule*>& rules, const Rule& rule) {
  return std::find(rules.begin(), rules.end(), &rule) != rules.end();
}

}  // namespace

const std::vector<const Rule*>& all_rules() {
  static const std::vector<const Rule*> all = [] {
    std::vector<const Rule*> joined;
    for (const auto* rules :
         {&eds::all_rules(), &value_rules(), &check::all_rules(), &check::network_rules(), &check::profile_rules(),
          &xdd::all_rules(), &json::all_rules(), &gen::all_rules(), &network::all_rules(), &suppression_rules()}) {
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

std::vector<std::string_view> all_ids() {
  std::vector<std::string_view> ids;
  for (const Rule* rule : all_rules()) {
    ids.push_back(rule->id);
  }
  return ids;
}

bool is_of_generator(const Rule& rule) { return has(gen::all_rules(), rule); }

bool is_optional(const Rule& rule) { return has(check::profile_rules(), rule); }

}  // namespace lexican::codict::catalogue
