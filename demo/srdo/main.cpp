// SPDX-License-Identifier: Apache-2.0
// An emergency stop button, which transmits an SRDO, and a drive, which receives it: docs/srdo.md.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "host/exit.hpp"
#include "host/loop.hpp"
#include "host/named_bus.hpp"
#include "host/node.hpp"
#include "host/virtual_bus_host.hpp"
#include "lexican/dictionary.hpp"
#include "lexican/srdo.hpp"
#include "trace/text.hpp"

namespace lexican::demo {
namespace {

constexpr const char* description =
    "An emergency stop button and a drive on a bus inside the program, with simulated time. The button transmits its\n"
    "contacts as safety-relevant data (SRDO, EN 50325-5). It is pressed and released, then a contact fails. The "
    "program\n"
    "prints frames with new data, the states of both SRDOs, and the state of the motor.";
constexpr const char* footer =
    "Exit codes:\n"
    "    0  the motor has stopped as expected; --serve: ended by Ctrl-C or SIGTERM\n"
    "    1  the motor has not stopped as expected\n"
    "    2  wrong arguments, or the bus cannot be used";

constexpr std::uint8_t button_id = 4;
constexpr std::uint8_t drive_id = 5;

// Direction, refresh time or SCT in ms, SRVT in ms, COB-IDs; and the mapped objects.
constexpr co::srdo::Parameter transmitted = {CO_SRDO_TX, 50, 20, CO_SRDO_COBID1(button_id), CO_SRDO_COBID2(button_id)};
constexpr co::srdo::Parameter received = {CO_SRDO_RX, 100, 20, CO_SRDO_COBID1(button_id), CO_SRDO_COBID2(button_id)};
constexpr std::uint32_t mapping[] = {CO_LINK(0x2200, 1, 8), CO_LINK(0x2200, 2, 8)};

struct Variables {
  std::uint8_t error_register = 0;
  std::uint8_t configuration_valid = CO_SRDO_CONFIGURATION_VALID;  // 13FEh
  std::uint8_t stop = 0;                                           // 2200h:1, the first contact: 1 pressed
  std::uint8_t stop_inverse = 0xFF;                                // 2200h:2, the second contact
};
Variables button_variables;
Variables drive_variables;

template <const co::srdo::Parameter& Srdo, Variables& Own>
constexpr CO_OBJ od[] = {
    {CO_KEY(0x1000, 0, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},
    {CO_KEY(0x1001, 0, CO_OBJ____PR_), CO_TUNSIGNED8, (CO_DATA)(&Own.error_register)},
    {CO_KEY(0x1014, 0, CO_OBJ_DN__R_), CO_TEMCY_ID, (CO_DATA)(0x80)},
    {CO_KEY(0x1018, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(0)},  // your vendor-ID
    {CO_KEY(0x1301, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(6)},
    {CO_KEY(0x1301, 1, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(Srdo.direction)},
    {CO_KEY(0x1301, 2, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(Srdo.cycle)},
    {CO_KEY(0x1301, 3, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(Srdo.validation)},
    {CO_KEY(0x1301, 4, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(CO_SRDO_TYPE)},
    {CO_KEY(0x1301, 5, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(Srdo.plain_id)},
    {CO_KEY(0x1301, 6, CO_OBJ_D___R_), CO_TSRDO_COM, (CO_DATA)(Srdo.inverse_id)},
    {CO_KEY(0x1381, 0, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(2)},
    {CO_KEY(0x1381, 1, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(mapping[0])},
    {CO_KEY(0x1381, 2, CO_OBJ_D___R_), CO_TSRDO_MAP, (CO_DATA)(mapping[1])},
    {CO_KEY(0x13FE, 0, CO_OBJ_____RW), CO_TSRDO_VALID, (CO_DATA)(&Own.configuration_valid)},
    {CO_KEY(0x13FF, 0, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(1)},
    {CO_KEY(0x13FF, 1, CO_OBJ_D___R_), CO_TSRDO_SIGNATURE, (CO_DATA)(co::srdo::signature(Srdo, mapping))},
    {CO_KEY(0x2200, 1, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Own.stop)},
    {CO_KEY(0x2200, 2, CO_OBJ____PRW), CO_TUNSIGNED8, (CO_DATA)(&Own.stop_inverse)},
};
constexpr auto& button_od = od<transmitted, button_variables>;
constexpr auto& drive_od = od<received, drive_variables>;
CO_OD_CHECK(button_od);
CO_OD_CHECK(drive_od);
constexpr std::uint16_t entries = sizeof button_od / sizeof *button_od;

Host* host;
Micros begin;

void print(const std::string& line) {
  std::printf("%6.1f ms  %s\n", static_cast<double>(host->now() - begin) / millisecond, line.c_str());
  std::fflush(stdout);
}

void print_new_data(bool, const CO_IF_FRM& frame) {
  static std::map<std::uint32_t, std::string> last;
  const std::string bytes = hex_bytes(frame.Data, frame.DLC);
  if (std::exchange(last[frame.Identifier], bytes) != bytes) {
    print(text("%03X  %s", static_cast<unsigned>(frame.Identifier), bytes.c_str()));
  }
}

struct Step {
  const char* text;
  std::uint8_t stop;
  std::uint8_t stop_inverse;
};
constexpr Step steps[] = {
    {"the button is pressed", 1, 0xFE},
    {"the button is released", 0, 0xFF},
    {"the button is pressed, its second contact fails", 1, 0xFF},
};

int run(Host& bus, bool serve) {
  host = &bus;
  begin = host->now();
  const Table button_table = {const_cast<CO_OBJ*>(button_od), entries};
  Node button({button_id, host->device_can(), host->device_timer(), button_table});
  const Table drive_table = {const_cast<CO_OBJ*>(drive_od), entries};
  Node drive({drive_id, host->master_can(), host->master_timer(), drive_table, print_new_data, true});
  Loop loop(*host, {&button, &drive});
  bool motor_runs = false;
  unsigned starts = 0;
  Micros changed = 0;
  const auto control_motor = [&] {  // the safe state of the drive: motor off
    const bool may_run =
        COSrdoIsEstablished(&drive.stack()) && drive_variables.stop == 0 && drive_variables.stop_inverse == 0xFF;
    if (std::exchange(motor_runs, may_run) != may_run) {
      print(may_run ? "motor on" : "motor off");
      starts += may_run ? 1 : 0;
      changed = host->now();
    }
    return false;
  };
  CONodeStart(&button.stack());
  CONodeStart(&drive.stack());
  CONmtCommand(&drive.stack().Nmt, CO_NMT_COMMAND_START, 0);
  loop.run_until(control_motor, serve ? for_ever : 200 * millisecond);
  if (serve) {
    return exit_ok;
  }
  Micros pressed = 0;
  for (const Step& step : steps) {
    pressed = host->now();
    print(step.text);
    button_variables.stop = step.stop;
    button_variables.stop_inverse = step.stop_inverse;
    COSrdoRequest(&button.stack(), 0);  // COSrdoChange() reports an error
    loop.run_until(control_motor, 220 * millisecond);
  }
  if (loop.interrupted()) {
    std::fputs(host->bus_fault().c_str(), stderr);
    return exit_interrupted;
  }
  if (motor_runs) {
    print("the motor has not stopped");
    return exit_failed;
  }
  print(text("the motor was off %.1f ms after the fault", static_cast<double>(changed - pressed) / millisecond));
  return starts == 2 && COSrdoGetState(&drive.stack(), 0) == CO_SRDO_ERR_SCT ? exit_ok : exit_failed;
}

}  // namespace
}  // namespace lexican::demo

void COSrdoChange(CO_NODE* node, uint8_t, CO_SRDO_STATE state) {
  constexpr const char* states[] = {"deleted",
                                    "not operational",
                                    "initialising",
                                    "established",
                                    "error: wrong configuration",
                                    "error: frames not inverse",
                                    "error: objects not inverse",
                                    "error: inverse frame late",
                                    "error: no pair in time",
                                    "error: short frame",
                                    "error: frame not sent",
                                    "error: internal"};
  lexican::demo::print(std::string(CONmtGetNodeId(&node->Nmt) == lexican::demo::drive_id ? "drive:  " : "button: ") +
                       states[state]);
}

int main(int argc, char** argv) {
  std::string name;
  bool serve = false;
  CLI::App app(lexican::demo::description, "lexican-demo-srdo");
  app.footer(lexican::demo::footer);
  auto* const bus = app.add_option("-i,--bus", name, "Bus to use, in real time: can0, hub:NAME")->type_name("BUS");
  app.add_flag("--serve", serve, "Do not press the button; run until Ctrl-C")->needs(bus);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? lexican::exit_ok : lexican::exit_usage;
  }
  const lexican::Interruption interruption;
  if (name.empty()) {
    lexican::demo::VirtualBusHost host(interruption);
    return lexican::demo::run(host, serve);
  }
  const lexican::demo::NamedBus named = lexican::demo::open_bus(name, lexican::demo::Ends::both, interruption);
  if (named.host == nullptr) {
    std::fprintf(stderr, "%s\n", named.about.c_str());
    return lexican::exit_usage;
  }
  return lexican::demo::run(*named.host, serve);
}
