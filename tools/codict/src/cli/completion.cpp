// SPDX-License-Identifier: Apache-2.0
// Completion for shells, generated from the commands and options that the program parses.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "cli/shell.hpp"

namespace lexican::codict::cli {

namespace {

// Returns the long names of a command's options: "--level --disable …".
std::string long_names(const CommandText& command) {
  std::string names;
  for (const OptionText& option : command.options) {
    for (const std::string& name : option.long_names) {
      names += (names.empty() ? "--" : " --") + name;
    }
  }
  return names;
}

// Returns the first positional argument of a command if it has a list of words, else null.
const OptionText* first_words(const CommandText& command) {
  for (const OptionText& option : command.options) {
    if (!option.name.empty()) {
      return option.words.empty() ? nullptr : &option;
    }
  }
  return nullptr;
}

// Completes a command as first word, then options and the words of arguments, else files as bash does by default.
constexpr std::string_view bash_head = R"(() {
  local word=${COMP_WORDS[COMP_CWORD]} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -gt 1 ] && [[ $word != -* ]]; then
    case ${COMP_WORDS[1]}:${COMP_WORDS[COMP_CWORD - 1]} in
)";

// Returns the cases of a command and the word before the one that is completed: "      lss:lss) words='scan …' ;;".
std::string bash_values(const CommandText& command) {
  std::string cases;
  const auto add = [&](const std::string& before, const OptionText& option) {
    cases += fmt::format("      {}:{}) words='{}' ;;\n", command.name, before, fmt::join(option.words, " "));
  };
  if (const OptionText* const first = first_words(command); first != nullptr) {
    add(command.name, *first);
  }
  for (const OptionText& option : command.options) {
    for (const std::string& name : option.short_names) {
      option.words.empty() ? void() : add("-" + name, option);
    }
    for (const std::string& name : option.long_names) {
      option.words.empty() ? void() : add("--" + name, option);
    }
  }
  return cases;
}

std::string bash_completion(const CommandLine& line) {
  const std::string program = line.describe().name;
  std::string script = fmt::format("# Completion of {0} in bash.\n_{0}{1}", program, bash_head);
  std::string names;
  for (const CommandText& command : line.describe_commands()) {
    script += bash_values(command);
  }
  script += R"(      *) return ;;
    esac
  elif [ "$COMP_CWORD" -gt 1 ]; then
    case ${COMP_WORDS[1]} in
)";
  for (const CommandText& command : line.describe_commands()) {
    script += fmt::format("      {}) words='{}' ;;\n", command.name, long_names(command));
    names += command.name + " ";
  }
  return script + fmt::format(R"(    esac
  else
    words='{0}{1}'
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  [[ ${{COMPREPLY[0]-}} != *: ]] || compopt -o nospace 2>/dev/null
}}
complete -o bashdefault -o default -F _{2} {2}
)",
                              names, long_names(line.describe()), program);
}

// Returns the text with a backslash before each character that marks contains.
std::string escaped(std::string_view text, std::string_view marks) {
  std::string result;
  for (const char c : text) {
    result += (marks.find(c) == std::string_view::npos ? "" : "\\") + std::string(1, c);
  }
  return result;
}

// Returns the help of an option without the lines that only --help shows.
std::string first_line(const OptionText& option) { return option.help.substr(0, option.help.find('\n')); }

// Returns 'text', quoted as one word of zsh.
std::string zsh_word(std::string_view text) {
  std::string word;
  for (const char c : text) {
    word += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return "'" + word + "'";
}

// Returns the completion of an option's values: its words, nothing for numbers, else files.
std::string zsh_values(const OptionText& option) {
  if (!option.words.empty()) {
    return fmt::format(":{}:({})", option.type, escaped(fmt::format("{}", fmt::join(option.words, " ")), ":"));
  }
  return fmt::format(":{}:{}", option.type, option.type == "UINT" ? " " : "_files");
}

// Returns nothing for a positional argument, else a line "        '*--level[Least severity …]:ENUM:(note warning
// error)' \" for each name of an option.
std::string zsh_option(const OptionText& option) {
  if (!option.name.empty()) {
    return "";
  }
  std::vector<std::string> names;
  for (const std::string& name : option.short_names) {
    names.push_back("-" + name);
  }
  for (const std::string& name : option.long_names) {
    names.push_back("--" + name);
  }
  std::string lines;
  for (const std::string& name : names) {
    lines +=
        fmt::format("        {} \\\n", zsh_word(fmt::format("*{}[{}]{}", name, escaped(first_line(option), "\\[]:"),
                                                            option.type.empty() ? "" : zsh_values(option))));
  }
  return lines;
}

constexpr std::string_view zsh_tail = R"(  esac
}}
if [ "$funcstack[1]" = _{0} ]; then
  _{0} "$@"
else
  compdef _{0} {0}
fi
)";

std::string zsh_completion(const CommandLine& line) {
  std::string commands;
  std::string cases;
  for (const CommandText& command : line.describe_commands()) {
    commands += fmt::format("    {}\n", zsh_word(command.name + ":" + escaped(command.help, "\\:")));
    cases += fmt::format("    {})\n      _arguments \\\n", command.name);
    for (const OptionText& option : command.options) {
      cases += zsh_option(option);
    }
    if (const OptionText* const first = first_words(command); first != nullptr) {
      cases += fmt::format("        '1:{}:({})' \\\n", first->name, fmt::join(first->words, " "));
    }
    cases += "        '*:file:_files' ;;\n";
  }
  const std::string program = line.describe().name;
  std::string script = fmt::format("#compdef {0}\n# Completion of {0} in zsh.\n_{0}() {{\n  local -a commands=(\n{1}",
                                   program, commands);
  script += "  )\n  if (( CURRENT == 2 )); then\n    if [[ $words[2] == -* ]]; then\n      _arguments \\\n";
  for (const OptionText& option : line.describe().options) {
    script += zsh_option(option);
  }
  script += "        && return\n    fi\n    _describe command commands\n    return\n  fi\n";
  script += "  shift words\n  (( CURRENT-- ))\n  case $words[1] in\n" + cases;
  return script + fmt::format(zsh_tail, program);
}

// Returns 'text', quoted as one word of fish.
std::string fish_word(std::string_view text) { return "'" + escaped(text, "\\'") + "'"; }

// Returns a command of fish that completes an option where the condition is true; nothing for a positional argument.
std::string fish_option(const std::string& program, const OptionText& option, const std::string& condition) {
  if (!option.name.empty()) {
    return "";
  }
  std::string text = fmt::format("complete -c {} -n {}", program, condition);
  for (const std::string& name : option.short_names) {
    text += " -s " + name;
  }
  for (const std::string& name : option.long_names) {
    text += " -l " + name;
  }
  if (!option.words.empty()) {
    text += fmt::format(" -x -a '{}'", fmt::join(option.words, " "));
  } else if (!option.type.empty()) {
    text += option.type == "UINT" ? " -x" : " -r -F";
  }
  return text + " -d " + fish_word(first_line(option)) + "\n";
}

std::string fish_completion(const CommandLine& line) {
  const std::string program = line.describe().name;
  std::string script = fmt::format("# Completion of {} in fish.\n", program);
  for (const OptionText& option : line.describe().options) {
    script += fish_option(program, option, "__fish_use_subcommand");
  }
  for (const CommandText& command : line.describe_commands()) {
    script += fmt::format("complete -c {} -n __fish_use_subcommand -f -a {} -d {}\n", program, command.name,
                          fish_word(command.help));
    if (const OptionText* const first = first_words(command); first != nullptr) {
      const std::string words = fmt::format("{}", fmt::join(first->words, " "));
      script += fmt::format(
          "complete -c {0} -n '__fish_seen_subcommand_from {1}; and not __fish_seen_subcommand_from {2}' -f -a '{2}'\n",
          program, command.name, words);
    }
    for (const OptionText& option : command.options) {
      script += fish_option(program, option, fmt::format("'__fish_seen_subcommand_from {}'", command.name));
    }
  }
  return script;
}

}  // namespace

std::string completion(const CommandLine& line, std::string_view shell) {
  return shell == "zsh" ? zsh_completion(line) : shell == "fish" ? fish_completion(line) : bash_completion(line);
}

}  // namespace lexican::codict::cli
