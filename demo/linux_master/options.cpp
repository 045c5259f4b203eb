// SPDX-License-Identifier: Apache-2.0
#include "linux_master/options.hpp"

#include <CLI/CLI.hpp>

#include "co_ver.h"
#include "trace/text.hpp"

namespace demo {
namespace {

constexpr const char* description =
    "Reads or writes an object of a CANopen node by SDO: expedited, segmented or by block transfer.\n"
    "It boots on the bus as a node of its own. Standard output gets the value that was read and nothing else.";

constexpr const char* footer =
    "Without --type, read shows 1, 2, 4 and 8 bytes as a number in hex digits, others as a hex dump.\n"
    "bytes are written as pairs of hex digits: '01 02 FF'. A value that begins with - comes after --.\n"
    "\n"
    "Examples:\n"
    "  lexican-demo-master --node 1 --index 0x1008 --type string read\n"
    "  lexican-demo-master --node 1 --index 0x2100 --sub 1 --type u8 write 12\n"
    "  lexican-demo-master --node 1 --index 0x2200 --file picture.rgb read\n"
    "\n"
    "Exit codes:\n"
    "    0  the object was transferred\n"
    "    1  the transfer was aborted, there was no answer, or the value read is not of the type\n"
    "    2  wrong arguments, or the CAN interface or the file cannot be used\n"
    "  130  Ctrl-C or SIGTERM has cancelled the transfer";

void add_object_options(CLI::App& app, CommandLine& line) {
  Arguments& arguments = line.arguments;
  app.add_option("--can", line.interface, "SocketCAN interface to use")->type_name("IF")->capture_default_str();
  app.add_option("--node", arguments.node, "Node-ID of the node to talk to, 1...127")->type_name("N")->required();
  app.add_option("--own-id", arguments.own_id, "Node-ID of this master, 1...127 [127, or 126 if that is the node]")
      ->type_name("N");
  app.add_option("--index", arguments.index, "Index of the object, as 0x2100")->type_name("N")->required();
  app.add_option("--sub", arguments.sub, "Sub-index of the object")->type_name("N")->capture_default_str();
}

void add_value_options(CLI::App& app, CommandLine& line) {
  Arguments& arguments = line.arguments;
  app.add_option("--type", arguments.type, value_type_names)->type_name("TYPE");
  app.add_option("--file", arguments.file, "Read into, or write from this file; - is standard output or input")
      ->type_name("FILE");
  app.add_option("--timeout", arguments.timeout, "Time for each answer of the node, 0: for ever")
      ->type_name("MS")
      ->capture_default_str();
  app.add_option("--max", arguments.max, "Bytes that an object without a fixed size may have")
      ->type_name("BYTES")
      ->capture_default_str();
  app.add_flag("--progress", line.progress, "Show the progress also where standard error is no terminal");
}

}  // namespace

CommandLine read_command_line(int argc, char** argv) {
  CommandLine line;
  CLI::App app(description, "lexican-demo-master");
  app.footer(footer);
  app.get_formatter()->column_width(24);
  app.set_version_flag("--version", text("%d.%d.%d", CO_VER_MAJOR, CO_VER_MINOR, CO_VER_BUILD));
  add_object_options(app, line);
  add_value_options(app, line);
  app.fallthrough();  // options may come after read and write, too
  app.require_subcommand(1);
  app.add_subcommand("read", "Read the object")->set_help_flag();  // there is one help for all
  CLI::App* const write = app.add_subcommand("write", "Write the object");
  write->set_help_flag();
  write->add_option("VALUE", line.arguments.value, "The value")->type_name("");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    line.exit_code = app.exit(error) == 0 ? exit_ok : exit_usage;
    return line;
  }
  line.arguments.write = write->parsed();
  line.run = true;
  return line;
}

}  // namespace demo
