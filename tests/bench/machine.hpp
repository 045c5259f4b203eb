// SPDX-License-Identifier: Apache-2.0
/// \file machine.hpp
/// The machine that counts instructions or cycles. There are two, each with its clock.hpp and machine.cpp:
///
/// - mps2: a Cortex-M3 in QEMU (mps2-an385), whose clock goes on by the same time with each instruction
///   (-icount shift=10). It runs the code of a Cortex-M0+, too, whose instructions are among its own.
/// - callgrind: the host under valgrind, which counts; the program marks the range to count.
#pragma once

#include <cstdint>

#include "clock.hpp"

namespace bench {

void start_clock();

/// Ends everything, unless the clock counts right.
void check_clock();

/// Prints a line: the name, a tabulator, and the instructions of one of \a units, which \a operations have been; with a
/// decimal if an operation is several. \a ticks: of all operations, with reading the clock.
void report(const char* name, std::uint64_t ticks, std::uint32_t operations, std::uint32_t units);

/// Prints both and ends with status 1.
[[noreturn]] void fail(const char* where, const char* what);

/// Ends the program.
[[noreturn]] void leave(int status);

}  // namespace bench
