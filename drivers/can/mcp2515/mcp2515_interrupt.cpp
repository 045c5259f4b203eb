// SPDX-License-Identifier: Apache-2.0
// The work of the interrupt, and the use of SPI by loop and interrupt.
#include "../controller.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

constexpr unsigned service_rounds = 8;

// In bus-off, the controller begins the recovery itself. Configuration mode prevents it. [MCP2515, 6.6]
void begin_bus_off(Can& can) {
  report::count_bus_off(can.State.Report);
  if (can.Recovery == CO_CAN_RECOVERY_BY_APPLICATION) {
    can.State.IsBusOff = 1;
    write_control(can, CO_MCP2515_MODE_CONFIGURATION | CO_MCP2515_ABAT);
  }
}

// Stores the error flags and counts the events that they show.
void store_flags(Can& can, std::uint8_t flags) {
  for (unsigned bit = CO_MCP2515_EFLG_RX0OVR; bit <= CO_MCP2515_EFLG_RX1OVR; bit <<= 1) {
    if ((flags & bit) != 0) {
      report::count_overflow(can.State.Report);
    }
  }
  if ((flags & overflows) != 0) {
    clear_bits(can, CO_MCP2515_EFLG, flags & overflows);
  }
  const bool was_bus_off = is_bus_off(can);
  report::store(can.State.Flags, static_cast<std::uint8_t>(flags & ~overflows));
  if (!was_bus_off && is_bus_off(can)) {
    begin_bus_off(can);
  }
}

// Acknowledges the error interrupt, which the data sheet allows to persist while a flag is set: it is disabled then,
// and Read reads the flags. [MCP2515, 7.7]
void acknowledge_error(Can& can) {
  const std::uint8_t before = can.State.Flags;
  clear_bits(can, CO_MCP2515_CANINTF, CO_MCP2515_INT_ERR);
  const TwoRegisters now = read_two(can, CO_MCP2515_CANINTF);
  store_flags(can, now.second);
  if ((now.first & CO_MCP2515_INT_ERR) != 0 && can.State.Flags != 0 && can.State.Flags == before) {
    enable_interrupts(can, all_interrupts & ~CO_MCP2515_INT_ERR);
  }
}

void unmask_error(Can& can) {
  if (can.State.Enabled != all_interrupts && can.State.Flags == 0) {
    clear_bits(can, CO_MCP2515_CANINTF, CO_MCP2515_INT_ERR);
    enable_interrupts(can, all_interrupts);
  }
}

// Does what the flags of the controller require, at most one round. Returns false if there is nothing to do.
bool service_once(Can& can) {
  const TwoRegisters flags = read_two(can, CO_MCP2515_CANINTF);
  if (flags.first == no_answer) {
    return false;
  }
  const unsigned enabled = can.State.Enabled;
  store_flags(can, flags.second);
  unmask_error(can);
  receive(can, flags.first);
  if ((flags.first & transmit_interrupts) != 0) {
    request_waiting(can);
  }
  if ((flags.first & enabled & CO_MCP2515_INT_ERR) != 0) {
    acknowledge_error(can);
  }
  return (flags.first & enabled) != 0;
}

// Does the work of the interrupts that have occurred while SPI was in use.
void work_off(const CO_MCP2515_BUS& bus) {
  for (Can* can = bus.First; can != nullptr; can = can->State.Next) {
    if (report::load(can->State.IsMissed) != 0) {
      report::store(can->State.IsMissed, std::uint8_t{0});
      service(*can);
    }
  }
}

bool has_notes(const CO_MCP2515_BUS& bus) {
  for (const Can* can = bus.First; can != nullptr; can = can->State.Next) {
    if (report::load(can->State.IsMissed) != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

void service(Can& can) {
  if (can.State.Rate == nullptr) {
    return;
  }
  bool is_unfinished = true;
  for (unsigned n = 0; n < service_rounds && is_unfinished; ++n) {
    is_unfinished = service_once(can) && has_interrupt(can);
  }
  can.State.IsUnfinished = is_unfinished ? 1 : 0;
}

void hold(CO_MCP2515_BUS& bus) { report::store(bus.Holds, static_cast<std::uint8_t>(bus.Holds + 1)); }

void release(CO_MCP2515_BUS& bus) {
  report::store(bus.Holds, static_cast<std::uint8_t>(bus.Holds - 1));
  while (bus.Holds == 0 && has_notes(bus)) {
    hold(bus);
    work_off(bus);
    report::store(bus.Holds, static_cast<std::uint8_t>(bus.Holds - 1));
  }
}

}  // namespace co::mcp2515
