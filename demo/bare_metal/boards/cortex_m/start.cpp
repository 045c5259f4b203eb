// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

extern "C" {
extern std::uint32_t board_stack_top[];  // defined by sections.ld

[[noreturn]] void board_start();
void board_fault();
[[noreturn]] void board_report_fault(const std::uint32_t* frame, std::uint32_t exception);
}

namespace board {
namespace {

constexpr std::uintptr_t interrupt_set_enable = 0xE000E100;
constexpr std::uintptr_t configuration_and_control = 0xE000ED14;
constexpr std::uintptr_t coprocessor_access = 0xE000ED88;

#ifdef __ARM_FP
constexpr bool has_floating_point = true;
#else
constexpr bool has_floating_point = false;
#endif

void enable_interrupt(unsigned number) { at(interrupt_set_enable) = 1u << number; }

// Enables a fault on unaligned accesses, if the code is compiled without them (always for a Cortex-M0, else by
// -mno-unaligned-access): so it faults on every core.
void trap_unaligned_access() {
#ifndef __ARM_FEATURE_UNALIGNED
  at(configuration_and_control) = at(configuration_and_control) | 1u << 3;
#endif
}

void enable_floating_point_unit() {
  if constexpr (has_floating_point) {
    at(coprocessor_access) = at(coprocessor_access) | 0xFu << 20;
    asm volatile("dsb\n\tisb");
  }
}

}  // namespace

[[gnu::weak, gnu::naked]] void on_timer() { asm volatile("b board_fault"); }
[[gnu::weak, gnu::naked]] void on_uart() { asm volatile("b board_fault"); }

void enable_uart_interrupt() {
  for (const unsigned number : uart_interrupts) {
    enable_interrupt(number);
  }
}

void enable_timer_interrupt() { enable_interrupt(timer_interrupt); }

// Not inlined, so that all host requests have one address.
[[gnu::noinline]] std::uint32_t ask_host(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

}  // namespace board

extern "C" {

void board_start() {
  board::trap_unaligned_access();
  board::enable_floating_point_unit();
  board::run_program();
}

// Handles a fault. The CPU has pushed the registers r0 to r3, r12, lr, pc and xPSR.
[[gnu::naked]] void board_fault() {
  asm volatile(
      "mrs r0, msp\n\t"
      "mrs r1, ipsr\n\t"
      "ldr r2, =board_report_fault\n\t"
      "bx r2\n\t"
      ".ltorg");
}

void board_report_fault(const std::uint32_t* frame, std::uint32_t exception) {
  board::report_fault("exception", exception, frame[6], frame[5]);
}
}

namespace board {
namespace {

using Vector = void (*)();

constexpr unsigned first_interrupt = 16;
constexpr unsigned vectors_number = first_interrupt + 32;

struct Vectors {
  const std::uint32_t* stack;
  Vector exceptions[vectors_number - 1];
};

constexpr Vectors vectors() {
  Vectors table{board_stack_top, {}};
  for (Vector& vector : table.exceptions) {
    vector = board_fault;
  }
  table.exceptions[0] = board_start;
  table.exceptions[14] = on_timer;  // SysTick
  table.exceptions[first_interrupt - 1 + timer_interrupt] = on_timer;
  for (const unsigned number : uart_interrupts) {
    table.exceptions[first_interrupt - 1 + number] = on_uart;
  }
  return table;
}

[[gnu::section(".board_start"), gnu::used]] constexpr Vectors vector_table = vectors();

}  // namespace
}  // namespace board
