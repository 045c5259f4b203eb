// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target with its inputs and prints, for each kind of frame, the most expensive one: name, tabulator,
// instructions, tabulator, the frame and the input that contains it.
//
// Only the instructions of CONodeProcess() count: drivers, callbacks, types and checks belong to the target, whose
// functions are instrumented at entry and exit. A frame during which the target has called the stack again does not
// count.
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "board.hpp"
#include "co_core.h"
#include "fuzz/fuzz.hpp"
#include "program.hpp"

// The inputs, packed by pack.py.
asm(".section .rodata.inputs, \"a\"\n"
    ".balign 4\n"
    ".global inputs_begin, inputs_end\n"
    "inputs_begin: .incbin \"" INPUTS
    "\"\n"
    "inputs_end: .byte 0\n"
    ".previous\n");

extern "C" {
extern const std::uint8_t inputs_begin[], inputs_end[];

void __real_CONodeProcess(CO_NODE* node);
void __wrap_CONodeProcess(CO_NODE* node);
void __cyg_profile_func_enter(void* function, void* caller);
void __cyg_profile_func_exit(void* function, void* caller);
}

namespace {

constexpr unsigned name_length = 12;  // characters of an input's name that pack.py keeps

constexpr std::uint32_t ticks_per_10_instructions = 256;  // -icount shift=10: 1024 ns each, at 25 MHz

enum class Kind { nmt, sync, emcy, srdo, pdo, sdo, error_control, lss, other, error_frame, after_others, count };

constexpr const char* names[] = {
    "NMT",
    "SYNC",
    "EMCY, TIME",
    "GFC, SRDO",
    "PDO",
    "SDO",
    "error control",
    "LSS",
    "other CAN-IDs",
    "CAN error frame",
    "any, and frames that had to wait are sent",
};

Kind kind_of(std::uint32_t identifier) {
  const std::uint32_t id = identifier & ~CO_IF_FRM_RTR;
  if ((identifier & CO_IF_FRM_ERROR) != 0) {
    return Kind::error_frame;
  }
  if (id > 0x7FFU) {
    return Kind::other;
  }
  switch (id >> 7) {
    case 0: return id == 0 ? Kind::nmt : id == 0x001 ? Kind::srdo : Kind::other;
    case 1: return id == 0x80 ? Kind::sync : Kind::emcy;
    case 2: return id == 0x100 ? Kind::emcy : Kind::srdo;
    case 11:
    case 12:
    case 13: return Kind::sdo;  // 680h…: another server of the target
    case 14: return Kind::error_control;
    case 15: return id == CO_LSS_RX_ID || id == CO_LSS_TX_ID ? Kind::lss : Kind::other;
    default: return Kind::pdo;
  }
}

struct Worst {
  std::uint32_t instructions;
  std::uint32_t identifier;
  std::uint8_t length;
  std::uint8_t data[8];
  CO_MODE mode;
  char input[name_length + 1];
};

Worst worst[static_cast<unsigned>(Kind::count)];
unsigned frames = 0;
char input[name_length + 1] = "";

bool counts = false;
unsigned depth = 0;  // nesting depth of the target's functions
std::uint32_t begin = 0;
std::uint32_t ticks = 0;
unsigned pauses = 0;
std::uint32_t ticks_of_pause = 0;

inline std::uint32_t clock() {
  constexpr std::uintptr_t value = board::timer_base + 4;  // a down counter
  return board::at(value);
}

void start_clock() {
  board::at(board::timer_base + 8) = 0xFFFFFFFFU;
  board::at(board::timer_base + 4) = 0xFFFFFFFFU;
  board::at(board::timer_base) = 1;
}

// Measures the instructions of entering and leaving a function of the target that are counted before and after the
// clock is read.
void calibrate() {
  constexpr unsigned number = 64;
  counts = true;
  ticks = 0;
  begin = clock();
  for (unsigned n = 0; n < number; ++n) {
    __cyg_profile_func_enter(nullptr, nullptr);
    __cyg_profile_func_exit(nullptr, nullptr);
  }
  ticks += begin - clock();
  counts = false;
  ticks_of_pause = ticks / number;
}

const char* name_of(CO_MODE mode) {
  switch (mode) {
    case CO_INIT: return "Initialisation";
    case CO_PREOP: return "Pre-operational";
    case CO_OPERATIONAL: return "Operational";
    case CO_STOP: return "Stopped";
    default: return "no state";
  }
}

void take(Kind kind, CO_MODE mode) {
  const std::uint32_t own = ticks - pauses * ticks_of_pause;
  const std::uint32_t instructions = own / ticks_per_10_instructions * 10 + own % ticks_per_10_instructions * 10 / 256;
  Worst& known = worst[static_cast<unsigned>(kind)];
  ++frames;
  if (instructions > known.instructions) {
    known = {instructions, fuzz::given.identifier, fuzz::given.length, {}, mode, {}};
    std::memcpy(known.data, fuzz::given.data, sizeof known.data);
    std::memcpy(known.input, input, sizeof known.input);
  }
}

void print(const char* name, const Worst& known) {
  const std::uint32_t id = known.identifier & ~CO_IF_FRM_RTR;
  std::printf("%s\t%lu\t`%0*lX#%s", name, static_cast<unsigned long>(known.instructions), id > 0x7FFU ? 8 : 3,
              static_cast<unsigned long>(id), id != known.identifier ? "R" : "");
  for (unsigned n = 0; id == known.identifier && n < known.length && n < sizeof known.data; ++n) {
    std::printf("%02X", known.data[n]);
  }
  std::printf("` in %s, " TARGET ": %s\n", name_of(known.mode), known.input);
}

}  // namespace

void __cyg_profile_func_enter(void*, void*) {
  if (counts && depth++ == 0) {
    ticks += begin - clock();
    ++pauses;
  }
}

void __cyg_profile_func_exit(void*, void*) {
  if (counts && --depth == 0) {
    begin = clock();
  }
}

void __wrap_CONodeProcess(CO_NODE* node) {
  if (counts || fuzz::given.data == nullptr) {
    __real_CONodeProcess(node);
    return;
  }
  const CO_MODE mode = node->Nmt.Mode;
  const bool has_waited = node->Transmit.Paused != 0 || node->TxQueue.Num != 0;
  const Kind kind = has_waited ? Kind::after_others : kind_of(fuzz::given.identifier);
  ticks = 0;
  pauses = 0;
  depth = 0;
  counts = true;
  begin = clock();
  __real_CONodeProcess(node);
  ticks += begin - clock();
  counts = false;
  if (fuzz::given.alone) {
    take(kind, mode);
  }
  fuzz::given = {};
}

int main() {
  start_clock();
  calibrate();
  unsigned number = 0;
  for (const std::uint8_t* next = inputs_begin; next != inputs_end; ++number) {
    std::uint32_t size = 0;
    std::memcpy(input, next, name_length);
    std::memcpy(&size, next + name_length, sizeof size);
    next += name_length + sizeof size;
    LLVMFuzzerTestOneInput(next, size);
    next += size;
  }
  for (unsigned n = 0; n < static_cast<unsigned>(Kind::count); ++n) {
    if (worst[n].instructions != 0) {
      print(names[n], worst[n]);
    }
  }
  std::printf("# %u inputs, %u frames\n", number, frames);
  return frames == 0 ? 1 : 0;
}
