// SPDX-License-Identifier: Apache-2.0
// codict: reads, checks and edits descriptions of CANopen devices.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <vector>

#include "cli/command.hpp"

namespace {

using namespace lexican::codict::cli;

int run(int number, char** arguments) {
  CLI::App app(
      "Reads, checks, edits, compares, converts and documents descriptions of CANopen devices (EDS, DCF, XDD, XDC, "
      "JSON).",
      "codict");
  app.set_version_flag("--version", "codict " LEXICAN_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 all is well, 1 findings or differences, 2 wrong use or unreadable input, 3 internal error.");
  const std::vector<Command> commands = {
      add_info(app),  add_list(app), add_get(app), add_set(app), add_check(app), add_diff(app), add_convert(app),
      add_merge(app), add_fmt(app),  add_doc(app), add_pdo(app), add_gen(app),   add_size(app), add_explain(app)};
  try {
    app.parse(number, arguments);
  } catch (const CLI::ParseError& error) {
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
