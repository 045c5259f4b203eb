// SPDX-License-Identifier: Apache-2.0
// Start-up code, clock, and semihosting of QEMU's mps2-an385.
#include "machine.hpp"

#include <algorithm>
#include <iterator>

#include "measure.hpp"
#include "operations.hpp"

extern "C" {

// Symbols of the linker script.
extern std::uint32_t data_source[], data_begin[], data_end[], bss_begin[], bss_end[], stack_top[];
extern void (*initialisers_begin[])();
extern void (*initialisers_end[])();

[[noreturn]] void reset();
[[noreturn]] void fault();
}

namespace bench {
namespace {

// Semihosting operations.
constexpr std::uint32_t write_text = 0x04;
constexpr std::uint32_t exit_extended = 0x20;
constexpr std::uint32_t application_exit = 0x20026;

volatile std::uint32_t& at(std::uint32_t address) { return *reinterpret_cast<volatile std::uint32_t*>(address); }

void ask_host(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void print(const char* text) { ask_host(write_text, text); }

void print(std::uint32_t number) {
  char digits[11] = {};
  char* first = std::end(digits) - 1;
  do {
    *--first = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  print(first);
}

constexpr std::uint32_t probe_instructions = 1000;
constexpr std::uint32_t probe_ticks = 25600;  // 2^10 ns for each instruction, 40 ns for each tick

template <unsigned instructions>
__attribute__((noinline)) void run_probe() {
  asm volatile(".rept %c0\nnop\n.endr\n" : : "i"(instructions));
}

template <unsigned instructions>
std::uint32_t ticks_of_probe() {
  const std::uint32_t begin = clock_of_machine();
  run_probe<instructions>();
  return ticks_between(begin, clock_of_machine());
}

// Converts ticks of \a units to tenths of an instruction per unit.
std::uint32_t tenths_of(std::uint64_t ticks, std::uint32_t units) {
  const std::uint64_t all = std::uint64_t{probe_ticks} * units;
  return static_cast<std::uint32_t>((ticks * probe_instructions * 10 + all / 2) / all);
}

// Returns the ticks of one reading of the clock.
std::uint32_t ticks_of_clock() {
  constexpr unsigned number = 16;
  Operation nothing;
  return static_cast<std::uint32_t>(ticks_of("clock", nothing, number) / number);
}

// Traps unaligned accesses where the code is for a Cortex-M0+, which faults on them.
void trap_unaligned_access() {
#if __ARM_ARCH == 6
  at(0xE000ED14u) = at(0xE000ED14u) | 1u << 3;
#endif
}

}  // namespace

void start_clock() {
  at(0xE000E014u) = 0x00FFFFFFu;
  at(0xE000E018u) = 0;
  at(0xE000E010u) = 5;  // enabled, clocked by the CPU
}

void check_clock() {
  const std::uint32_t ticks = ticks_of_probe<probe_instructions>() - ticks_of_probe<0>();
  constexpr std::uint32_t tolerance = probe_ticks / 200;  // instructions that the compiler may move
  if (ticks + tolerance < probe_ticks || ticks > probe_ticks + tolerance) {
    fail("clock", "1000 instructions do not take 25600 ticks: qemu-system-arm -icount shift=10");
  }
}

void report(const char* name, std::uint64_t ticks, std::uint32_t operations, std::uint32_t units) {
  const std::uint32_t tenths = tenths_of(ticks - std::uint64_t{operations} * ticks_of_clock(), units);
  print(name);
  print("\t");
  if (units == operations) {
    print((tenths + 5) / 10);
  } else {
    print(tenths / 10);
    print(".");
    print(tenths % 10);
  }
  print("\n");
}

void fail(const char* where, const char* what) {
  print(where);
  print(": ");
  print(what);
  print("\n");
  leave(1);
}

void leave(int status) {
  const std::uint32_t argument[] = {application_exit, static_cast<std::uint32_t>(status)};
  ask_host(exit_extended, argument);
  for (;;) {
  }
}

}  // namespace bench

extern "C" {

void reset() {
  std::copy(data_source, data_source + (data_end - data_begin), data_begin);
  std::fill(bss_begin, bss_end, 0u);
  bench::trap_unaligned_access();
  std::for_each(initialisers_begin, initialisers_end, [](void (*run)()) { run(); });
  bench::run_all();
  bench::leave(0);
}

void fault() { bench::fail("processor", "fault"); }

using Vector = void (*)();

__attribute__((section(".vectors"), used))
const Vector vectors[16] = {reinterpret_cast<Vector>(stack_top), reset, fault, fault, fault, fault, fault};
}
