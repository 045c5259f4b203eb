// SPDX-License-Identifier: Apache-2.0
#include "co_can_fdcan.h"

#include "fdcan.hpp"

namespace co::fdcan {
namespace {

// Fixed message memory. [RM0440, 44.3.3]
struct Fixed {
  using Registers = CO_FDCAN_REGISTERS;

  static constexpr std::uint32_t received = CO_FDCAN_IR_RF0N;
  static constexpr std::uint32_t receive_lost = CO_FDCAN_IR_RF0L;
  static constexpr std::uint32_t sent = CO_FDCAN_IR_TC;
  static constexpr std::uint32_t cancelled = CO_FDCAN_IR_TCF;
  static constexpr std::uint32_t passive = CO_FDCAN_IR_EP;
  static constexpr std::uint32_t bus_off = CO_FDCAN_IR_BO;

  static constexpr unsigned element_words = CO_FDCAN_ELEMENT_WORDS;
  static constexpr unsigned words(const CO_CAN_FDCAN& /*can*/) { return CO_FDCAN_RAM_WORDS; }
  static constexpr unsigned transmit_offset(const CO_CAN_FDCAN& /*can*/) { return CO_FDCAN_RAM_TRANSMIT; }

  static void configure(const CO_CAN_FDCAN& can) {
    Registers& regs = *static_cast<Registers*>(can.Registers);
    write(regs.Rxgfc, CO_FDCAN_GFC_REJECT_STANDARD | CO_FDCAN_GFC_REJECT_EXTENDED |
                          (standard_filters << CO_FDCAN_RXGFC_LSS_SHIFT) |
                          (extended_filters << CO_FDCAN_RXGFC_LSE_SHIFT));
    write(regs.Txbc, CO_FDCAN_TXBC_TFQM);
  }
};

static_assert(standard_filters + 2 * extended_filters == CO_FDCAN_RAM_RECEIVE);
static_assert(CO_FDCAN_RAM_TRANSMIT + CO_CAN_MAILBOXES * CO_FDCAN_ELEMENT_WORDS == CO_FDCAN_RAM_WORDS);

using Driver = controller::Driver<Port<Fixed>>;

}  // namespace
}  // namespace co::fdcan

using namespace co;

const CO_IF_CAN_DRV_EX FdcanCanDriver = fdcan::Driver::table;

extern "C" {

void COCanFdcanInterrupt(CO_CAN_FDCAN* can) {
  ASSERT_PTR(can);
  fdcan::Port<fdcan::Fixed>::interrupt(*can);
}

bool COCanFdcanHasFrames(const CO_CAN_FDCAN* can) { return fdcan::Driver::has_frames(can); }
uint32_t COCanFdcanLost(const CO_CAN_FDCAN* can) { return fdcan::Driver::lost(can); }

CO_CAN_ERROR_COUNTERS COCanFdcanErrors(const CO_CAN_FDCAN* can) {
  static_assert(offsetof(CO_FDCAN_REGISTERS, Ecr) == offsetof(CO_MCAN_REGISTERS, Ecr));
  return fdcan::Driver::errors(can);
}

}  // extern "C"
