// SPDX-License-Identifier: Apache-2.0
/// \file zynqmp_model.hpp
/// A model of the registers of a ZynqMP CAN controller (UG1085), for behaviour that QEMU does not model: the duration
/// of frames, lost arbitration, error states, and queues that a software reset clears.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "co_if_can.h"
#include "registers.hpp"

namespace test {

class ZynqmpModel {
 public:
  using Words = std::array<std::uint32_t, 4>;  // identifier, DLC, data 1, data 2
  using Register = co::zynqmp::Register;

  ZynqmpModel();
  ~ZynqmpModel();
  ZynqmpModel(const ZynqmpModel&) = delete;
  ZynqmpModel& operator=(const ZynqmpModel&) = delete;

  /// Returns the value for CO_CAN_ZYNQMP.Registers.
  volatile std::uint32_t* address() { return memory_.data(); }

  // Functions for the processor.
  std::uint32_t read(Register which);
  void write(Register which, std::uint32_t value);
  bool interrupt() const { return (isr_ & ier_) != 0; }
  std::uint32_t enabled() const { return ier_; }
  std::uint32_t value(Register which) const { return memory_[static_cast<unsigned>(which) / 4]; }

  // Functions for the bus.
  /// Starts a frame if the bus is free and a frame is waiting; the high priority buffer has precedence.
  void begin();
  void win();   ///< completes the transmission of the started frame
  void lose();  ///< makes the started frame lose the arbitration; it waits again
  void receive(const Words& words);
  void receive(std::uint32_t identifier);  ///< 11 bits, no data
  void set_state(std::uint32_t state) { state_ = state; }
  void go_bus_off();

  std::vector<std::uint32_t> sent;  ///< 11-bit identifiers in the order of the bus
  std::vector<Words> sent_words;
  std::size_t waiting() const { return fifo_.size() + (first_ ? 1 : 0); }
  bool on_bus() const { return on_; }

  /// Level-triggered: an interrupt whose cause persists is raised again at once when it is cleared.
  bool level = true;
  /// Reads of the status register until a reset, or switching the filters off, is complete. Earlier writes are ignored.
  unsigned latency = 0;
  /// A frame is sent as soon as its last word is written, before the next access.
  bool instant = false;
  /// Called in each access, to simulate an interrupt.
  std::function<void()> between;

 private:
  void soft_reset();
  void enter_configuration();
  bool passes(std::uint32_t word) const;
  void put(Register which, std::uint32_t value);
  void raise_lasting();

  std::array<std::uint32_t, 64> memory_{};
  std::deque<Words> fifo_;
  std::optional<Words> first_;
  struct OnWire {
    Words words;
    bool is_first;
  };
  std::optional<OnWire> wire_;
  std::deque<Words> received_;
  std::uint32_t isr_ = 0;
  std::uint32_t ier_ = 0;
  std::uint32_t state_ = co::zynqmp::error_active;
  bool on_ = false;
  unsigned resetting_ = 0;
  unsigned filtering_ = 0;
};

}  // namespace test
