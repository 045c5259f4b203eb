// SPDX-License-Identifier: Apache-2.0
#include "diff/diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.hpp"
#include "cli/letters.hpp"

namespace lexican::codict::cli {

namespace {

using diff::Difference;
using diff::Kind;

constexpr std::array<Kind, 5> kinds = {Kind::breaking, Kind::compatible, Kind::configuration, Kind::text, Kind::file};

struct DiffOptions {
  std::string before;
  std::string after;
  std::vector<Kind> only;
  bool is_json = false;
  bool is_release = false;
};

std::vector<Difference> wanted(std::vector<Difference> differences, const DiffOptions& options) {
  if (!options.only.empty()) {
    differences.erase(std::remove_if(differences.begin(), differences.end(),
                                     [&options](const Difference& difference) {
                                       return std::find(options.only.begin(), options.only.end(), difference.kind) ==
                                              options.only.end();
                                     }),
                      differences.end());
  }
  return differences;
}

std::string value(const std::string& text) { return text.empty() ? "-" : visible(text); }

std::string text_of(const std::vector<Difference>& differences) {
  std::string text;
  for (const Difference& difference : differences) {
    text +=
        fmt::format("{:<13} {:<9} {}: {} -> {}\n", name_of(difference.kind), visible(diff::to_string(difference.place)),
                    visible(difference.what), value(difference.before), value(difference.after));
  }
  return text;
}

std::string summary(const std::vector<Difference>& differences) {
  std::string text = fmt::format("{} difference{}", differences.size(), differences.size() == 1 ? "" : "s");
  char separator = ':';
  for (const Kind kind : kinds) {
    if (const std::size_t number = diff::count(differences, kind); number != 0) {
      text += fmt::format("{} {} {}", separator, number, name_of(kind));
      separator = ',';
    }
  }
  return text;
}

Json difference_json(const Source& source, Span span, const std::string& text) {
  Json json{{"text", text}};
  if (!span.is_empty()) {
    const Position position = source.position(span.begin);
    json["line"] = position.line;
    json["column"] = position.column;
  }
  return json;
}

Json difference_json(const Difference& difference, const Input& before, const Input& after) {
  Json json;
  json["kind"] = name_of(difference.kind);
  if (!difference.place.module.empty()) {
    json["module"] = difference.place.module;
  }
  if (difference.place.index != 0) {
    json["index"] = difference.place.index;
  }
  if (difference.place.has_sub_index) {
    json["sub_index"] = difference.place.sub_index;
  }
  json["what"] = difference.what;
  json["before"] = difference_json(before.source(), difference.before_span, difference.before);
  json["after"] = difference_json(after.source(), difference.after_span, difference.after);
  return json;
}

int run_diff(const DiffOptions& options) {
  const std::optional<Input> before = open(options.before);
  const std::optional<Input> after = open(options.after);
  if (!before || !after) {
    return unusable;
  }
  const std::vector<Difference> all = diff::compare(before->device(), after->device());
  const bool is_announced = diff::is_announced(before->device(), after->device(), all);
  const std::vector<Difference> differences = wanted(all, options);
  if (options.is_json) {
    Json list = Json::array();
    for (const Difference& difference : differences) {
      list.push_back(difference_json(difference, *before, *after));
    }
    print_json(Json{{"schema", "codict-diff-1"},
                    {"before", before->source().name()},
                    {"after", after->source().name()},
                    {"is_announced", is_announced},
                    {"differences", std::move(list)}});
  } else {
    print(text_of(differences));
    if (!differences.empty()) {
      print_message(summary(differences));
    }
  }
  if (!options.is_release) {
    return differences.empty() ? clean : found;
  }
  if (!is_announced) {
    print_message("breaking differences; raise the major revision number (upper half of 1018h, sub-index 3)");
  }
  return is_announced ? clean : found;
}

}  // namespace

Command add_diff(CommandLine& line) {
  const auto options = std::make_shared<DiffOptions>();
  Arguments command = line.add_command("diff", "Compare two descriptions by what they mean");
  command.add_option("before", options->before, file_help).required();
  command.add_option("after", options->after, file_help).required();
  Choices<Kind> names;
  for (const Kind kind : kinds) {
    names.emplace_back(name_of(kind), kind);
  }
  command.add_choices("--only", options->only, names,
                      "Kind that is reported: breaking, compatible, configuration, text, file; may be given several "
                      "times");
  command.add_flag("--release", options->is_release,
                   "Status 1 only if a difference is breaking and the major revision number has not been raised");
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_diff(*options); }};
}

}  // namespace lexican::codict::cli
