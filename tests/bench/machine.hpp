// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// The machine that counts: a Cortex-M3 in QEMU (mps2-an385), whose clock goes on by the same time with each
/// instruction (-icount shift=10). It runs the code of a Cortex-M0+, too, whose instructions are among its own.
#pragma once

#include <cstdint>

namespace bench {

/// Time in ticks of the SysTick timer, which counts down 24 bits: about 650000 instructions.
inline std::uint32_t clock_of_machine() { return *reinterpret_cast<volatile std::uint32_t*>(0xE000E018u); }

/// Ticks between two of these.
inline std::uint32_t ticks_between(std::uint32_t before, std::uint32_t after) { return (before - after) & 0x00FFFFFFu; }

void start_clock();

/// Ends everything, unless 1000 instructions take 25600 ticks.
void check_clock();

/// Ticks of a number of instructions, as instructions with one decimal: 123 is 12.3.
std::uint32_t tenths_of(std::uint64_t ticks, std::uint32_t operations);

void print(const char* text);
void print(std::uint32_t number);

/// Prints both and ends with status 1.
[[noreturn]] void fail(const char* where, const char* what);

/// Ends QEMU.
[[noreturn]] void leave(int status);

}  // namespace bench
