// SPDX-License-Identifier: Apache-2.0
// lexican, the bus tool.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "program/verb.hpp"
#include "text/similar.hpp"

namespace {

using namespace lexican::program;

constexpr const char* about = "Finds, watches, reads and writes CANopen devices on any CAN bus.";
constexpr const char* footer =
    "A verb may be shortened while it is unique. lexican VERB --help ends with examples.\n"
    "Exit status: 0 all is well, 1 the device refused or differs, 2 wrong use, 3 no answer, 4 bus fault, 130 "
    "interrupted.";

/// Returns the name of the verb that a word means: itself, or that of which it is the beginning.
std::string verb_of(const std::string& word, const std::vector<Verb>& verbs) {
  std::string found;
  unsigned matches = 0;
  for (const Verb& verb : verbs) {
    const std::string& name = verb.arguments.name();
    if (name == word) {
      return word;
    }
    if (!word.empty() && name.compare(0, word.size(), word) == 0) {
      found = name;
      ++matches;
    }
  }
  return matches == 1 ? found : word;
}

std::string message_for_unknown(const std::string& word, const std::vector<Verb>& verbs) {
  std::vector<std::string_view> names;
  std::vector<std::string_view> begun;
  for (const Verb& verb : verbs) {
    names.emplace_back(verb.arguments.name());
    if (verb.arguments.name().compare(0, word.size(), word) == 0) {
      begun.emplace_back(verb.arguments.name());
    }
  }
  if (!word.empty() && begun.size() > 1) {
    return fmt::format("{} is the beginning of several verbs: {}", word, fmt::join(begun, ", "));
  }
  const std::vector<std::string_view> near = lexican::codict::similar(word, names);
  return near.empty() ? fmt::format("unknown verb {}; lexican --help lists all", word)
                      : fmt::format("unknown verb {}; did you mean {}?", word, fmt::join(near, ", "));
}

int show_verbs(const CommandLine& line) {
  print(std::string(about) + "\n\n");
  for (const auto& command : line.describe_commands()) {
    print(fmt::format("  {:<10} {}\n", command.name, command.help));
  }
  print("\nlexican VERB --help shows options and examples. Begin with: lexican scan -i BUS\n");
  return ok;
}

/// Returns the arguments, with "help VERB" as "VERB --help".
std::vector<std::string> without_help(int number, char** arguments) {
  std::vector<std::string> words(arguments, arguments + number);
  const bool is_help = words.size() == 3 && words[1] == "help" && words[2].substr(0, 1) != "-";
  return is_help ? std::vector<std::string>{words[0], words[2], "--help"} : words;
}

int run_program(int number, char** arguments) {
  CommandLine line("lexican", about, "lexican " LEXICAN_VERSION, footer);
  const std::vector<Verb> verbs = {add_scan(line),  add_mon(line),        add_top(line), add_why(line),
                                   add_read(line),  add_write(line),      add_pdo(line), add_dump(line),
                                   add_apply(line), add_nmt(line),        add_lss(line), add_sim(line),
                                   add_share(line), add_completion(line), add_man(line), add_help(line)};
  std::vector<std::string> words = without_help(number, arguments);
  if (words.size() < 2 || (words.size() == 2 && words[1] == "help")) {
    return show_verbs(line);
  }
  words[1] = verb_of(words[1], verbs);
  std::vector<char*> texts;
  for (std::string& word : words) {
    texts.push_back(word.data());
  }
  const CommandLine::Parsed parsed = line.parse(static_cast<int>(texts.size()), texts.data());
  if (!parsed.unknown_command.empty()) {
    print_message(message_for_unknown(parsed.unknown_command, verbs));
  }
  for (const Verb& each : verbs) {
    if (each.arguments.name() == parsed.command) {
      return each.run();
    }
  }
  return parsed.is_refused ? usage : ok;
}

}  // namespace

int main(int number, char** arguments) {
  try {
    const int status = run_program(number, arguments);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      std::perror("lexican: standard output");
      return usage;
    }
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lexican: internal error: %s\n", error.what());
  }
  return usage;
}
