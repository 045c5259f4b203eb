// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "check/network.hpp"
#include "cli/command.hpp"
#include "cli/render.hpp"
#include "eds/rules.hpp"
#include "model/parse.hpp"
#include "xdd/rules.hpp"

namespace lexican::codict::cli {

namespace {

struct Options {
  std::vector<std::string> files;
  Severity level = Severity::warning;
  std::vector<std::string> disabled;
  bool is_json = false;
  bool shows_all = false;
};

bool is_rule(const std::string& id) {
  for (const auto* rules :
       {&value_rules(), &eds::all_rules(), &check::all_rules(), &check::network_rules(), &xdd::all_rules()}) {
    for (const Rule* rule : *rules) {
      if (rule->id == id) {
        return true;
      }
    }
  }
  return false;
}

std::vector<Folded> each_alone(const std::vector<Finding>& findings) {
  std::vector<Folded> all;
  for (const Finding& finding : findings) {
    all.push_back({&finding, 0});
  }
  return all;
}

std::vector<Finding> wanted(const Findings& findings, const Options& options) {
  std::vector<Finding> result;
  for (const Finding& finding : findings.all()) {
    const bool is_disabled =
        std::find(options.disabled.begin(), options.disabled.end(), finding.rule->id) != options.disabled.end();
    if (finding.rule->severity >= options.level && !is_disabled) {
      result.push_back(finding);
    }
  }
  return result;
}

// Counts of the three severities.
using Counts = std::map<Severity, std::size_t>;

int check_file(const std::string& path, const Options& options, Counts& counts, Json& json) {
  std::optional<Input> input = open(path);
  if (!input) {
    return unusable;
  }
  check_all(*input);
  const std::vector<Finding> findings = wanted(input->findings, options);
  for (const Finding& finding : findings) {
    ++counts[finding.rule->severity];
  }
  const std::vector<Folded> folded = options.shows_all ? each_alone(findings) : fold(findings);
  if (options.is_json) {
    json.push_back({{"file", input->source().name()}, {"findings", to_json(input->source(), folded)}});
  } else {
    print(render(input->source(), input->encoding(), folded, wants_colour()));
  }
  if (input->findings.dropped() != 0) {
    complain(input->source().name() + ": there are more findings than are kept");
  }
  return findings.empty() ? clean : found;
}

int run(const Options& options) {
  for (const std::string& id : options.disabled) {
    if (!is_rule(id)) {
      complain("there is no rule " + id);
      return unusable;
    }
  }
  int status = clean;
  Counts counts;
  Json files = Json::array();
  for (const std::string& path : options.files) {
    status = std::max(status, check_file(path, options, counts, files));
  }
  if (options.is_json) {
    print_json(Json{{"schema", "codict-check-1"}, {"files", std::move(files)}});
  } else if (const std::string text =
                 summary(counts[Severity::error], counts[Severity::warning], counts[Severity::note]);
             !text.empty()) {
    complain(text);
  }
  return status;
}

}  // namespace

Command add_check(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand("check", "Say what is wrong or odd in descriptions");
  command->add_option("file", options->files, file_help)->required();
  const std::map<std::string, Severity> levels = {
      {"note", Severity::note}, {"warning", Severity::warning}, {"error", Severity::error}};
  command->add_option("--level", options->level, "Least severity that is shown and counts: note, warning, error")
      ->transform(CLI::CheckedTransformer(levels).description(""))
      ->default_str("warning");
  command->add_option("--disable", options->disabled, "Rule that is left out; may be given several times")
      ->allow_extra_args(false);
  command->add_flag("--all", options->shows_all, "Show equal findings each, not the first and how many follow");
  command->add_flag("--json", options->is_json, "For programs");
  return {command, [options] { return run(*options); }};
}

}  // namespace lexican::codict::cli
