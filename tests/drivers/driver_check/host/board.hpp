// SPDX-License-Identifier: Apache-2.0
// A simulated board: a clock that counts ticks, a timer with a compare match, interrupts that can be disabled, a paced
// bus with two controllers, memories. Its drivers are correct; mutants.hpp has faulty variants of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "co_driver_check.h"
#include "co_nvm_ram.h"
#include "virtual_bus.hpp"

namespace check {

constexpr std::uint32_t frequency = 100000;  // ticks per second: a tick is 10 us
constexpr std::uint32_t late = 3;            // permitted latency of an interrupt in ticks

// The compare match of a free running counter, and the time of its interrupt.
struct Compare {
  std::uint64_t at = 0;
  bool armed = false;
  bool matched = false;
};

class Board {
 public:
  Board();

  std::uint64_t time = 0xFFFF0000;  // ticks
  std::uint32_t latency = 1;        // ticks until the interrupt is served
  bool locked = false;
  bool cyclic = false;  // an interrupt with every tick
  Compare compare;
  std::function<void()> interrupt;  // timer interrupt

  co::VirtualBus bus;
  co::VirtualBus::Port& port;
  co::VirtualBus::Port& peer;
  std::function<void()> each_turn;  // called in each step, for the rest of the simulation

  void step();
};

// Lines printed by the checks.
struct Report {
  std::vector<std::string> lines;
  [[nodiscard]] std::map<std::string, std::string> verdicts() const;  // verdict by name of the check
};

// Settings of a check that succeeds; a case changes some of them.
struct Setting {
  Setting();
  Board board;
  Report report;
  CO_IF_DRV plain = {};
  CO_NODE_EXT ext = {};
  CO_NODE_EXT peer = {};
  CO_DRIVER_CHECK check = {};
};

// Classic drivers, which use the board that was constructed last.
extern const CO_IF_CAN_DRV PlainCanDriver;
extern const CO_IF_TIMER_DRV PlainTimerDriver;  // delta driver
extern const CO_IF_NVM_DRV PlainNvmDriver;
constexpr std::uint32_t plain_nvm_size = 1000;

// A driver with a clock; its context argument is a Board.
extern const CO_IF_TIMER_DRV_EX ClockDriver;

// Simulated flash: the context argument of its driver.
struct Flash {
  std::vector<std::uint8_t> bytes = std::vector<std::uint8_t>(4096, 0);
  CO_NVM_SHAPE shape = {4096, 8, 512};
};
extern const CO_IF_NVM_DRV_EX FlashDriver;

}  // namespace check
