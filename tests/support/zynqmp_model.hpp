// SPDX-License-Identifier: Apache-2.0
/// \file zynqmp_model.hpp
/// The registers of a ZynqMP CAN controller as the manual tells them (UG1085), for what QEMU's model does not show:
/// frames that take their time and lose the arbitration, error states, and what a software reset empties.
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

  /// For CO_CAN_ZYNQMP.Registers.
  volatile std::uint32_t* address() { return memory_.data(); }

  // The processor's side.
  std::uint32_t read(Register which);
  void write(Register which, std::uint32_t value);
  bool interrupt() const { return (isr_ & ier_) != 0; }
  std::uint32_t enabled() const { return ier_; }
  std::uint32_t value(Register which) const { return memory_[static_cast<unsigned>(which) / 4]; }

  // The bus's side.
  /// A frame begins where the bus is free and one waits: the high priority buffer's first.
  void begin();
  void win();   ///< the frame on the wire has been sent
  void lose();  ///< it has lost the arbitration, and waits again
  void receive(const Words& words);
  void receive(std::uint32_t identifier);  ///< 11 bits, no data
  void set_state(std::uint32_t state) { state_ = state; }
  void go_bus_off();

  std::vector<std::uint32_t> sent;  ///< 11-bit identifiers in the order of the bus
  std::vector<Words> sent_words;
  std::size_t waiting() const { return fifo_.size() + (first_ ? 1 : 0); }
  bool on_bus() const { return on_; }

  /// Do interrupts whose reason lasts come again at once when they are cleared?
  bool level = true;
  /// Readings of the status until a reset, or filters that are switched off, are so. What is written before is lost.
  unsigned latency = 0;
  /// The frame is sent between its last word and the next access.
  bool instant = false;
  /// Called in each access: an interrupt may come.
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
