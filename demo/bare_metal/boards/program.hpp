// SPDX-License-Identifier: Apache-2.0
/// \file program.hpp
/// Start-up code shared by the CPUs.
#pragma once

#include <cstdint>

#include "board.hpp"

namespace board {

/// Returns the 32-bit register at an address.
inline volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// Initialises the variables and calls main(), whose result is the exit status.
[[noreturn]] void run_program();

/// Prints a fault, or an interrupt without a handler, and ends the program with status 99. \a what: kind of the fault;
/// \a number: exception number (Cortex-M), or mcause (RISC-V); \a address: address of the interrupted instruction;
/// \a caller: return address of the interrupted function.
[[noreturn]] void report_fault(const char* what, std::uint32_t number, std::uint32_t address, std::uint32_t caller);

/// Requests a semihosting operation from the debugger or emulator, and returns its result. \a operation and
/// \a argument: as Arm's semihosting specification defines them.
std::uint32_t ask_host(std::uint32_t operation, const void* argument);

}  // namespace board
