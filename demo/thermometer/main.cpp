// SPDX-License-Identifier: Apache-2.0
// The thermometer on a simulated bus inside the program: three seconds of simulated time, in which the temperature
// rises. The frames on the bus are printed with their meaning. A program for a device uses drivers for its hardware
// instead: docs/porting.md.
#include <chrono>
#include <cstdio>
#include <cstring>

#include "thermometer/thermometer.hpp"
#include "trace/decode.hpp"
#include "trace/text.hpp"
#include "virtual_bus.hpp"
#include "virtual_clock.hpp"

using namespace std::chrono_literals;

namespace {

constexpr std::uint8_t node_id = 1;

constexpr const char* help =
    "Runs a small CANopen node, a thermometer, on a bus inside the program: three seconds of simulated time, in\n"
    "which its temperature rises above the limit. Each frame is printed with its time, CAN-ID, bytes and meaning.\n"
    "Its dictionary is written by hand, in demo/thermometer/thermometer.cpp: a starting point for your own.\n"
    "Usage: lexican-demo-thermometer [OPTIONS]\n"
    "\n"
    "Options:\n"
    "  -h,--help               Print this help message and exit\n"
    "\n"
    "Exit codes:\n"
    "    0  the node has worked as expected\n"
    "    1  the node has reported an error\n"
    "    2  wrong arguments\n";

const lexican::trace::Names names = {
    {0x2000, 0, "temperature in 0.1 degrees Celsius", lexican::trace::Form::decimal},
    {0x2001, 0, "limit of the temperature", lexican::trace::Form::decimal},
};
const lexican::trace::Mappings mappings = {{0x180, {{0x2000, 0, 2}}}};  // TPDO1

void show(co::VirtualClock& clock, const CO_IF_FRM& frame, lexican::trace::Decoder& decoder) {
  const std::string bytes = lexican::hex_bytes(frame.Data, frame.DLC);
  std::printf("%6lld ms  %03X  %-23s  %s\n", static_cast<long long>(clock.time() / 1ms),
              static_cast<unsigned>(frame.Identifier), bytes.c_str(), decoder.decode(frame).text.c_str());
}

/// Returns -1 without arguments, otherwise the exit code.
int answer_arguments(int argc, char** argv) {
  if (argc == 1) {
    return -1;
  }
  if (argc == 2 && (std::strcmp(argv[1], "--help") == 0 || std::strcmp(argv[1], "-h") == 0)) {
    std::fputs(help, stdout);
    return 0;
  }
  std::fprintf(stderr, "unknown argument '%s'; see --help\n", argv[1]);
  return 2;
}

// Prints the last error of the node. Returns false if there is none.
bool print_error(CO_NODE& node) {
  char text[CO_NODE_ERR_TEXT];
  if (CONodeGetErrText(&node, text, sizeof text) == CO_ERR_NONE) {
    return false;
  }
  std::fprintf(stderr, "%s\n", text);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (const int exit_code = answer_arguments(argc, argv); exit_code >= 0) {
    return exit_code;
  }
  CO_NODE node{};
  co::VirtualClock clock;
  co::VirtualTimer timer(clock, [&node] { COTmrService(&node.Tmr); });
  co::VirtualBus bus;
  lexican::trace::Decoder decoder(names, mappings);
  bus.set_trace([&](const co::VirtualBus::Traffic& traffic) { show(clock, traffic.frame, decoder); });

  CO_NODE_EXT drivers{};
  drivers.Can = &co::VirtualBusDriver;
  drivers.CanCtx = &bus.attach({"thermometer"});
  drivers.Timer = &co::VirtualTimerDriver;
  drivers.TimerCtx = &timer;
  lexican::demo::make_thermometer(node, drivers, node_id);
  CONodeStart(&node);

  bus.inject({0x000, {0x01, node_id}, 2});        // NMT: start
  bus.inject({0x601, {0x40, 0x01, 0x20, 0}, 8});  // SDO: what is the limit?
  for (std::int16_t tenths = 985; tenths <= 1015; ++tenths) {
    CONodeProcess(&node);
    COTmrProcess(&node.Tmr);
    if (tenths % 10 == 0) {
      lexican::demo::set_temperature(node, tenths);
    }
    clock.advance(clock.ticks(100ms));
  }
  const bool has_failed = print_error(node);
  CONodeStop(&node);
  return has_failed ? 1 : 0;
}
