// SPDX-License-Identifier: Apache-2.0
/// \file program.hpp
/// Start-up code shared by the CPUs.
#pragma once

#include <cstdint>

#include "board.hpp"

namespace board {

inline volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// Initialises the variables and calls main(), whose result is the exit status.
[[noreturn]] void run_program();

/// Prints the place of a fault, or of an interrupt without a handler, and ends the program with status 99.
[[noreturn]] void report_fault(const char* what, std::uint32_t number, std::uint32_t address, std::uint32_t caller);

/// Requests an operation of semihosting.
std::uint32_t ask_host(std::uint32_t operation, const void* argument);

}  // namespace board
