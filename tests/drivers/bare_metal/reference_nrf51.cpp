// SPDX-License-Identifier: Apache-2.0
// Reference for TIMER0 of the nRF51: SysTick, which QEMU's model has. Its 2^24 cycles of 16 MHz wrap after a second.
#include "board.hpp"
#include "reference.hpp"

namespace test {
namespace {

volatile std::uint32_t& at(std::uint32_t offset) {
  return *reinterpret_cast<volatile std::uint32_t*>(0xE000E010u + offset);
}

constexpr std::uint32_t control = 0x0;
constexpr std::uint32_t reload = 0x4;
constexpr std::uint32_t value = 0x8;
constexpr std::uint32_t longest = 1u << 24;

std::uint64_t cycles = 0;
std::uint32_t last = 0;

}  // namespace

void start_reference() {
  at(reload) = longest - 1;
  at(value) = 0;
  at(control) = 5;  // without interrupts
  while ((last = at(value)) == 0) {
  }
}

void look_at_reference() {
  const std::uint32_t now = at(value);
  cycles += (last - now) % longest;
  last = now;
}

std::uint32_t reference_ticks() {
  look_at_reference();
  return static_cast<std::uint32_t>(cycles / 16);
}

}  // namespace test
