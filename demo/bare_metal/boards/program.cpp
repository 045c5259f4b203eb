// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <cstddef>

extern "C" {

int board_main() asm("main");  // alias, because C++ forbids calling main()

// Symbols defined by sections.ld.
extern std::uint32_t board_data_source[], board_data_begin[], board_data_end[], board_bss_begin[], board_bss_end[];
extern void (*board_initialisers_begin[])();
extern void (*board_initialisers_end[])();
}

namespace board {
namespace {

// Operations of semihosting.
constexpr std::uint32_t write_text = 0x04;
constexpr std::uint32_t exit_extended = 0x20;
constexpr std::uint32_t application_exit = 0x20026;

constexpr int status_of_fault = 99;

// Copies word by word: a function of the C library may need initialised variables.
void copy_variables() {
  const std::uint32_t* from = board_data_source;
  for (volatile std::uint32_t* to = board_data_begin; to != board_data_end; ++to) {
    *to = *from++;
  }
}

void clear_variables() {
  for (volatile std::uint32_t* to = board_bss_begin; to != board_bss_end; ++to) {
    *to = 0;
  }
}

}  // namespace

void run_program() {
  copy_variables();
  clear_variables();
  for (auto run = board_initialisers_begin; run != board_initialisers_end; ++run) {
    (*run)();
  }
  leave(board_main());
}

void print(const char* text) { ask_host(write_text, text); }

void print_hex(std::uint32_t number) {
  char digits[9] = {};
  for (std::size_t i = 0; i < 8; ++i) {
    digits[i] = "0123456789ABCDEF"[number >> (28 - 4 * i) & 0xFu];
  }
  print(digits);
}

void leave(int status) {
  const std::uint32_t argument[] = {application_exit, static_cast<std::uint32_t>(status)};
  ask_host(exit_extended, argument);
  for (;;) {
  }
}

void report_fault(const char* what, std::uint32_t number, std::uint32_t address, std::uint32_t caller) {
  print("\n");
  print(what);
  print(" ");
  print_hex(number);
  print(" at ");
  print_hex(address);
  print(", called from ");
  print_hex(caller);
  print("\n");
  leave(status_of_fault);
}

}  // namespace board
