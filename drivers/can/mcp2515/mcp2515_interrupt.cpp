// SPDX-License-Identifier: Apache-2.0
// The work of the interrupt.
#include "../controller.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

constexpr unsigned service_rounds = 8;

// In bus-off, the controller begins the recovery itself. Configuration mode prevents it. [MCP2515, 6.6]
void begin_bus_off(Can& can) {
  report::count_bus_off(can.Report);
  if (can.Recovery == CO_CAN_RECOVERY_BY_APPLICATION) {
    can.IsBusOff = 1;
    write_control(can, CO_MCP2515_MODE_CONFIGURATION | CO_MCP2515_ABAT);
  }
}

// Stores the error flags and counts the events that they show.
void store_flags(Can& can, unsigned flags) {
  for (unsigned bit = CO_MCP2515_EFLG_RX0OVR; bit <= CO_MCP2515_EFLG_RX1OVR; bit <<= 1) {
    if ((flags & bit) != 0) {
      report::count_overflow(can.Report);
    }
  }
  if ((flags & overflows) != 0) {
    clear_bits(can, CO_MCP2515_EFLG, flags & overflows);
  }
  const bool was_bus_off = is_in_bus_off(can);
  report::store(can.Flags, static_cast<std::uint8_t>(flags & ~unsigned{overflows}));
  if (!was_bus_off && is_in_bus_off(can)) {
    begin_bus_off(can);
  }
}

// Acknowledges the error interrupt, which the data sheet allows to persist while a flag is set: it is disabled then,
// and Read reads the flags. [MCP2515, 7.7]
void acknowledge_error(Can& can) {
  const unsigned before = can.Flags;
  clear_bits(can, CO_MCP2515_CANINTF, CO_MCP2515_INT_ERR);
  const unsigned now = read_two(can, CO_MCP2515_CANINTF);
  store_flags(can, now >> 8);
  if ((now & CO_MCP2515_INT_ERR) != 0 && can.Flags != 0 && can.Flags == before) {
    enable_interrupts(can, all_interrupts & ~CO_MCP2515_INT_ERR);
  }
}

void unmask_error(Can& can) {
  if (can.Enabled != all_interrupts && can.Flags == 0) {
    clear_bits(can, CO_MCP2515_CANINTF, CO_MCP2515_INT_ERR);
    enable_interrupts(can, all_interrupts);
  }
}

// Does what the flags of the controller require, at most one round. Returns false if there is nothing to do.
bool service_once(Can& can) {
  const unsigned registers = read_two(can, CO_MCP2515_CANINTF);
  const unsigned flags = registers & 0xFF;
  if (flags == no_answer) {
    return false;
  }
  const unsigned enabled = flags & can.Enabled;
  store_flags(can, registers >> 8);
  unmask_error(can);
  receive(can, flags);
  if ((flags & transmit_interrupts) != 0) {
    request_waiting(can);
  }
  if ((enabled & CO_MCP2515_INT_ERR) != 0) {
    acknowledge_error(can);
  }
  return enabled != 0;
}

}  // namespace

void service(Can& can) {
  if (can.Rate == nullptr) {
    return;
  }
  bool is_unfinished = true;
  for (unsigned n = 0; n < service_rounds && is_unfinished; ++n) {
    is_unfinished = service_once(can) && has_interrupt(can);
  }
  can.IsUnfinished = is_unfinished ? 1 : 0;
}

}  // namespace co::mcp2515
