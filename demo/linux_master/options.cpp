// SPDX-License-Identifier: Apache-2.0
#include "linux_master/options.hpp"

#include <CLI/CLI.hpp>

#include <string>

#include "co_ver.h"
#include "host/named_bus.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr const char* description =
    "Reads or writes an object of a CANopen node by SDO: expedited, segmented or block transfer.\n"
    "Or commands the NMT state of a node or of all nodes.\n"
    "Or finds nodes without node-ID and configures nodes by LSS.\n"
    "Or runs the tour: uses all services of a demo clock on the bus, and prints the frames.\n"
    "The master boots as a separate node. Only values read and nodes found are printed to standard output.\n"
    "Without --bus: uses vcan0 if there is one, else hub:demo, the bus of the demo node on this machine.";

constexpr const char* footer =
    "Index and sub-index are hexadecimal: 1008 and 0x1008 are the same; 0d4104 is decimal. Other numbers are decimal, "
    "or\n"
    "hexadecimal with 0x.\n"
    "Without --type, read shows 1008h, 1009h and 100Ah as text, 1, 2, 4 and 8 bytes of other objects as a number in "
    "hex\n"
    "digits, and anything else as a hex dump.\n"
    "bytes are written as pairs of hex digits: '01 02 FF'. A value that begins with - comes after --.\n"
    "\n"
    "Examples:\n"
    "  lexican-demo-master --node 1 --index 1008 read\n"
    "  lexican-demo-master --node 1 --index 2100 --sub 1 --type u8 write 12\n"
    "  lexican-demo-master --node 1 --index 2200 --file picture.rgb read\n"
    "  lexican-demo-master -i slcan:/dev/ttyACM0@500k --node 1 --index 1000 read\n"
    "  lexican-demo-master --node 1 nmt start\n"
    "  lexican-demo-master lss scan\n"
    "  lexican-demo-master lss set-id 5 --store\n"
    "\n"
    "Exit codes:\n"
    "    0  the object was transferred, the command was sent, the LSS services have succeeded, or all steps of the "
    "tour went\n"
    "       as expected\n"
    "    1  the transfer was aborted or refused, there was no answer, the value read does not fit the type, or a step "
    "of\n"
    "       the tour failed\n"
    "    2  wrong arguments, or the bus or the file cannot be used\n"
    "  130  Ctrl-C or SIGTERM has cancelled it";

constexpr const char* lss_footer =
    "Numbers are decimal, or hexadecimal with 0x. The options --bus, --own-id and --timeout can be used, too.\n"
    "\n"
    "Examples:\n"
    "  lexican-demo-master lss scan\n"
    "  lexican-demo-master lss set-id 5 --store\n"
    "  lexican-demo-master lss --address 0x319 0x1234 1 7 inquire";

void add_object_options(CLI::App& app, CommandLine& line) {
  Arguments& arguments = line.arguments;
  app.add_option("-i,--bus", line.bus, bus_help)->type_name("BUS");
  app.add_option("--node", arguments.node, "Node-ID of the remote node, 1...127, or all for nmt [tour: 1]")
      ->type_name("N");
  app.add_option("--own-id", arguments.own_id, "Node-ID of this master, 1...127 [127, or 126 if that is the node]")
      ->type_name("N");
  app.add_option("--index", arguments.index, "Index of the object, hexadecimal; decimal with 0d")->type_name("HEX");
  app.add_option("--sub", arguments.sub, "Sub-index of the object, in the same form")
      ->type_name("HEX")
      ->capture_default_str();
}

void add_value_options(CLI::App& app, CommandLine& line) {
  Arguments& arguments = line.arguments;
  app.add_option("--type", arguments.type, value_type_names)->type_name("TYPE");
  app.add_option("--file", arguments.file, "Read into, or write from this file; - is standard output or input")
      ->type_name("FILE");
  app.add_option("--timeout", arguments.timeout, "Time-out for each answer of the node, 0: none")
      ->type_name("MS")
      ->capture_default_str();
  app.add_option("--max", arguments.max, "Largest size of an object without fixed size")
      ->type_name("BYTES")
      ->capture_default_str();
  app.add_flag("--every-frame", line.every_frame, "tour: show all frames of long transfers");
  app.add_flag("--progress", line.progress, "Show the progress also if standard error is not a terminal");
}

void add_action(CLI::App& lss, CommandLine& line, LssAction action, const char* name, const char* purpose,
                const char* value) {
  CLI::App* const app = lss.add_subcommand(name, purpose);
  app->set_help_flag();
  app->callback([&line, action] { line.lss.action = action; });
  if (value[0] != 0) {
    app->add_option(value, line.lss.value, "The value")->type_name("")->required();
  }
}

void add_lss(CLI::App& app, CommandLine& line) {
  CLI::App* const lss = app.add_subcommand("lss", "Find nodes without node-ID, configure nodes");
  lss->fallthrough();
  lss->require_subcommand(1);
  lss->add_option("--address", line.lss.address,
                  "Vendor-ID, product code, revision and serial number [of a node without node-ID]")
      ->type_name("V P R S")
      ->expected(4);
  lss->add_option("--listen", line.lss.listen, "Time to wait for answers to each request that searches for nodes")
      ->type_name("MS")
      ->capture_default_str();
  lss->add_flag("--store", line.lss.store, "set-id and set-bitrate: the node also stores it");
  lss->footer(lss_footer);
  add_action(*lss, line, LssAction::scan, "scan", "Find all nodes without node-ID, print their LSS addresses", "");
  add_action(*lss, line, LssAction::set_id, "set-id", "Set the node-ID of a node, 1...127", "NODE-ID");
  add_action(*lss, line, LssAction::set_bit_rate, "set-bitrate", "Set the bit rate of a node, in bit/s", "BITRATE");
  add_action(*lss, line, LssAction::store, "store", "Make a node store node-ID and bit rate", "");
  add_action(*lss, line, LssAction::inquire, "inquire", "Print the LSS address and the node-ID of a node", "");
}

void add_nmt(CLI::App& app, CommandLine& line) {
  CLI::App* const nmt = app.add_subcommand("nmt", std::string("Command a node, or all: ") + nmt_command_names);
  nmt->set_help_flag();
  nmt->add_option("COMMAND", line.nmt.command, "The command")->type_name("")->required();
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
  app.fallthrough();  // options are also accepted after read and write
  app.require_subcommand(1);
  CLI::App* const read = app.add_subcommand("read", "Read the object");
  CLI::App* const write = app.add_subcommand("write", "Write the object");
  for (CLI::App* const transfer : {read, write}) {
    transfer->set_help_flag();  // one help text for all commands
    transfer->needs(app.get_option("--node"));
    transfer->needs(app.get_option("--index"));
  }
  write->add_option("VALUE", line.arguments.value, "The value")->type_name("");
  add_nmt(app, line);
  add_lss(app, line);
  CLI::App* const tour = app.add_subcommand("tour", "Use all services of a demo clock on the bus, print the frames");
  tour->set_help_flag();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    line.exit_code = app.exit(error) == 0 ? exit_ok : exit_usage;
    return line;
  }
  line.arguments.write = write->parsed();
  line.work = app.got_subcommand("lss")   ? Work::lss
              : app.got_subcommand("nmt") ? Work::nmt
              : tour->parsed()            ? Work::tour
                                          : Work::transfer;
  line.nmt.node = line.arguments.node;
  line.nmt.own_id = line.arguments.own_id;
  line.lss.timeout = line.arguments.timeout;
  line.lss.own_id = line.arguments.own_id.empty() ? line.lss.own_id : line.arguments.own_id;
  line.run = true;
  return line;
}

}  // namespace lexican::demo
