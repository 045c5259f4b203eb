// SPDX-License-Identifier: Apache-2.0
/// \file program.hpp
/// Implements the functions of a board on Linux, for the test runner of the boards.
#pragma once

#include <cstdint>

namespace board {

std::uint32_t ask_host(std::uint32_t operation, const void* argument);
void print(const char* text);
[[noreturn]] void leave(int status);

}  // namespace board
