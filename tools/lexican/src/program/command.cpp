// SPDX-License-Identifier: Apache-2.0
#include "program/command.hpp"

namespace lexican::program {

bool send_command(host_bus::Bus& bus, BusHost& host, CO_NMT_COMMAND command, std::uint8_t node, Micros timeout) {
  const CO_IF_FRM frame = {0, {static_cast<std::uint8_t>(command), node}, 2};
  const Micros begin = host.now();
  while (!bus.send(frame)) {
    if (host.interrupted() || host.now() - begin >= timeout) {
      return false;
    }
    host.wait(millisecond);
    bus.receive();
  }
  return true;
}

int report_unsent(Session& session) {
  const std::string& fault = session.bus().fault();
  print_message("the NMT command was not sent: " + (fault.empty() ? "the bus accepts no frames" : fault));
  return session.is_interrupted() ? interrupted : bus_fault;
}

std::uint8_t wait_for_state(Session& session, std::uint8_t node, std::uint8_t state, Micros timeout) {
  const Micros begin = session.host().now();
  std::uint8_t last = no_state;
  while (last != state && session.host().now() - begin < timeout && !session.host().interrupted()) {
    while (const std::optional<host_bus::Entry> entry = session.bus().receive()) {
      if (last != state && entry->frame.Identifier == 0x700U + node && entry->frame.DLC == 1) {
        last = entry->frame.Data[0] & 0x7FU;
      }
    }
    if (last != state) {
      session.host().wait(10 * millisecond);
    }
  }
  return last;
}

}  // namespace lexican::program
