// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

extern "C" {
void board_start();
void board_trap();
void board_handle_trap(std::uint32_t cause, std::uint32_t address, std::uint32_t caller);
}

namespace board {
namespace {

constexpr std::uint32_t timer_cause = 0x80000007;
constexpr std::uint32_t external_cause = 0x8000000B;
constexpr std::uint32_t timer_enable = 1u << 7;      // bit of mie
constexpr std::uint32_t external_enable = 1u << 11;  // bit of mie

// Registers of the interrupt controller (PLIC).
constexpr std::uintptr_t priorities = interrupt_controller_base;
constexpr std::uintptr_t enabled_sources = interrupt_controller_base + 0x2000;
constexpr std::uintptr_t threshold = interrupt_controller_base + 0x200000;
constexpr std::uintptr_t claim = interrupt_controller_base + 0x200004;

void handle_external_interrupt() {
  const std::uint32_t source = at(claim);
  on_uart();
  at(claim) = source;
}

void unexpected(std::uint32_t cause) { report_fault("interrupt without a handler", cause, 0, 0); }

}  // namespace

[[gnu::weak]] void on_timer() { unexpected(timer_cause); }
[[gnu::weak]] void on_uart() { unexpected(external_cause); }

void enable_uart_interrupt() {
  for (const unsigned number : uart_interrupts) {
    at(priorities + 4 * number) = 1;
    at(enabled_sources) = at(enabled_sources) | 1u << number;
  }
  at(threshold) = 0;
  asm volatile("csrs mie, %0" : : "r"(external_enable));
}

void enable_timer_interrupt() { asm volatile("csrs mie, %0" : : "r"(timer_enable)); }

// Requests an operation of the host, which recognises it by these three instructions, uncompressed and in one page.
[[gnu::noinline]] std::uint32_t ask_host(std::uint32_t operation, const void* argument) {
  register std::uint32_t a0 asm("a0") = operation;
  register const void* a1 asm("a1") = argument;
  asm volatile(
      ".option push\n\t"
      ".option norvc\n\t"
      ".balign 16\n\t"
      "slli x0, x0, 0x1f\n\t"
      "ebreak\n\t"
      "srai x0, x0, 7\n\t"
      ".option pop"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
}

}  // namespace board

extern "C" {

[[gnu::naked, gnu::section(".board_start")]] void board_start() {
  asm volatile(
      ".option push\n\t"
      ".option norelax\n\t"
      "la gp, __global_pointer$\n\t"
      ".option pop\n\t"
      "la sp, board_stack_top\n\t"
      "la tp, board_thread_begin\n\t"
      "la t0, board_trap\n\t"
      "csrw mtvec, t0\n\t"
      "tail board_run");
}

[[noreturn]] void board_run() { board::run_program(); }

// Saves the registers that a function may change. The program uses no floating-point registers.
[[gnu::naked, gnu::aligned(4)]] void board_trap() {
  asm volatile(
      "addi sp, sp, -64\n\t"
      "sw ra, 0(sp)\n\tsw t0, 4(sp)\n\tsw t1, 8(sp)\n\tsw t2, 12(sp)\n\t"
      "sw a0, 16(sp)\n\tsw a1, 20(sp)\n\tsw a2, 24(sp)\n\tsw a3, 28(sp)\n\t"
      "sw a4, 32(sp)\n\tsw a5, 36(sp)\n\tsw a6, 40(sp)\n\tsw a7, 44(sp)\n\t"
      "sw t3, 48(sp)\n\tsw t4, 52(sp)\n\tsw t5, 56(sp)\n\tsw t6, 60(sp)\n\t"
      "csrr a0, mcause\n\tcsrr a1, mepc\n\tmv a2, ra\n\t"
      "call board_handle_trap\n\t"
      "lw ra, 0(sp)\n\tlw t0, 4(sp)\n\tlw t1, 8(sp)\n\tlw t2, 12(sp)\n\t"
      "lw a0, 16(sp)\n\tlw a1, 20(sp)\n\tlw a2, 24(sp)\n\tlw a3, 28(sp)\n\t"
      "lw a4, 32(sp)\n\tlw a5, 36(sp)\n\tlw a6, 40(sp)\n\tlw a7, 44(sp)\n\t"
      "lw t3, 48(sp)\n\tlw t4, 52(sp)\n\tlw t5, 56(sp)\n\tlw t6, 60(sp)\n\t"
      "addi sp, sp, 64\n\t"
      "mret");
}

void board_handle_trap(std::uint32_t cause, std::uint32_t address, std::uint32_t caller) {
  if (cause == board::timer_cause) {
    board::on_timer();
  } else if (cause == board::external_cause) {
    board::handle_external_interrupt();
  } else {
    board::report_fault("exception", cause, address, caller);
  }
}
}
