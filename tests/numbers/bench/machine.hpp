// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// The machine that counts instructions. There are two, each with its clock.hpp and machine.cpp:
///
/// - mps2: a Cortex-M3 in QEMU (mps2-an385), whose clock advances by a fixed time with each instruction
///   (-icount shift=10). It also runs code for a Cortex-M0+, whose instructions are a subset.
/// - callgrind: the host under valgrind; the program marks the range to count.
#pragma once

#include <cstdint>

#include "clock.hpp"

namespace bench {

void start_clock();

/// Ends the program with status 1 unless the clock counts correctly.
void check_clock();

/// Prints a line: the name, a tabulator, and the instructions of each of the \a units of all
/// \a operations, with a decimal if the numbers differ. \a ticks: of all operations, including the readings of the
/// clock.
void report(const char* name, std::uint64_t ticks, std::uint32_t operations, std::uint32_t units);

/// Prints both texts and ends the program with status 1.
[[noreturn]] void fail(const char* where, const char* what);

/// Ends the program with \a status.
[[noreturn]] void leave(int status);

}  // namespace bench
