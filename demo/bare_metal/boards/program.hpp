// SPDX-License-Identifier: Apache-2.0
/// \file program.hpp
/// What the start-up code of the CPUs shares.
#pragma once

#include <cstdint>

#include "board.hpp"

namespace board {

inline volatile std::uint32_t& at(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

/// From the first instruction in C++ on: brings variables to their values and calls main(), whose result is the status.
[[noreturn]] void run_program();

/// A fault, or an interrupt without a handler: says where, and ends with status 99.
[[noreturn]] void report_fault(const char* what, std::uint32_t number, std::uint32_t address, std::uint32_t caller);

/// An operation of semihosting.
std::uint32_t ask_host(std::uint32_t operation, const void* argument);

}  // namespace board
