// SPDX-License-Identifier: Apache-2.0
#include "machine.hpp"

#include <cstddef>
#include <iterator>

#include "co_core.h"

extern "C" {
std::uint64_t ask_host(std::uint64_t operation, const void* argument);
void serve_interrupt();
}

namespace zynqmp {
namespace {

constexpr std::uintptr_t distributor = 0xF9010000;
constexpr std::uintptr_t cpu_interface = 0xF9020000;
constexpr unsigned interrupts = 96;
constexpr std::uint64_t first_tick = 0xFFF00000;  // the nodes' clock wraps after about a second

struct Handler {
  void (*call)(void* ctx);
  void* ctx;
};
Handler handlers[interrupts];

volatile std::uint32_t& word(std::uintptr_t address) { return *reinterpret_cast<volatile std::uint32_t*>(address); }
volatile std::uint8_t& byte(std::uintptr_t address) { return *reinterpret_cast<volatile std::uint8_t*>(address); }

std::uint64_t ticks_now() {
  std::uint64_t count = 0;
  asm volatile("isb\n mrs %0, cntpct_el0" : "=r"(count));
  return count;
}

std::uint64_t clock_frequency() {
  std::uint64_t frequency = 0;
  asm volatile("mrs %0, cntfrq_el0" : "=r"(frequency));
  return frequency;
}

GenericTimer* timers = nullptr;

std::uint64_t earliest() {
  std::uint64_t first = UINT64_MAX;
  for (const GenericTimer* timer = timers; timer != nullptr; timer = timer->next) {
    first = timer->due != 0 && timer->due < first ? timer->due : first;
  }
  return first;
}

// Sets the compare register to the earliest alarm. Must be called after each change of an alarm.
void set_compare() {
  const std::uint64_t first = earliest();
  const std::uint64_t frequency = clock_frequency();
  const std::uint64_t count = (first * frequency + ticks_per_second - 1) / ticks_per_second;
  const std::uint64_t control = first != UINT64_MAX ? 1 : 0;
  asm volatile("msr cntp_cval_el0, %0\n msr cntp_ctl_el0, %1\n isb" : : "r"(count), "r"(control));
}

void ring_due(void* /*ctx*/) {
  for (GenericTimer* timer = timers; timer != nullptr; timer = timer->next) {
    if (timer->due != 0 && timer->due <= micros()) {
      timer->due = 0;
      timer->on_alarm(timer->ctx);
    }
  }
  set_compare();
}

void init(void* ctx, std::uint32_t /*freq*/) {
  const Quiet quiet;
  static_cast<GenericTimer*>(ctx)->due = 0;
  set_compare();
}

std::uint32_t now(void* /*ctx*/) { return static_cast<std::uint32_t>(micros() + first_tick); }

void alarm(void* ctx, std::uint32_t ticks) {
  const Quiet quiet;
  static_cast<GenericTimer*>(ctx)->due = ticks != 0 ? micros() + ticks : 0;
  set_compare();
}

}  // namespace

void add(GenericTimer& timer) {
  constexpr unsigned physical_timer_interrupt = 30;
  {
    const Quiet quiet;
    timer.next = timers;
    timers = &timer;
  }
  serve(physical_timer_interrupt, ring_due, nullptr);
}

void serve(unsigned number, void (*handler)(void* ctx), void* ctx) {
  handlers[number] = {handler, ctx};
  word(distributor) = 3;
  byte(distributor + 0x400 + number) = 0x80;  // priority
  byte(distributor + 0x800 + number) = 1;     // CPU 0
  word(distributor + 0x100 + 4 * (number / 32)) = 1U << (number % 32);
  word(cpu_interface + 0x04) = 0xF8;
  word(cpu_interface) = 3;
  asm volatile("msr daifclr, #2");
}

Quiet::Quiet() : before_(0) { asm volatile("mrs %0, daif\n msr daifset, #2" : "=r"(before_) : : "memory"); }
Quiet::~Quiet() { asm volatile("msr daif, %0" : : "r"(before_) : "memory"); }

void wait_for_interrupt() { asm volatile("dsb sy\n wfi" : : : "memory"); }

std::uint64_t micros() { return ticks_now() * ticks_per_second / clock_frequency(); }

const CO_IF_TIMER_DRV_EX GenericTimerDriver = {init, now, alarm};

void print(const char* text) { ask_host(0x04, text); }

void print(std::uint64_t number) {
  char digits[21] = {};
  char* first = std::end(digits) - 1;
  do {
    *--first = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  print(first);
}

}  // namespace zynqmp

extern "C" {

void serve_interrupt() {
  using namespace zynqmp;
  const std::uint32_t acknowledged = word(cpu_interface + 0x0C);
  const unsigned number = acknowledged & 0x3FF;
  if (number < interrupts && handlers[number].call != nullptr) {
    handlers[number].call(handlers[number].ctx);
  }
  word(cpu_interface + 0x10) = acknowledged;
}

// Functions that the compiler calls implicitly.
void* memcpy(void* to, const void* from, std::size_t size) {
  auto* const target = static_cast<unsigned char*>(to);
  const auto* const source = static_cast<const unsigned char*>(from);
  for (std::size_t n = 0; n < size; ++n) {
    target[n] = source[n];
  }
  return to;
}

void* memmove(void* to, const void* from, std::size_t size) {
  auto* const target = static_cast<unsigned char*>(to);
  const auto* const source = static_cast<const unsigned char*>(from);
  if (target <= source) {
    return memcpy(to, from, size);
  }
  for (std::size_t n = size; n != 0; --n) {
    target[n - 1] = source[n - 1];
  }
  return to;
}

void* memset(void* to, int value, std::size_t size) {
  auto* const target = static_cast<unsigned char*>(to);
  for (std::size_t n = 0; n < size; ++n) {
    target[n] = static_cast<unsigned char>(value);
  }
  return to;
}

int memcmp(const void* a, const void* b, std::size_t size) {
  const auto* const first = static_cast<const unsigned char*>(a);
  const auto* const second = static_cast<const unsigned char*>(b);
  for (std::size_t n = 0; n < size; ++n) {
    if (first[n] != second[n]) {
      return first[n] < second[n] ? -1 : 1;
    }
  }
  return 0;
}
}
