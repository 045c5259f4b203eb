// SPDX-License-Identifier: Apache-2.0
// Manual page, generated from the commands and options that the program parses.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "cli/shell.hpp"

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

std::string roff_of(const CommandText& program, const CommandText& command) {
  std::string text = fmt::format(".SS \"{} {}", program.name, roff(command.name));
  for (const OptionText& option : command.options) {
    if (!option.name.empty()) {
      text += fmt::format(option.is_required ? " {}" : " [{}]", roff(option.name));
    }
  }
  text += fmt::format("\"\n{}.\n", roff(command.help));
  for (const OptionText& option : command.options) {
    text += fmt::format(".TP\n{}\n{}.\n", roff_of(option), roff(option.help));
  }
  if (command.footer != program.footer) {
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.footer));
  }
  return text;
}

}  // namespace

std::string manual(const CommandLine& line, std::string_view about, std::string_view version) {
  const CommandText program = line.describe();
  std::string title = program.name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text = fmt::format(
      ".TH {0} 1 \"\" \"{1} {2}\" Lexican\n.SH NAME\n{1} \\- {3}\n"
      ".SH SYNOPSIS\n.B {1}\n.I command\n[\\fIoption\\fR ...] [\\fIargument\\fR ...]\n.SH DESCRIPTION\n{4}\n.SH "
      "COMMANDS\n",
      title, program.name, roff(version), about, roff(program.help));
  for (const CommandText& command : line.describe_commands()) {
    text += roff_of(program, command);
  }
  return text + fmt::format(".SH EXIT STATUS\n{}\n", roff(program.footer));
}

}  // namespace lexican::codict::cli
