// SPDX-License-Identifier: Apache-2.0
#include "co_can_mcp2515.h"

#include <cstdint>

#include "../controller.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

using report::State;

// Empties receive buffers and queue. SPI is held, so no interrupt stores a frame meanwhile.
void discard_received(Can& can) {
  clear_bits(can, CO_MCP2515_CANINTF, receive_interrupts | CO_MCP2515_INT_ERR);
  clear_bits(can, CO_MCP2515_EFLG, overflows);
  static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
  report::restart(can.Report);
}

// Writes the filters on the bus, between two frames of this node.
void change_filters(Can& can) {
  service(can);
  if (is_in_bus_off(can)) {
    can.NeedsFilters = 1;
    return;
  }
  enter_configuration(can);
  static_cast<void>(write_configuration(can, *can.Rate));
  write_control(can, mode_on_bus(can));
  request_waiting(can);
}

bool needs_requests(const Can& can) {
  const CO_MCP2515_TRANSMIT& box = can.Transmit;
  return (box.Aborting | box.Dropped | box.DisplacedNum | can.IsAborting) != 0;
}

struct Port {
  using Can = CO_CAN_MCP2515;

  // Reads the flags in bus-off: its end need not cause an interrupt.
  static bool is_bus_off(Can& can) {
    if ((can.Flags & CO_MCP2515_EFLG_TXBO) != 0) {
      const Exclusive exclusive(can);
      service(can);
    }
    return is_in_bus_off(can);
  }

  // Uses SPI only for events without interrupt, or if the interrupt is not used.
  static State poll(Can& can) {
    const Exclusive exclusive(can);
    if (can.IsUnfinished != 0 || can.Flags != 0 || has_interrupt(can)) {
      service(can);
    }
    if (needs_requests(can)) {
      request_waiting(can);
    }
    if (is_in_bus_off(can)) {
      return State::bus_off;
    }
    if (can.NeedsFilters != 0) {
      change_filters(can);
    }
    return (can.Flags & (CO_MCP2515_EFLG_TXEP | CO_MCP2515_EFLG_RXEP)) != 0 ? State::passive : State::active;
  }

  static CO_CAN_ERROR_COUNTERS errors(Can& can) {
    const Exclusive exclusive(can);
    const unsigned counters = read_two(can, CO_MCP2515_TEC);
    return {static_cast<std::uint8_t>(counters), static_cast<std::uint8_t>(counters >> 8)};
  }

  static bool accept(Can& can, const CO_IF_FRM& frame) {
    const Exclusive exclusive(can);
    return !is_in_bus_off(can) && mcp2515::accept(can, frame);
  }

  static void discard(Can& can) {
    const Exclusive exclusive(can);
    begin_drop(can);
    discard_received(can);
    request_waiting(can);
  }

  static void leave_bus(Can& can) {
    const Exclusive exclusive(can);
    enter_configuration(can);
    enable_interrupts(can, 0);
    can.Rate = nullptr;
    transmit::forget(can.Transmit);
    report::store(can.User.IsMissed, std::uint8_t{0});
    can.IsUnfinished = 0;
  }

  // An automatic recovery with the same bit rate continues.
  static void join_bus(Can& can, const CO_CAN_MCP2515_RATE& rate) {
    if (&rate == can.Rate && can.IsBusOff == 0 && is_in_bus_off(can)) {
      discard(can);
      return;
    }
    const Exclusive exclusive(can);
    leave_bus(can);
    write(can, CO_MCP2515_CANINTF, 0);
    discard_received(can);
    can.Flags = 0;
    can.IsBusOff = 0;
    if (write_configuration(can, rate)) {
      can.Rate = &rate;
      write_control(can, mode_on_bus(can));
    }
  }

  static void init(Can& can) {
    const Exclusive exclusive(can);
    spi::add_to_bus(can, [](void* ctx) { service(*static_cast<Can*>(ctx)); });
    leave_bus(can);
    reset_controller(can);
    discard_received(can);
    can.Filters = open_filters();
  }

  static void filter(Can& can, const std::uint32_t* ids, unsigned num) {
    if (can.Rate != nullptr && !is_open(can.Filters) && all_pass(can.Filters, ids, num)) {
      return;
    }
    can.Filters = filters_of(ids, num);
    if (can.Rate != nullptr) {
      const Exclusive exclusive(can);
      change_filters(can);
    }
  }
};

using Driver = controller::Driver<Port>;

}  // namespace
}  // namespace co::mcp2515

using namespace co;
using namespace co::mcp2515;

const CO_IF_CAN_DRV_EX Mcp2515CanDriver = mcp2515::Driver::table;

extern "C" {

void COCanMcp2515Interrupt(CO_CAN_MCP2515* can) {
  ASSERT_PTR(can);
  spi::interrupt(*can);
}

void COCanMcp2515Hold(CO_CAN_SPI_BUS* bus) {
  ASSERT_PTR(bus);
  spi::hold(*bus);
}

void COCanMcp2515Release(CO_CAN_SPI_BUS* bus) {
  ASSERT_PTR(bus);
  spi::release(*bus);
}

bool COCanMcp2515HasFrames(const CO_CAN_MCP2515* can) { return mcp2515::Driver::has_frames(can); }
uint32_t COCanMcp2515Lost(const CO_CAN_MCP2515* can) { return mcp2515::Driver::lost(can); }
CO_CAN_ERROR_COUNTERS COCanMcp2515Errors(CO_CAN_MCP2515* can) {
  return can == nullptr ? CO_CAN_ERROR_COUNTERS{} : Port::errors(*can);
}

}  // extern "C"
