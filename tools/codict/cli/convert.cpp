// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "cli/command.hpp"
#include "cli/output.hpp"
#include "eds/write.hpp"

namespace lexican::codict::cli {

namespace {

struct Options {
  std::string file;
  std::string output;
  std::string format;
};

int run(const Options& options) {
  const std::string format = options.format.empty() ? ending_of(options.output) : options.format;
  if (format != "eds" && format != "dcf") {
    complain("the output ends with .eds or .dcf, or --to says which it is");
    return unusable;
  }
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  const Device& device = input->device();
  const bool is_same = device.format == (format == "eds" ? Format::eds : Format::dcf);
  if (is_same) {
    return write_output(options.output, input->source().bytes());
  }
  eds::WriteOptions write_options;
  write_options.as_dcf = format == "dcf";
  return write_output(options.output, eds::write(device, write_options));
}

}  // namespace

Command add_convert(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand("convert", "Write a description in another format");
  command->add_option("file", options->file, "EDS or DCF, - for the standard input")->required();
  command->add_option("-o,--output", options->output, "File that ends with .eds or .dcf, - for the standard output")
      ->required();
  command->add_option("--to", options->format, "eds or dcf")->check(CLI::IsMember({"eds", "dcf"}).description(""));
  return {command, [options] { return run(*options); }};
}

}  // namespace lexican::codict::cli
