// SPDX-License-Identifier: Apache-2.0
#include "co_can_sja1000.h"

#include <cstddef>

#include "sja1000.hpp"

namespace co::sja1000 {
namespace {

// The controller itself, whose registers have 8 bits. Its interrupt may be triggered by an edge: the interrupt register
// is read until it is 0.
struct Chip {
  using Context = CO_CAN_SJA1000;

  static constexpr bool abort_sets_complete = false;
  static constexpr unsigned interrupt_reads = 8;
  static constexpr std::uint8_t output = CO_SJA1000_OCR_PUSH_PULL | CO_SJA1000_OCR_NORMAL;
  static constexpr std::uint8_t divider = CO_SJA1000_CDR_PELICAN | CO_SJA1000_CDR_CBP | CO_SJA1000_CDR_OFF;

  static std::uint32_t read(const Context& can, std::uint8_t address) {
    return can.Access->Read(can.AccessCtx, address);
  }
  static void write(const Context& can, std::uint8_t address, std::uint32_t value) {
    can.Access->Write(can.AccessCtx, address, static_cast<std::uint8_t>(value));
  }

  static void select_pelican(const Context& can) {
    write(can, CO_SJA1000_CDR, can.ClockDivider != 0 ? can.ClockDivider : divider);
  }
  static void write_configuration(const Context& can) {
    write(can, CO_SJA1000_OCR, can.OutputControl != 0 ? can.OutputControl : output);
  }
  static constexpr std::uint32_t interrupts(const Context& /*can*/) { return CO_SJA1000_IR_DOI; }

  static constexpr bool has_errata(const Context& /*can*/) { return false; }
  static constexpr bool is_incomplete(const Context& /*can*/, std::uint32_t /*status*/) { return false; }
  static constexpr bool is_fifo_broken(const Context& /*can*/) { return false; }
  static constexpr bool spoils_next_frame(const Context& /*can*/, std::uint32_t /*flags*/) { return false; }
  static void clear_receive_errors(const Context& /*can*/) {}
  static void reset_peripheral(const Context& /*can*/) {}
};

using ChipDriver = controller::Driver<Port<Chip>>;

std::uint8_t read_memory(void* ctx, std::uint8_t address) {
  const CO_SJA1000_MEMORY& memory = *static_cast<const CO_SJA1000_MEMORY*>(ctx);
  return memory.Base[std::size_t{address} * memory.Distance];
}

void write_memory(void* ctx, std::uint8_t address, std::uint8_t value) {
  const CO_SJA1000_MEMORY& memory = *static_cast<const CO_SJA1000_MEMORY*>(ctx);
  memory.Base[std::size_t{address} * memory.Distance] = value;
}

}  // namespace
}  // namespace co::sja1000

using namespace co;
using namespace co::sja1000;

const CO_SJA1000_ACCESS Sja1000Memory = {read_memory, write_memory};

const CO_IF_CAN_DRV_EX Sja1000CanDriver = ChipDriver::table;

extern "C" {

void COCanSja1000Interrupt(CO_CAN_SJA1000* can) {
  ASSERT_PTR(can);
  Port<Chip>::interrupt(*can);
}

bool COCanSja1000HasFrames(const CO_CAN_SJA1000* can) { return ChipDriver::has_frames(can); }
uint32_t COCanSja1000Lost(const CO_CAN_SJA1000* can) { return ChipDriver::lost(can); }
CO_CAN_ERROR_COUNTERS COCanSja1000Errors(const CO_CAN_SJA1000* can) { return ChipDriver::errors(can); }

}  // extern "C"
