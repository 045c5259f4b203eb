// SPDX-License-Identifier: Apache-2.0
// Manual page, generated from the commands and options that the program parses.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"

namespace lexican::codict::cli {

namespace {

// Escapes characters that roff would interpret as a hyphen, an escape or a request.
std::string roff(std::string_view text) {
  std::string result = text.substr(0, 1) == "." || text.substr(0, 1) == "'" ? "\\&" : "";
  for (const char c : text) {
    result += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  }
  return result;
}

// Returns "-o, --output TEXT", marked up for roff.
std::string roff_of(const OptionText& option) {
  if (!option.name.empty()) {
    return "\\fI" + roff(option.name) + "\\fR";
  }
  std::string text;
  for (const std::string& name : option.short_names) {
    text += "\\fB\\-" + roff(name) + "\\fR, ";
  }
  for (const std::string& name : option.long_names) {
    text += "\\fB\\-\\-" + roff(name) + "\\fR";
  }
  return option.type.empty() ? text : text + " \\fI" + roff(option.type) + "\\fR";
}

std::string roff_of(const CommandText& command) {
  std::string text = fmt::format(".SS \"codict {}", roff(command.name));
  for (const OptionText& option : command.options) {
    if (!option.name.empty()) {
      text += fmt::format(option.is_required ? " {}" : " [{}]", roff(option.name));
    }
  }
  text += fmt::format("\"\n{}.\n", roff(command.help));
  for (const OptionText& option : command.options) {
    text += fmt::format(".TP\n{}\n{}.\n", roff_of(option), roff(option.help));
  }
  return text;
}

std::string manual(const CommandLine& line) {
  const CommandText program = line.describe();
  std::string text = fmt::format(
      ".TH CODICT 1 \"\" \"codict {}\" Lexican\n.SH NAME\ncodict \\- descriptions of CANopen devices\n"
      ".SH SYNOPSIS\n.B codict\n.I command\n[\\fIoption\\fR ...] [\\fIfile\\fR ...]\n.SH DESCRIPTION\n{}\n.SH "
      "COMMANDS\n",
      roff(LEXICAN_VERSION), roff(program.help));
  for (const CommandText& command : line.describe_commands()) {
    text += roff_of(command);
  }
  return text + fmt::format(".SH EXIT STATUS\n{}\n", roff(program.footer));
}

}  // namespace

Command add_man(CommandLine& line) {
  Arguments command = line.add_command("man", "Print the manual page, for man -l or man1");
  return {command, [&line] {
            print(manual(line));
            return clean;
          }};
}

}  // namespace lexican::codict::cli
