// SPDX-License-Identifier: Apache-2.0
#include "doc/doc.hpp"

#include <string>

#include "cli/command.hpp"
#include "cli/output.hpp"

namespace lexican::codict::cli {

namespace {

struct DocOptions {
  std::string file;
  std::string output;
  std::string format;
  doc::Options doc{"en", 0};
};

int run_doc(DocOptions options) {
  const std::string format = options.format.empty() ? ending_of(options.output) : options.format;
  if (format != "md" && format != "html") {
    print_message("unknown format of the output; use the suffix .md or .html, or the option --to");
    return unusable;
  }
  const std::optional<Input> input = open(options.file);
  if (!input) {
    return unusable;
  }
  options.doc.node_id = node_id_of(input->device(), options.doc.node_id);
  return write_output(options.output, format == "md" ? doc::markdown(input->device(), options.doc)
                                                     : doc::html(input->device(), options.doc));
}

}  // namespace

Command add_doc(CommandLine& line) {
  const auto options = std::make_shared<DocOptions>();
  Arguments command = line.add_command("doc", "Document a device, as Markdown or as one HTML page");
  command.add_option("file", options->file, file_help).required();
  command.add_option("-o,--output", options->output, "File that ends with .md or .html, - for the standard output")
      .required();
  command.add_option("--to", options->format, "md or html").one_of({"md", "html"});
  add_node_id(command, options->doc.node_id);
  command.add_option("--language", options->doc.language, "Language of labels and descriptions")
      .default_text(options->doc.language);
  return {command, [options] { return run_doc(*options); }};
}

}  // namespace lexican::codict::cli
