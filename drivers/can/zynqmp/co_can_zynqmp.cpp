// SPDX-License-Identifier: Apache-2.0
#include "co_can_zynqmp.h"

#include <cstdint>

#include "acceptance.hpp"
#include "registers.hpp"

namespace co::zynqmp {
namespace {

constexpr unsigned fifo_frames = 64;

// Interrupts that are always enabled. all_sent is added only while a frame is being sent: it stays set while the FIFO
// is empty.
constexpr std::uint32_t always_enabled = received | receive_overflow | bus_off | woken;

using report::load;
using report::State;
using report::store;

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
  frame.DLC = transmit::length_of(read(can.Registers, Register::receive + 1) >> dlc_shift);
  unpack(read(can.Registers, Register::receive + 2), frame.Data);
  unpack(read(can.Registers, Register::receive + 3), frame.Data + 4);
  return frame;
}

// Joining and leaving the bus -----------------------------------------------------------------------------------------

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

// Discards received frames and counters. The interrupts must be disabled.
void discard_received(CO_CAN_ZYNQMP& can) {
  for (unsigned n = 0; n < fifo_frames && is_set(can, received); ++n) {
    static_cast<void>(read_frame(can));
    clear_interrupts(can, received);
  }
  clear_interrupts(can, receive_overflow);
  static_cast<void>(CORingInit(&can.Received, can.Frames, can.FrameNum));
  report::restart(can.Report);
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

// Sending -------------------------------------------------------------------------------------------------------------

std::uint32_t word_of(const CO_IF_FRM& frame) {
  const std::uint32_t id = frame.Identifier & CO_IF_FRM_ID;
  const bool remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  if (!transmit::is_extended(frame.Identifier)) {
    return (id << standard_shift) | (remote ? standard_remote : 0);
  }
  return identifier_word(id | CO_IF_FRM_EXT) | standard_remote | (remote ? extended_remote : 0);
}

// Returns four bytes as a word, the first byte in the highest bits.
std::uint32_t word_at(const std::uint8_t* bytes) {
  return (std::uint32_t{bytes[0]} << 24) | (std::uint32_t{bytes[1]} << 16) | (std::uint32_t{bytes[2]} << 8) | bytes[3];
}

void write_frame(const CO_CAN_ZYNQMP& can, Register buffer, std::uint32_t word, const CO_IF_FRM& frame) {
  write(can.Registers, buffer, word);
  write(can.Registers, buffer + 1, std::uint32_t{transmit::length_of(frame)} << dlc_shift);
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
  can.SendingWord = transmit::is_boot_up(frame) ? 0 : word;
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

struct Port {
  using Can = CO_CAN_ZYNQMP;

  static bool is_bus_off(const Can& can) { return load(can.IsBusOff) != 0; }

  static State poll(const Can& can) {
    if (is_bus_off(can)) {
      return State::bus_off;
    }
    const std::uint32_t status = read(can.Registers, Register::status);
    if ((status & error_active) == 0) {
      return static_cast<State>(can.Report.Reported);  // on its way to the bus, or to bus-off
    }
    return static_cast<State>(status >> passive_shift & 1);
  }

  static CO_CAN_ERROR_COUNTERS errors(const Can& can) {
    const std::uint32_t errors = read(can.Registers, Register::error_counters);
    return {static_cast<std::uint8_t>(errors), static_cast<std::uint8_t>(errors >> receive_errors_shift)};
  }

  static bool accept(Can& can, const CO_IF_FRM& frame) {
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

  // Keeps the frame that is being sent: it may be the answer to the request that caused the reset.
  static void discard(Can& can) {
    disable_interrupts(can);
    discard_received(can);
    enable_interrupts(can);
  }

  // Resets the controller, which then is in configuration mode with its interrupts disabled.
  static void leave_bus(Can& can) {
    disable_interrupts(can);
    write(can.Registers, Register::software_reset, soft_reset);
    await_status(can, is_configuring, is_configuring);
    can.Rate = nullptr;
  }

  static void join_bus(Can& can, const CO_CAN_ZYNQMP_RATE& rate) {
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

  static void init(Can& can) { leave_bus(can); }

  static void filter(Can& can, const std::uint32_t* ids, std::uint16_t num) {
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
};

using Driver = controller::Driver<Port>;

}  // namespace
}  // namespace co::zynqmp

using namespace co;
using namespace co::zynqmp;

const CO_IF_CAN_DRV_EX ZynqmpCanDriver = zynqmp::Driver::table;

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
    report::count_overflow(can->Report);
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

uint32_t COCanZynqmpLost(const CO_CAN_ZYNQMP* can) { return zynqmp::Driver::lost(can); }

}  // extern "C"
