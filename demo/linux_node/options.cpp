// SPDX-License-Identifier: Apache-2.0
#include "linux_node/options.hpp"

#include <CLI/CLI.hpp>

#include <limits>

#include "co_ver.h"
#include "host/named_bus.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr const char* unconfigured = "unconfigured";

constexpr const char* description =
    "A CANopen node, the demo clock of Lexican, and a small master that uses all its services.\n"
    "Without options: uses vcan0 if there is one, else a bus inside the program, with simulated time.\n"
    "With --serve: the node alone, for lexican-demo-master or your own tools, until Ctrl-C. Uses vcan0 if there is "
    "one,\n"
    "else hub:demo, a bus between programs of this machine. lexican-demo-master uses the same one.\n"
    "An unconfigured node starts when an LSS master has set its node-ID, as lexican-demo-master lss set-id does.";

constexpr const char* footer =
    "Exit codes:\n"
    "    0  all steps went as expected; --serve: ended by Ctrl-C or SIGTERM\n"
    "    1  a step failed\n"
    "    2  wrong arguments, or the bus or the file cannot be used\n"
    "  130  ended by Ctrl-C or SIGTERM before the last step";

/// Returns the fault of the text, empty if it is valid.
std::string node_id_fault(std::string& words) {
  const bool fits = words == unconfigured || CLI::Range(1, 127)(words).empty();
  return fits ? "" : "'" + words + "' is neither a node-ID, 1...127, nor the word unconfigured";
}

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  Options options;
  std::string node_id = std::to_string(options.node_id);
  CLI::App app(description, "lexican-demo-node");
  app.footer(footer);
  app.get_formatter()->column_width(36);
  app.set_version_flag("--version", text("%d.%d.%d", CO_VER_MAJOR, CO_VER_MINOR, CO_VER_BUILD));
  auto* const bus = app.add_option("-i,--bus", options.bus, bus_help)->type_name("BUS");
  app.add_option("--node-id", node_id, "Node-ID of the clock until LSS stores another, 1...127, or unconfigured")
      ->type_name("N")
      ->check(CLI::Validator(node_id_fault, ""))
      ->capture_default_str();
  auto* const serve = app.add_flag("--serve", options.serve, "Run the node alone, and show what it receives and sends");
  app.add_option("--storage", options.storage, "File in which the clock stores node-ID, name and time zone [RAM]")
      ->type_name("FILE")
      ->needs(serve);
  app.add_option("--serial", options.serial, "Serial number, 1018h:4 [one for each storage file, else a random one]")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max()).description(""))
      ->needs(serve);
  app.add_flag("--virtual", options.virtual_bus, "Use the built-in bus, even if there is a vcan0")
      ->excludes(bus)
      ->excludes(serve);
  auto* const quiet = app.add_flag("--quiet", options.quiet, "Show no frames");
  app.add_flag("--every-frame", options.every_frame, "Show all frames of long transfers")->excludes(quiet);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {options, false, app.exit(error) == 0 ? exit_ok : exit_usage};
  }
  options.unconfigured = node_id == unconfigured;
  options.node_id = options.unconfigured ? options.node_id : static_cast<std::uint8_t>(std::stoul(node_id, nullptr, 0));
  return {options, true, exit_ok};
}

}  // namespace lexican::demo
