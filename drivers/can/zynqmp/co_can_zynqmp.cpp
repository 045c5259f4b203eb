// SPDX-License-Identifier: Apache-2.0
#include "co_can_zynqmp.h"

#include <cstdint>

#include "../atomic.hpp"
#include "acceptance.hpp"
#include "registers.hpp"

namespace co::zynqmp {
namespace {

constexpr std::int16_t one_frame = sizeof(CO_IF_FRM);  // result of Read and Send: a frame was read or accepted
constexpr unsigned fifo_frames = 64;
constexpr std::uint8_t bytes_at_most = 8;
constexpr std::uint32_t standard_ids = 0x7FF;

// Interrupts that are always enabled. all_sent is added only while a frame is being sent: it stays set while the FIFO
// is empty.
constexpr std::uint32_t always_enabled = received | receive_overflow | bus_off | woken;

// Error classes and details for the node, in the coding of SocketCAN.
constexpr std::uint32_t class_controller = 0x004;
constexpr std::uint32_t class_bus_off = 0x040;
constexpr std::uint32_t class_restarted = 0x100;
constexpr std::uint8_t detail_overflow = 0x01;
constexpr std::uint8_t detail_passive = 0x30;
constexpr std::uint8_t detail_active = 0x40;

// Values of CO_CAN_ZYNQMP.Told: the state last reported to the node.
constexpr std::uint8_t state_active = 0;
constexpr std::uint8_t state_passive = 1;
constexpr std::uint8_t state_bus_off = 2;

CO_CAN_ZYNQMP& controller(void* ctx) { return *static_cast<CO_CAN_ZYNQMP*>(ctx); }

using atomic::load;
using atomic::store;

bool is_set(const CO_CAN_ZYNQMP& can, std::uint32_t interrupt) {
  return (read(can.Registers, Register::interrupt_status) & interrupt) != 0;
}

void clear_interrupts(const CO_CAN_ZYNQMP& can, std::uint32_t interrupts) {
  write(can.Registers, Register::interrupt_clear, interrupts);
}

// Receiving -----------------------------------------------------------------------------------------------------------

void unpack(std::uint32_t word, std::uint8_t* bytes) {
  for (unsigned n = 0; n < 4; ++n) {
    bytes[n] = static_cast<std::uint8_t>(word >> (24 - 8 * n));
  }
}

std::uint32_t identifier_of(std::uint32_t word) {
  const std::uint32_t base = word >> standard_shift;
  if ((word & extended) == 0) {
    return base | ((word & standard_remote) != 0 ? CO_IF_FRM_RTR : 0);
  }
  const std::uint32_t extension = (word >> extension_shift) & 0x3FFFF;
  return (base << 18) | extension | CO_IF_FRM_EXT | ((word & extended_remote) != 0 ? CO_IF_FRM_RTR : 0);
}

CO_IF_FRM read_frame(const CO_CAN_ZYNQMP& can) {
  CO_IF_FRM frame{};
  frame.Identifier = identifier_of(read(can.Registers, Register::receive));
  const std::uint32_t dlc = read(can.Registers, Register::receive + 1) >> dlc_shift;
  frame.DLC = dlc < bytes_at_most ? static_cast<std::uint8_t>(dlc) : bytes_at_most;
  unpack(read(can.Registers, Register::receive + 2), frame.Data);
  unpack(read(can.Registers, Register::receive + 3), frame.Data + 4);
  return frame;
}

// Joining and leaving the bus -----------------------------------------------------------------------------------------

const CO_CAN_ZYNQMP_RATE* find_rate(const CO_CAN_ZYNQMP& can, std::uint32_t baud) {
  for (unsigned n = 0; n < can.RateNum; ++n) {
    if (can.Rates[n].Baud == baud) {
      return &can.Rates[n];
    }
  }
  return nullptr;
}

// Disables the interrupts. The read-back ensures that the write has reached the controller, so none follows.
void disable_interrupts(CO_CAN_ZYNQMP& can) {
  write(can.Registers, Register::interrupt_enable, 0);
  static_cast<void>(read(can.Registers, Register::interrupt_enable));
}

// Waits until a status bit has a value; for changes that take a few clock periods of the controller.
void await_status(const CO_CAN_ZYNQMP& can, std::uint32_t bit, std::uint32_t value) {
  for (unsigned reads = 1000; reads != 0 && (read(can.Registers, Register::status) & bit) != value;) {
    --reads;
  }
}

// Resets the controller, which then is in configuration mode with its interrupts disabled.
void leave_bus(CO_CAN_ZYNQMP& can) {
  disable_interrupts(can);
  write(can.Registers, Register::software_reset, soft_reset);
  await_status(can, is_configuring, is_configuring);
  can.Rate = nullptr;
}

// Discards received frames and counters. The interrupts must be disabled.
void discard_received(CO_CAN_ZYNQMP& can) {
  for (unsigned n = 0; n < fifo_frames && is_set(can, received); ++n) {
    static_cast<void>(read_frame(can));
    clear_interrupts(can, received);
  }
  clear_interrupts(can, receive_overflow);
  static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
  can.Overflows = 0;
  can.ReportedLost = 0;
}

// Enables the interrupts, with all_sent only while a frame is being sent.
void enable_interrupts(const CO_CAN_ZYNQMP& can) {
  write(can.Registers, Register::interrupt_enable, can.IsSending != 0 ? always_enabled | all_sent : always_enabled);
}

void set_filters(const CO_CAN_ZYNQMP& can) {
  write(can.Registers, Register::filters_used, 0);  // all frames pass meanwhile
  await_status(can, filters_busy, 0);
  for (unsigned n = 0; n < can.FilterNum; ++n) {
    write(can.Registers, Register::filters + 2 * n, can.FilterMask[n]);
    write(can.Registers, Register::filters + (2 * n + 1), can.FilterId[n]);
  }
  write(can.Registers, Register::filters_used, (1U << can.FilterNum) - 1);
}

void join_bus(CO_CAN_ZYNQMP& can, const CO_CAN_ZYNQMP_RATE& rate) {
  leave_bus(can);
  discard_received(can);
  can.Rate = &rate;
  can.IsBusOff = 0;
  can.IsSending = 0;
  write(can.Registers, Register::prescaler, rate.Prescaler);
  write(can.Registers, Register::bit_timing, rate.Timing);
  write(can.Registers, Register::mode_select, can.Loopback ? loopback_mode : 0);
  set_filters(can);
  enable_interrupts(can);
  write(can.Registers, Register::software_reset, can_enable);
}

// Sending -------------------------------------------------------------------------------------------------------------

std::uint32_t word_of(const CO_IF_FRM& frame) {
  const std::uint32_t id = frame.Identifier & CO_IF_FRM_ID;
  const bool remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  // Truncated to 11 bits a longer identifier would be another message, at worst an NMT command.
  if ((frame.Identifier & CO_IF_FRM_EXT) == 0 && id <= standard_ids) {
    return (id << standard_shift) | (remote ? standard_remote : 0);
  }
  return identifier_word(id | CO_IF_FRM_EXT) | standard_remote | (remote ? extended_remote : 0);
}

// Returns four bytes as a word, the first byte in the highest bits.
std::uint32_t word_at(const std::uint8_t* bytes) {
  return (std::uint32_t{bytes[0]} << 24) | (std::uint32_t{bytes[1]} << 16) | (std::uint32_t{bytes[2]} << 8) | bytes[3];
}

void write_frame(const CO_CAN_ZYNQMP& can, Register buffer, std::uint32_t word, const CO_IF_FRM& frame) {
  const std::uint32_t dlc = frame.DLC < bytes_at_most ? frame.DLC : bytes_at_most;
  write(can.Registers, buffer, word);
  write(can.Registers, buffer + 1, dlc << dlc_shift);
  write(can.Registers, buffer + 2, word_at(frame.Data));
  write(can.Registers, buffer + 3, word_at(frame.Data + 4));
}

// Returns true while the FIFO contains a frame that has not been sent.
bool is_sending(CO_CAN_ZYNQMP& can) {
  if (can.IsSending != 0 && is_set(can, all_sent)) {
    can.IsSending = 0;
  }
  return can.IsSending != 0;
}

// Returns true for the boot-up message; no other message may precede it. [301:7.3.2.2.1]
bool is_boot_up(const CO_IF_FRM& frame) {
  constexpr std::uint32_t error_control = 0x700;
  return (frame.Identifier & ~0x7FU) == error_control && frame.DLC == 1 && frame.Data[0] == 0;
}

// Clears all_sent after writing the frame, because the flag is set again while the FIFO is empty. A frame that was sent
// before that is detected by the flag `sent`.
void send_by_fifo(CO_CAN_ZYNQMP& can, std::uint32_t word, const CO_IF_FRM& frame) {
  clear_interrupts(can, sent | arbitration_lost);
  write_frame(can, Register::transmit, word, frame);
  clear_interrupts(can, all_sent);
  if (is_set(can, sent)) {
    return;
  }
  can.IsSending = 1;
  can.SendingWord = is_boot_up(frame) ? 0 : word;
  enable_interrupts(can);
}

// Returns true if a frame with \a word may be sent first: the frame in the FIFO has lost the arbitration, so it is not
// on the bus now.
bool may_overtake(const CO_CAN_ZYNQMP& can, std::uint32_t word) {
  return word < can.SendingWord && is_set(can, arbitration_lost);
}

// Writes a frame to the high priority buffer, which the controller sends before the frame in the FIFO.
void send_by_priority_buffer(const CO_CAN_ZYNQMP& can, std::uint32_t word, const CO_IF_FRM& frame) {
  clear_interrupts(can, arbitration_lost);
  write_frame(can, Register::transmit_first, word, frame);
}

bool try_send(CO_CAN_ZYNQMP& can, const CO_IF_FRM& frame) {
  const std::uint32_t word = word_of(frame);
  if ((read(can.Registers, Register::status) & first_is_full) != 0) {
    return false;
  }
  if (!is_sending(can)) {
    send_by_fifo(can, word, frame);
    return true;
  }
  if (may_overtake(can, word)) {
    send_by_priority_buffer(can, word, frame);
    return true;
  }
  return false;
}

// Reporting -----------------------------------------------------------------------------------------------------------

std::uint8_t state_of(const CO_CAN_ZYNQMP& can) {
  if (load(can.IsBusOff) != 0) {
    return state_bus_off;
  }
  switch (read(can.Registers, Register::status) & error_state) {
    case error_active: return state_active;
    case error_passive: return state_passive;
    default: return can.ReportedState;  // on its way to the bus, or to bus-off
  }
}

// Adds a change of the controller's state to an error frame. The end of bus-off is a restart; a return from error
// passive is reported as error active.
void report_state(CO_CAN_ZYNQMP& can, std::uint8_t state, CO_IF_FRM& report) {
  if (state == state_bus_off) {
    report.Identifier |= class_bus_off;
  } else if (can.ReportedState == state_bus_off) {
    report.Identifier |= class_restarted;
  }
  if (state == state_passive || (state == state_active && can.ReportedState == state_passive)) {
    report.Identifier |= class_controller;
    report.Data[1] = state == state_passive ? detail_passive : detail_active;
  }
  can.ReportedState = state;
}

// Adds lost frames to an error frame; they are reported as an overflow.
void report_lost(CO_CAN_ZYNQMP& can, std::uint32_t lost, CO_IF_FRM& report) {
  report.Identifier |= class_controller;
  report.Data[1] = static_cast<std::uint8_t>(report.Data[1] | detail_overflow);
  can.ReportedLost = lost;
}

// Fills an error frame with the changes since the last report. Returns false if there are none.
bool report_events(CO_CAN_ZYNQMP& can, CO_IF_FRM& report) {
  const std::uint32_t lost = COCanZynqmpLost(&can);
  const std::uint8_t state = state_of(can);
  if (lost == can.ReportedLost && state == can.ReportedState) {
    return false;
  }
  report = {CO_IF_FRM_ERROR, {}, bytes_at_most};
  if (state != can.ReportedState) {
    report_state(can, state, report);
  }
  if (lost != can.ReportedLost) {
    report_lost(can, lost, report);
  }
  return true;
}

// The driver ----------------------------------------------------------------------------------------------------------

void init(void* ctx) { leave_bus(controller(ctx)); }

void enable(void* ctx, std::uint32_t baud) {
  CO_CAN_ZYNQMP& can = controller(ctx);
  const CO_CAN_ZYNQMP_RATE* const rate = find_rate(can, baud);
  can.ReportedState = state_active;
  if (rate == nullptr) {
    leave_bus(can);
    return;
  }
  join_bus(can, *rate);
}

std::int16_t read_driver(void* ctx, CO_IF_FRM* frm) {
  CO_CAN_ZYNQMP& can = controller(ctx);
  if (can.Rate == nullptr) {
    return 0;
  }
  return report_events(can, *frm) || CORingGet(&can.Received, frm) ? one_frame : std::int16_t{0};
}

std::int16_t send(void* ctx, const CO_IF_FRM* frm) {
  CO_CAN_ZYNQMP& can = controller(ctx);
  if (can.Rate == nullptr || load(can.IsBusOff) != 0) {
    return -1;
  }
  return try_send(can, *frm) ? one_frame : std::int16_t{0};
}

// Keeps the frame that is being sent: it may be the answer to the request that caused the reset.
void reset(void* ctx) {
  CO_CAN_ZYNQMP& can = controller(ctx);
  if (can.Rate == nullptr) {
    return;
  }
  if (can.IsBusOff != 0) {
    join_bus(can, *can.Rate);
    return;
  }
  disable_interrupts(can);
  discard_received(can);
  enable_interrupts(can);
}

void close(void* ctx) { leave_bus(controller(ctx)); }

void filter(void* ctx, const std::uint32_t* ids, std::uint16_t num) {
  CO_CAN_ZYNQMP& can = controller(ctx);
  const Acceptance acceptance = acceptance_of(ids, num);
  can.FilterNum = acceptance.number;
  for (unsigned n = 0; n < acceptance.number; ++n) {
    can.FilterMask[n] = acceptance.filter[n].mask;
    can.FilterId[n] = acceptance.filter[n].word;
  }
  if (can.Rate != nullptr) {
    set_filters(can);
  }
}

}  // namespace
}  // namespace co::zynqmp

using namespace co::zynqmp;

const CO_IF_CAN_DRV_EX ZynqmpCanDriver = {init, enable, read_driver, send, reset, close, filter, CONodeCanReport};

extern "C" {

void COCanZynqmpInterrupt(CO_CAN_ZYNQMP* can) {
  ASSERT_PTR(can);
  if (can->Rate == nullptr) {
    return;
  }
  for (unsigned n = 0; n < fifo_frames && is_set(*can, received); ++n) {
    const CO_IF_FRM frame = read_frame(*can);
    clear_interrupts(*can, received);
    static_cast<void>(CORingPut(&can->Received, &frame));
  }
  const std::uint32_t status = read(can->Registers, Register::interrupt_status);
  if ((status & receive_overflow) != 0) {
    store(can->Overflows, can->Overflows + 1);
  }
  if ((status & bus_off) != 0) {
    write(can->Registers, Register::software_reset, 0);  // no automatic recovery
    store(can->IsBusOff, std::uint8_t{1});
  }
  clear_interrupts(*can, status & (receive_overflow | bus_off | woken));
  if ((status & all_sent) != 0) {
    write(can->Registers, Register::interrupt_enable, always_enabled);
  }
}

void COCanZynqmpSleep(CO_CAN_ZYNQMP* can) {
  ASSERT_PTR(can);
  if (can->Rate != nullptr && load(can->IsBusOff) == 0 && !is_sending(*can)) {
    write(can->Registers, Register::mode_select, sleep_mode);
  }
}

uint32_t COCanZynqmpLost(const CO_CAN_ZYNQMP* can) {
  return can == nullptr ? 0 : load(can->Overflows) + CORingLost(&can->Received);
}

}  // extern "C"
