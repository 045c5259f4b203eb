// SPDX-License-Identifier: Apache-2.0
#include "co_can_mcp2515.h"

#include <cstdint>

#include "../controller.hpp"
#include "../transmit.hpp"
#include "mcp2515_controller.hpp"

namespace co::mcp2515 {
namespace {

using report::State;

constexpr std::int16_t one_frame = sizeof(CO_IF_FRM);

Can& controller(void* ctx) { return *static_cast<Can*>(ctx); }

// Joining and leaving the bus -----------------------------------------------------------------------------------------

const CO_CAN_MCP2515_RATE* find_rate(const Can& can, std::uint32_t baud) {
  for (unsigned n = 0; n < can.RateNum; ++n) {
    if (can.Rates[n].Baud == baud) {
      return &can.Rates[n];
    }
  }
  return nullptr;
}

void leave_bus(Can& can) {
  enter_configuration(can);
  enable_interrupts(can, 0);
  can.State.Rate = nullptr;
  transmit::forget(can.State.Transmit);
  report::store(can.State.IsMissed, std::uint8_t{0});
  can.State.IsUnfinished = 0;
}

// Empties receive buffers and queue. SPI is held, so no interrupt stores a frame meanwhile.
void discard_received(Can& can) {
  clear_bits(can, CO_MCP2515_CANINTF, receive_interrupts | CO_MCP2515_INT_ERR);
  clear_bits(can, CO_MCP2515_EFLG, overflows);
  static_cast<void>(CORingInit(&can.State.Received, can.Frames, can.FrameNum));
  report::restart(can.State.Report);
}

void join_bus(Can& can, const CO_CAN_MCP2515_RATE& rate) {
  leave_bus(can);
  write(can, CO_MCP2515_CANINTF, 0);
  discard_received(can);
  can.State.Flags = 0;
  can.State.IsBusOff = 0;
  if (write_configuration(can, rate)) {
    can.State.Rate = &rate;
    write_control(can, mode_on_bus(can));
  }
}

// Writes the filters on the bus, between two frames of this node.
void change_filters(Can& can) {
  service(can);
  if (is_bus_off(can)) {
    can.State.NeedsFilters = 1;
    return;
  }
  enter_configuration(can);
  static_cast<void>(write_configuration(can, *can.State.Rate));
  write_control(can, mode_on_bus(can));
  request_waiting(can);
}

// Reporting -----------------------------------------------------------------------------------------------------------

State state_of(const Can& can) {
  if (is_bus_off(can)) {
    return State::bus_off;
  }
  const bool is_passive = (can.State.Flags & (CO_MCP2515_EFLG_TXEP | CO_MCP2515_EFLG_RXEP)) != 0;
  return is_passive ? State::passive : State::active;
}

// Fills an error frame with the changes since the last report. Returns false if there are none. The error counters are
// read only if there is something to report.
bool report_events(Can& can, CO_IF_FRM& frame) {
  CO_CAN_REPORT& reported = can.State.Report;
  const State now = state_of(can);
  const std::uint32_t lost = COCanMcp2515Lost(&can);
  const bool is_quiet = static_cast<std::uint8_t>(now) == reported.Reported && lost == reported.ReportedLost &&
                        report::load(reported.BusOffs) == reported.SeenBusOffs;
  if (is_quiet) {
    return false;
  }
  const CO_CAN_ERROR_COUNTERS errors = COCanMcp2515Errors(&can);
  return report::take(reported, {report::observed(reported, now), errors, lost}, frame);
}

// Returns whether Read has to use SPI: for events without interrupt, or if the interrupt is not used.
bool needs_service(const Can& can) { return can.State.IsUnfinished != 0 || can.State.Flags != 0 || has_interrupt(can); }

bool needs_requests(const Can& can) {
  const CO_MCP2515_TRANSMIT& box = can.State.Transmit;
  return (box.Aborting | box.Dropped | box.DisplacedNum | can.State.IsAborting) != 0;
}

// Does the work of the loop.
void update(Can& can) {
  if (needs_service(can)) {
    const Exclusive exclusive(can);
    service(can);
  }
  if (needs_requests(can)) {
    const Exclusive exclusive(can);
    request_waiting(can);
  }
  if (can.State.NeedsFilters != 0 && !is_bus_off(can)) {
    const Exclusive exclusive(can);
    change_filters(can);
  }
}

// The driver ----------------------------------------------------------------------------------------------------------

void add_to_bus(Can& can) {
  CO_MCP2515_BUS& bus = bus_of(can);
  for (const Can* one = bus.First; one != nullptr; one = one->State.Next) {
    if (one == &can) {
      return;
    }
  }
  can.State.Next = bus.First;
  bus.First = &can;
}

void init(void* ctx) {
  Can& can = controller(ctx);
  const Exclusive exclusive(can);
  add_to_bus(can);
  leave_bus(can);
  reset_controller(can);
  discard_received(can);
  can.State.Filters = open_filters();
}

void enable(void* ctx, std::uint32_t baud) {
  Can& can = controller(ctx);
  const CO_CAN_MCP2515_RATE* const rate = find_rate(can, baud);
  can.State.Report.Reported = static_cast<std::uint8_t>(State::active);
  const Exclusive exclusive(can);
  if (rate == nullptr) {
    leave_bus(can);
    return;
  }
  join_bus(can, *rate);
}

std::int16_t read_driver(void* ctx, CO_IF_FRM* frm) {
  Can& can = controller(ctx);
  if (can.State.Rate == nullptr) {
    return 0;
  }
  update(can);
  return report_events(can, *frm) || CORingGet(&can.State.Received, frm) ? one_frame : std::int16_t{0};
}

std::int16_t send(void* ctx, const CO_IF_FRM* frm) {
  Can& can = controller(ctx);
  if (can.State.Rate == nullptr) {
    return -1;
  }
  const Exclusive exclusive(can);
  if ((can.State.Flags & CO_MCP2515_EFLG_TXBO) != 0) {
    service(can);
  }
  if (is_bus_off(can)) {
    return -1;
  }
  const bool is_accepted = accept(can, *frm);
  if (can.State.Transmit.DisplacedNum != 0) {
    request_waiting(can);
  }
  return is_accepted ? one_frame : std::int16_t{0};
}

void reset(void* ctx) {
  Can& can = controller(ctx);
  if (can.State.Rate == nullptr) {
    return;
  }
  const Exclusive exclusive(can);
  if (can.State.IsBusOff != 0) {
    join_bus(can, *can.State.Rate);
    return;
  }
  begin_drop(can);
  discard_received(can);
  request_waiting(can);
}

void close(void* ctx) {
  Can& can = controller(ctx);
  const Exclusive exclusive(can);
  leave_bus(can);
}

void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) {
  Can& can = controller(ctx);
  Filters& present = can.State.Filters;
  if (can.State.Rate != nullptr && !is_open(present) && all_pass(present, ids, num)) {
    return;
  }
  present = filters_of(ids, num);
  if (can.State.Rate != nullptr) {
    const Exclusive exclusive(can);
    change_filters(can);
  }
}

}  // namespace
}  // namespace co::mcp2515

using namespace co::mcp2515;

const CO_IF_CAN_DRV_EX Mcp2515CanDriver = {init, enable, read_driver, send, reset, close, filter, CONodeCanReport};

extern "C" {

void COCanMcp2515Interrupt(CO_CAN_MCP2515* can) {
  ASSERT_PTR(can);
  CO_MCP2515_BUS& bus = bus_of(*can);
  co::report::store(can->State.IsMissed, std::uint8_t{1});
  hold(bus);
  release(bus);
}

void COCanMcp2515Hold(CO_MCP2515_BUS* bus) {
  ASSERT_PTR(bus);
  hold(*bus);
}

void COCanMcp2515Release(CO_MCP2515_BUS* bus) {
  ASSERT_PTR(bus);
  release(*bus);
}

bool COCanMcp2515HasFrames(const CO_CAN_MCP2515* can) {
  return can != nullptr && CORingCount(&can->State.Received) != 0;
}

uint32_t COCanMcp2515Lost(const CO_CAN_MCP2515* can) {
  return can == nullptr ? 0 : co::report::load(can->State.Report.Overflows) + CORingLost(&can->State.Received);
}

CO_CAN_ERROR_COUNTERS COCanMcp2515Errors(CO_CAN_MCP2515* can) {
  if (can == nullptr) {
    return {};
  }
  const Exclusive exclusive(*can);
  const TwoRegisters counters = read_two(*can, CO_MCP2515_TEC);
  return {counters.first, counters.second};
}

}  // extern "C"
