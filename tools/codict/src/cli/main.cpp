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

// What was typed where a command is; empty if there was one.
std::string unknown_command(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  const bool has_none = app.get_subcommands().empty() && !words.empty();
  return has_none && words.front().substr(0, 1) != "-" ? words.front() : "";
}

std::string words_for_unknown(const std::string& word, const std::vector<Command>& commands) {
  std::vector<std::string_view> names;
  names.reserve(commands.size());
  for (const Command& command : commands) {
    names.emplace_back(command.app->get_name());
  }
  return not_there("command", word, names, "codict --help");
}

int run(int number, char** arguments) {
  CLI::App app(
      "Reads, checks, edits, compares, converts and documents descriptions of CANopen devices (EDS, DCF, XDD, XDC, "
      "XPD, JSON).",
      "codict");
  app.set_version_flag("--version", "codict " LEXICAN_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 all is well, 1 findings or differences, 2 wrong use or unreadable input, 3 internal error.");
  const std::vector<Command> commands = {add_info(app),  add_list(app),    add_get(app),        add_set(app),
                                         add_check(app), add_diff(app),    add_convert(app),    add_merge(app),
                                         add_fmt(app),   add_doc(app),     add_pdo(app),        add_gen(app),
                                         add_size(app),  add_explain(app), add_completion(app), add_man(app)};
  try {
    app.parse(number, arguments);
  } catch (const CLI::ParseError& error) {
    const std::string word = unknown_command(app);
    if (!word.empty()) {
      complain(words_for_unknown(word, commands));
      return unusable;
    }
    return app.exit(error) == 0 ? clean : unusable;
  }
  for (const Command& command : commands) {
    if (command.app->parsed()) {
      return command.run();
    }
  }
  return unexpected;
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
