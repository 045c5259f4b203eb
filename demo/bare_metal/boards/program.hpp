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
/// \a number: of the exception (Cortex-M), or mcause (RISC-V); \a address: that of the interrupted instruction;
/// \a caller: return address of the interrupted function.
[[noreturn]] void report_fault(const char* what, std::uint32_t number, std::uint32_t address, std::uint32_t caller);

/// Requests an operation from the debugger or emulator (semihosting). Returns the host's result. \a argument: in the
/// format of the operation.
std::uint32_t ask_host(std::uint32_t operation, const void* argument);

}  // namespace board
