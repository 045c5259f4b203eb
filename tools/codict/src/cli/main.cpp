// SPDX-License-Identifier: Apache-2.0
// codict: reads, checks and edits descriptions of CANopen devices.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.hpp"

namespace {

using namespace lexican::codict::cli;

std::string words_for_unknown(const std::string& word, const std::vector<Command>& commands) {
  std::vector<std::string_view> names;
  names.reserve(commands.size());
  for (const Command& command : commands) {
    names.emplace_back(command.arguments.name());
  }
  return unknown_word_message("command", word, names, "codict --help");
}

int run(int number, char** arguments) {
  CommandLine line(
      "codict",
      "Reads, checks, edits, compares, converts and documents descriptions of CANopen devices (EDS, DCF, XDD, XDC, "
      "XPD, JSON).",
      "codict " LEXICAN_VERSION,
      "Exit status: 0 all is well, 1 findings or differences, 2 wrong use or unreadable input, 3 internal error.");
  const std::vector<Command> commands = {
      add_info(line),    add_list(line),    add_get(line), add_set(line),     add_check(line),      add_diff(line),
      add_convert(line), add_merge(line),   add_fmt(line), add_doc(line),     add_pdo(line),        add_gen(line),
      add_size(line),    add_network(line), add_new(line), add_explain(line), add_completion(line), add_man(line)};
  const CommandLine::Parsed parsed = line.parse(number, arguments);
  if (!parsed.unknown_command.empty()) {
    print_message(words_for_unknown(parsed.unknown_command, commands));
  }
  for (const Command& command : commands) {
    if (command.arguments.name() == parsed.command) {
      return command.run();
    }
  }
  return parsed.is_refused ? unusable : clean;
}

}  // namespace

int main(int number, char** arguments) {
  try {
    const int status = run(number, arguments);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      std::perror("codict: standard output");
      return unusable;
    }
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "codict: internal error: %s\n", error.what());
  }
  return unexpected;
}
