// SPDX-License-Identifier: Apache-2.0
// The commands completion and man.
#include <memory>
#include <string>

#include "cli/command.hpp"
#include "cli/shell.hpp"

namespace lexican::codict::cli {

Command add_completion(CommandLine& line) {
  const auto shell = std::make_shared<std::string>("bash");
  Arguments command = line.add_command("completion", "Print what a shell needs to complete commands and options");
  command.add_option("shell", *shell, "bash, zsh or fish; default: bash").one_of({"bash", "zsh", "fish"});
  return {command, [&line, shell] {
            print(completion(line, *shell));
            return clean;
          }};
}

Command add_man(CommandLine& line) {
  Arguments command = line.add_command("man", "Print the manual page, for man -l or man1");
  return {command, [&line] {
            print(manual(line, "descriptions of CANopen devices", LEXICAN_VERSION));
            return clean;
          }};
}

}  // namespace lexican::codict::cli
