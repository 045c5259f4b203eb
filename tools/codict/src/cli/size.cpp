// SPDX-License-Identifier: Apache-2.0
#include "gen/gen.hpp"

#include <string>

#include "cli/command.hpp"
#include "cli/costs.hpp"
#include "cli/render.hpp"
#include "cli/stores.hpp"

namespace lexican::codict::cli {

namespace {

struct SizeOptions {
  std::string file;
  std::vector<std::string> stores;
  gen::Options gen;
  bool is_json = false;
};

int run_size(SizeOptions options) {
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  options.gen.name = gen::default_name(options.file);
  if (!parse_stores(options.stores, options.gen)) {
    return unusable;
  }
  Findings findings;
  const gen::Plan plan = gen::make_plan(input->device(), options.gen, findings);
  if (findings.count(Severity::error) != 0) {
    suppress(*input, catalogue::Origin::generator, findings);
    show_findings(*input, findings, Severity::warning);
    return found;
  }
  const std::vector<gen::Cost> costs = gen::costs_of(plan);
  if (options.is_json) {
    print_json(Json{{"schema", "codict-size-1"}, {"parts", costs_json(costs)}});
  } else {
    print(costs_text(costs));
  }
  return clean;
}

}  // namespace

Command add_size(CommandLine& line) {
  const auto options = std::make_shared<SizeOptions>();
  Arguments command =
      line.add_command("size", "Show the RAM and flash of the dictionary that gen makes, where addresses have 32 bits");
  command.add_option("file", options->file, file_help).required();
  add_stores(command, options->stores);
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  command
      .add_option("--string-capacity", options->gen.string_capacity,
                  "Bytes of a string whose length the description does not limit")
      .in_range(1, 65535)
      .default_text(std::to_string(options->gen.string_capacity));
  return {command, [options] { return run_size(*options); }};
}

}  // namespace lexican::codict::cli
