// SPDX-License-Identifier: Apache-2.0
// lexican completion, man and help: texts for the user's shell.
#include "cli/shell.hpp"
#include "program/verb.hpp"

namespace lexican::program {

Verb add_completion(CommandLine& line) {
  const auto shell = std::make_shared<std::string>("bash");
  Arguments arguments = line.add_command("completion", "Print what a shell needs to complete verbs and options");
  arguments.add_option("shell", *shell, "bash, zsh or fish; default: bash").one_of({"bash", "zsh", "fish"});
  return {arguments, [&line, shell] {
            print(codict::cli::completion(line, *shell));
            return ok;
          }};
}

Verb add_help(CommandLine& line) {
  const auto verb = std::make_shared<std::string>();
  Arguments arguments = line.add_command("help", "Show all verbs, or the options and examples of a verb");
  arguments.add_option("verb", *verb, "A verb, such as scan");
  return {arguments, [verb] { return ok; }};  // main() shows it
}

Verb add_man(CommandLine& line) {
  Arguments arguments = line.add_command("man", "Print the manual page, for man -l or man1");
  return {arguments, [&line] {
            print(codict::cli::manual(line, "finds, watches, reads and writes CANopen devices", LEXICAN_VERSION));
            return ok;
          }};
}

}  // namespace lexican::program
