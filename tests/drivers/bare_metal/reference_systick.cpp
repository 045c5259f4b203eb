// SPDX-License-Identifier: Apache-2.0
// Reference for SysTick: a CMSDK timer, a 32-bit down counter.
#include "board.hpp"
#include "reference.hpp"

namespace test {
namespace {

volatile std::uint32_t& at(std::uint32_t offset) {
  return *reinterpret_cast<volatile std::uint32_t*>(board::timer_base + offset);
}

constexpr std::uint32_t control = 0x0;
constexpr std::uint32_t value = 0x4;
constexpr std::uint32_t reload = 0x8;

}  // namespace

void start_reference() {
  at(reload) = UINT32_MAX;
  at(value) = UINT32_MAX;
  at(control) = 1;
}

void look_at_reference() {}

std::uint32_t reference_ticks() { return (UINT32_MAX - at(value)) / (board::timer_hz / 1000000); }

}  // namespace test
