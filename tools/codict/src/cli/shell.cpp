// SPDX-License-Identifier: Apache-2.0
// What a shell and its user want to know of the program: made of the same commands and options that it parses.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"

namespace lexican::codict::cli {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_positional(); });
}

// "--level --disable …"
std::string long_names(const CLI::App& app) {
  std::string names;
  for (const CLI::Option* option : options_of(app)) {
    for (const std::string& name : option->get_lnames()) {
      names += (names.empty() ? "--" : " --") + name;
    }
  }
  return names;
}

// The first word is a command; later ones are options or, where bash completes them, files.
constexpr std::string_view completion_head = R"(# Completion of codict in bash.
_codict() {
  local word=${COMP_WORDS[COMP_CWORD]} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -gt 1 ]; then
    case $word in
      -*) ;;
      *) return ;;
    esac
    case ${COMP_WORDS[1]} in
)";

std::string completion(const CLI::App& app) {
  std::string script(completion_head);
  std::string names;
  for (const CLI::App* command : commands_of(app)) {
    script += fmt::format("      {}) words='{}' ;;\n", command->get_name(), long_names(*command));
    names += command->get_name() + " ";
  }
  return script + fmt::format(R"(    esac
  else
    words='{}{}'
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o bashdefault -o default -F _codict codict
)",
                              names, long_names(app));
}

// What roff would take for a hyphen, an escape or a request.
std::string roff(std::string_view text) {
  std::string result = text.substr(0, 1) == "." || text.substr(0, 1) == "'" ? "\\&" : "";
  for (const char c : text) {
    result += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  }
  return result;
}

// "-o, --output TEXT"
std::string roff_of(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : option.get_snames()) {
    text += "\\fB\\-" + roff(name) + "\\fR, ";
  }
  for (const std::string& name : option.get_lnames()) {
    text += "\\fB\\-\\-" + roff(name) + "\\fR";
  }
  const bool is_flag = option.get_items_expected_max() == 0;
  const std::string type = option.get_type_name();
  return is_flag ? text : text + " \\fI" + roff(type.substr(0, type.find(':'))) + "\\fR";
}

std::string roff_of(const CLI::App& command) {
  std::string text = fmt::format(".SS \"codict {}", roff(command.get_name()));
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      text += fmt::format(option->get_required() ? " {}" : " [{}]", roff(option->get_name(true)));
    }
  }
  text += fmt::format("\"\n{}.\n", roff(command.get_description()));
  for (const CLI::Option* option : command.get_options()) {
    text += fmt::format(".TP\n{}\n{}.\n",
                        option->get_positional() ? "\\fI" + roff(option->get_name(true)) + "\\fR" : roff_of(*option),
                        roff(option->get_description()));
  }
  return text;
}

std::string manual(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH CODICT 1 \"\" \"codict {}\" Lexican\n.SH NAME\ncodict \\- descriptions of CANopen devices\n"
      ".SH SYNOPSIS\n.B codict\n.I command\n[\\fIoption\\fR ...] [\\fIfile\\fR ...]\n.SH DESCRIPTION\n{}\n.SH "
      "COMMANDS\n",
      roff(LEXICAN_VERSION), roff(app.get_description()));
  for (const CLI::App* command : commands_of(app)) {
    text += roff_of(*command);
  }
  return text + fmt::format(".SH EXIT STATUS\n{}\n", roff(app.get_footer()));
}

}  // namespace

Command add_completion(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("completion", "Print what bash needs to complete commands and options");
  return {command, [&app] {
            print(completion(app));
            return clean;
          }};
}

Command add_man(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("man", "Print the manual page, for man -l or man1");
  return {command, [&app] {
            print(manual(app));
            return clean;
          }};
}

}  // namespace lexican::codict::cli
