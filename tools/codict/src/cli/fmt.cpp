// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cli/command.hpp"
#include "cli/output.hpp"
#include "eds/format.hpp"

namespace lexican::codict::cli {

namespace {

struct FmtOptions {
  std::string file;
  std::string output;
  bool is_check = false;
  bool is_json = false;
};

int run_fmt(const FmtOptions& options) {
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  if (input->eds == nullptr) {
    print_message(input->source().name() + ": not an EDS or DCF; fmt has no normal form for other formats");
    return unusable;
  }
  const std::string bytes = eds::formatted(*input->eds);
  const bool is_changed = bytes != input->source().bytes();
  const std::string path = options.output.empty() ? options.file : options.output;
  Status status = clean;
  if (!options.is_check) {
    status = write_output(path, bytes);
  } else if (is_changed) {
    print_message(input->source().name() + " is not in normal form");
    status = found;
  }
  if (options.is_json && status != unusable && (options.is_check || path != "-")) {
    print_json(
        Json{{"schema", "codict-fmt-1"}, {"file", options.is_check ? options.file : path}, {"changed", is_changed}});
  }
  return status;
}

}  // namespace

Command add_fmt(CommandLine& line) {
  const auto options = std::make_shared<FmtOptions>();
  Arguments command = line.add_command("fmt", "Write an EDS or DCF in its normal form: the same device");
  command.add_option("file", options->file, "EDS or DCF, - for the standard input").required();
  command.add_option("-o,--output", options->output, "Output file, - for the standard output; default: the input file");
  command.add_flag("--check", options->is_check, "Write no file; status 1 if the file would change");
  command.add_flag("--json", options->is_json, "Print JSON, for programs");
  return {command, [options] { return run_fmt(*options); }};
}

}  // namespace lexican::codict::cli
