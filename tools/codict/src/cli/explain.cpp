// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "catalogue/rules.hpp"
#include "cli/command.hpp"
#include "cli/services.hpp"

namespace lexican::codict::cli {

namespace {

struct Options {
  std::string rule;
  bool is_json = false;
};

Json to_json(const Rule& rule) {
  return {{"rule", rule.id}, {"severity", name_of(rule.severity)}, {"text", rule.about}, {"page", page_of(rule)}};
}

int explain_one(const Options& options) {
  const Rule* const rule = catalogue::find_rule(options.rule);
  if (rule == nullptr) {
    complain(unknown_rule(options.rule));
    return unusable;
  }
  if (options.is_json) {
    print_json(Json{{"schema", "codict-explain-1"}, {"rules", Json::array({to_json(*rule)})}});
  } else {
    print(fmt::format("{} ({})\n{}\n{}\n", rule->id, name_of(rule->severity), rule->about, page_of(*rule)));
  }
  return clean;
}

int explain_all(const Options& options) {
  Json all = Json::array();
  for (const Rule* rule : catalogue::all_rules()) {
    if (options.is_json) {
      all.push_back(to_json(*rule));
    } else {
      print(fmt::format("{:<26} {:<8} {}\n", rule->id, name_of(rule->severity), rule->about));
    }
  }
  if (options.is_json) {
    print_json(Json{{"schema", "codict-explain-1"}, {"rules", std::move(all)}});
  }
  return clean;
}

}  // namespace

std::string unknown_rule(const std::string& id) {
  return not_there("rule", id, catalogue::all_ids(), "codict explain");
}

Command add_explain(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand("explain", "Say what a rule of check or gen is about");
  command->add_option("rule", options->rule, "Its id; without one, all rules are named");
  command->add_flag("--json", options->is_json, "For programs");
  return {command, [options] { return options->rule.empty() ? explain_all(*options) : explain_one(*options); }};
}

}  // namespace lexican::codict::cli
