// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "catalogue/rules.hpp"
#include "check/profile.hpp"
#include "cli/baseline.hpp"
#include "cli/command.hpp"
#include "cli/output.hpp"
#include "cli/render.hpp"
#include "cli/services.hpp"

namespace lexican::codict::cli {

namespace {

// Format of the output (--error-format).
enum class Form : unsigned char { gcc, json, sarif, github };

struct CheckOptions {
  std::vector<std::string> files;
  Severity level = Severity::warning;
  std::vector<std::string> disabled;
  std::string profile;
  std::string baseline;
  std::string new_baseline;
  Form form = Form::gcc;
  bool is_json = false;
  bool shows_all = false;
  bool is_strict = false;
};

// Output for all files.
struct Report {
  std::map<Severity, std::size_t> counts;
  Json files = Json::array();
  Sarif sarif;
  Baseline known;  // findings of --baseline that have not occurred yet
  Baseline fresh;  // findings for --write-baseline
};

// Returns the findings without folding equal ones (--all).
std::vector<FoldedFindings> each_alone(const std::vector<Finding>& findings) {
  std::vector<FoldedFindings> all;
  all.reserve(findings.size());
  for (const Finding& finding : findings) {
    all.push_back({&finding, 0, {}});
  }
  return all;
}

Severity severity_of(const Rule& rule, const CheckOptions& options) {
  return options.is_strict && rule.severity == Severity::warning ? Severity::error : rule.severity;
}

bool is_wanted(const Rule& rule, const CheckOptions& options) {
  return severity_of(rule, options) >= options.level &&
         std::find(options.disabled.begin(), options.disabled.end(), rule.id) == options.disabled.end();
}

// Returns the findings to report: those that the options select and the baseline does not contain.
std::vector<Finding> wanted(const Input& input, const CheckOptions& options, Report& report) {
  std::vector<Finding> result;
  for (const Finding& finding : input.findings.all()) {
    if (is_wanted(*finding.rule, options) && !report.known.remove_match(input, finding)) {
      result.push_back(finding);
      result.back().severity = severity_of(*finding.rule, options);
    }
  }
  return result;
}

// Prints the number of findings of the baseline that no longer occur.
void print_obsolete(const Input& input, const CheckOptions& options, const Baseline& known) {
  const std::size_t number = known.left(input, [&options](const std::string& id) {
    const Rule* const rule = catalogue::find_rule(id);
    return rule == nullptr || is_wanted(*rule, options);
  });
  if (number != 0) {
    print_message(input.source().name() + ": findings of the baseline that no longer occur: " + std::to_string(number));
  }
}

// Counts the findings beyond the limit, by rule, that the options select. They count as new to every baseline because
// their places are not stored.
Json count_dropped(const Input& input, const CheckOptions& options, Report& report) {
  std::map<Severity, std::size_t> counts;
  Json by_rule = Json::object();
  for (const auto& [rule, number] : input.findings.dropped()) {
    if (is_wanted(*rule, options)) {
      counts[severity_of(*rule, options)] += number;
      by_rule[rule->id] = number;
    }
  }
  if (by_rule.members().empty()) {
    return by_rule;
  }
  for (const auto& [severity, number] : counts) {
    report.counts[severity] += number;
  }
  print_message(
      fmt::format("{}: more than {} findings: {} are counted, but not shown; fix the first ones, or leave out "
                  "rules with --disable",
                  input.source().name(), Findings::most,
                  summary(counts[Severity::error], counts[Severity::warning], counts[Severity::note])));
  return by_rule;
}

void show(const Input& input, const std::vector<Finding>& findings, const Json& dropped, const CheckOptions& options,
          Report& report) {
  if (options.form == Form::sarif) {
    report.sarif.add(input, findings);
    return;
  }
  const std::vector<FoldedFindings> folded = options.shows_all ? each_alone(findings) : fold(findings);
  if (options.form == Form::json) {
    Json file{{"file", input.source().name()}, {"findings", to_json(input.source(), folded)}};
    if (!dropped.members().empty()) {
      file["not_shown"] = dropped;
    }
    report.files.push_back(std::move(file));
  } else if (options.form == Form::github) {
    print(to_github(input.source(), folded));
  } else {
    print(render(input.source(), input.encoding(), folded, wants_colour()));
  }
}

// Checks the devices against the profile: a number, "auto", or empty for no profile.
void check_profiles(Input& input, const std::string& profile) {
  if (profile.empty()) {
    return;
  }
  for (const Device& device : input.description.devices) {
    const auto number = profile == "auto" ? check::profile_of(device) : static_cast<std::uint16_t>(std::stoul(profile));
    check::check_profile(device, number, input.findings);
  }
}

// Checks a file and prints its findings, or adds them to the new baseline. Returns the exit status.
int check_file(const std::string& path, const CheckOptions& options, Report& report) {
  std::optional<Input> input = load(path);
  if (!input) {
    return unusable;
  }
  check_profiles(*input, options.profile);
  check_all(*input);
  const std::vector<Finding> findings = wanted(*input, options, report);
  const Json dropped = count_dropped(*input, options, report);
  if (!options.new_baseline.empty()) {
    for (const Finding& finding : findings) {
      report.fresh.add(*input, finding);
    }
    return clean;
  }
  for (const Finding& finding : findings) {
    ++report.counts[finding.severity];
  }
  show(*input, findings, dropped, options, report);
  print_obsolete(*input, options, report.known);
  return findings.empty() && dropped.members().empty() ? clean : found;
}

// Prints what follows the findings of all files: the JSON or SARIF document, or a summary.
void finish(const CheckOptions& options, Report& report, int status) {
  if (options.form == Form::json) {
    print_json(Json{{"schema", "codict-check-1"}, {"files", std::move(report.files)}});
  } else if (options.form == Form::sarif) {
    print_json(report.sarif.document(status != unusable));
  } else if (const std::string text = summary(report.counts[Severity::error], report.counts[Severity::warning],
                                              report.counts[Severity::note]);
             !text.empty()) {
    print_message(text);
  } else if (status == clean && options.new_baseline.empty() && is_terminal()) {
    print_message("no findings");
  }
}

// Checks the options and reads the baseline. Returns false after a message if either is faulty.
bool prepare(const CheckOptions& options, Report& report) {
  for (const std::string& id : options.disabled) {
    if (catalogue::find_rule(id) == nullptr) {
      print_message(unknown_rule(id));
      return false;
    }
  }
  std::string why;
  if (!options.new_baseline.empty() && std::filesystem::exists(options.new_baseline) &&
      !Baseline::read(options.new_baseline, why)) {
    print_message(why + ": it is not overwritten");
    return false;
  }
  if (options.baseline.empty()) {
    return true;
  }
  std::optional<Baseline> baseline = Baseline::read(options.baseline, why);
  if (!baseline) {
    print_message(why);
    return false;
  }
  report.known = std::move(*baseline);
  return true;
}

int run_check(CheckOptions options) {
  if (options.is_json) {
    options.form = Form::json;
  }
  Report report;
  if (!prepare(options, report)) {
    return unusable;
  }
  int status = clean;
  for (const std::string& path : options.files) {
    status = std::max(status, check_file(path, options, report));
  }
  if (options.new_baseline.empty()) {
    finish(options, report, status);
    return status;
  }
  return status != clean ? status : write_output(options.new_baseline, to_text(report.fresh.to_json()));
}

}  // namespace

Command add_check(CommandLine& line) {
  const auto options = std::make_shared<CheckOptions>();
  Arguments command = line.add_command("check", "Say what is wrong or odd in descriptions");
  command.add_option("file", options->files, file_help).required();
  const Choices<Severity> levels = {
      {"note", Severity::note}, {"warning", Severity::warning}, {"error", Severity::error}};
  command.add_choice("--level", options->level, levels, "Lowest severity that is reported: note, warning, error")
      .default_text("warning");
  command.add_option("--disable", options->disabled, "Rule that is not reported; may be given several times")
      .single_values();
  command
      .add_option("--profile", options->profile,
                  "Also check the objects of a device profile: 401, 402, or auto for the profile in object 1000h")
      .one_of({"401", "402", "auto"});
  command.add_flag("--werror", options->is_strict, "Treat warnings as errors");
  const Option known =
      command.add_option("--baseline", options->baseline, "File of known findings, which are not reported");
  command
      .add_option("--write-baseline", options->new_baseline,
                  "Write all findings to a file for --baseline, and report none")
      .excludes(known);
  command.add_flag("--all", options->shows_all,
                   "Show each of several equal findings, not only the first and their number");
  const Choices<Form> forms = {
      {"gcc", Form::gcc}, {"json", Form::json}, {"sarif", Form::sarif}, {"github", Form::github}};
  const Option form =
      command
          .add_choice("--error-format", options->form, forms,
                      "gcc: lines for people and editors; json, sarif (2.1.0): for programs; github: annotations")
          .default_text("gcc");
  command.add_flag("--json", options->is_json, "Like --error-format json").excludes(form);
  return {command, [options] { return run_check(*options); }};
}

}  // namespace lexican::codict::cli
