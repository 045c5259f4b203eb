// SPDX-License-Identifier: Apache-2.0
// A heater on a CAN interface of Linux: heater vcan0 5. Its temperature approaches the setpoint.
#include <poll.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "heater_od.h"
#include "linux_timer.hpp"
#include "socketcan.hpp"

namespace {

constexpr std::uint32_t ticks_per_second = 1000000;

std::uint8_t sdo_buffer[CO_SSDO_N * CO_SDO_BUF_BYTE];
CO_TMR_MEM timer_of_heat;

// Moves the temperature towards the setpoint. heater_ram contains the variables of the dictionary; set() changes one
// through the dictionary, which triggers its TPDO.
void heat(void* node) {
  const int missing = heater_ram.setpoint - heater_ram.temperature;
  const int step = missing > 0 ? 1 : (missing < 0 ? -1 : 0);
  heater_objects::temperature(*static_cast<CO_NODE*>(node))
      .set(static_cast<std::int16_t>(heater_ram.temperature + step));
}

// Prints the last error of the node. Returns false if there is none.
bool print_error(CO_NODE& node) {
  char text[CO_NODE_ERR_TEXT];
  if (CONodeGetErrText(&node, text, sizeof text) == CO_ERR_NONE) {
    return false;
  }
  std::fprintf(stderr, "heater: %s\n", text);
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "heater INTERFACE NODE-ID\n");
    return 2;
  }
  co::SocketCan can;
  co::LinuxTimer timer;
  if (!can.open(arguments[1])) {
    std::fprintf(stderr, "heater: %s\n", can.error().c_str());
    return 1;
  }
  CO_NODE_EXT drivers = {};
  drivers.Size = sizeof drivers;
  drivers.Can = &co::SocketCanDriver;
  drivers.CanCtx = &can;
  drivers.Timer = &co::LinuxTimerDriver;
  drivers.TimerCtx = &timer;
  CO_NODE_SPEC spec = {};
  spec.NodeId = static_cast<std::uint8_t>(std::atoi(arguments[2]));
  spec.Dict = const_cast<CO_OBJ*>(heater_od);
  spec.DictLen = HEATER_OD_NUM;
  spec.TmrFreq = ticks_per_second;
  spec.TmrMem = &timer_of_heat;
  spec.TmrNum = 1;
  spec.SdoBuf = sdo_buffer;

  CO_NODE node = {};
  CONodeInitEx(&node, &spec, &drivers);
  CONodeStart(&node);
  COTmrCreate(&node.Tmr, 0, ticks_per_second / 10, heat, &node);
  if (print_error(node)) {
    return 1;
  }
  for (;;) {
    CONodeProcess(&node);
    COTmrService(&node.Tmr);
    COTmrProcess(&node.Tmr);
    pollfd wait{can.fd(), POLLIN, 0};
    poll(&wait, 1, timer.poll_timeout(CONodeNextDeadline(&node)));
  }
}
