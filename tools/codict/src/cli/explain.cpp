// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <vector>

#include "catalogue/pages.hpp"
#include "catalogue/rules.hpp"
#include "cli/command.hpp"
#include "cli/services.hpp"

namespace lexican::codict::cli {

namespace {

struct ExplainOptions {
  std::string rule;
  bool is_json = false;
  bool has_all = false;
};

Json rule_json(const Rule& rule) {
  return {{"rule", rule.id},
          {"severity", name_of(rule.severity)},
          {"text", rule.about},
          {"page", catalogue::link_to(rule)}};
}

int explain_one(const ExplainOptions& options) {
  const Rule* const rule = catalogue::find_rule(options.rule);
  if (rule == nullptr) {
    print_message(unknown_rule(options.rule));
    return unusable;
  }
  if (options.is_json) {
    print_json(Json{{"schema", "codict-explain-1"}, {"rules", Json::array({rule_json(*rule)})}});
  } else {
    print(fmt::format("{}\n{}\n", catalogue::section_of(*rule), catalogue::link_to(*rule)));
  }
  return clean;
}

int list_all(const ExplainOptions& options) {
  Json all = Json::array();
  for (const Rule* rule : catalogue::all_rules()) {
    if (options.is_json) {
      all.push_back(rule_json(*rule));
    } else {
      print(fmt::format("{:<26} {:<8} {}\n", rule->id, name_of(rule->severity), rule->about));
    }
  }
  if (options.is_json) {
    print_json(Json{{"schema", "codict-explain-1"}, {"rules", std::move(all)}});
  }
  return clean;
}

int run_explain(const ExplainOptions& options) {
  if (!options.rule.empty()) {
    return explain_one(options);
  }
  if (options.has_all && !options.is_json) {
    print(catalogue::reference());
    return clean;
  }
  return list_all(options);
}

}  // namespace

std::string unknown_rule(const std::string& id) {
  return unknown_word_message("rule", id, catalogue::all_ids(), "codict explain");
}

Command add_explain(CommandLine& line) {
  const auto options = std::make_shared<ExplainOptions>();
  Arguments command = line.add_command("explain", "Explain a rule of check, gen or network");
  const Option rule = command.add_option("rule", options->rule, "Id of the rule; default: all rules are listed");
  command.add_flag("--all", options->has_all, "Print the reference page of all rules (docs/rules.md)").excludes(rule);
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_explain(*options); }};
}

}  // namespace lexican::codict::cli
