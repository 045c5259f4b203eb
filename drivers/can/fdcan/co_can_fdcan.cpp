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

using FixedDriver = Driver<Fixed>;

}  // namespace
}  // namespace co::fdcan

using namespace co;
using namespace co::fdcan;

const CO_IF_CAN_DRV_EX FdcanCanDriver = {FixedDriver::init,   FixedDriver::enable, FixedDriver::read_driver,
                                         FixedDriver::send,   FixedDriver::reset,  FixedDriver::close,
                                         FixedDriver::filter, CONodeCanReport};

extern "C" {

void COCanFdcanInterrupt(CO_CAN_FDCAN* can) {
  ASSERT_PTR(can);
  FixedDriver::interrupt(*can);
}

bool COCanFdcanHasFrames(const CO_CAN_FDCAN* can) { return can != nullptr && CORingCount(&can->Received) != 0; }

uint32_t COCanFdcanLost(const CO_CAN_FDCAN* can) {
  return can == nullptr ? 0 : report::load(can->Report.Overflows) + CORingLost(&can->Received);
}

CO_CAN_ERROR_COUNTERS COCanFdcanErrors(const CO_CAN_FDCAN* can) {
  if (can == nullptr) {
    return {};
  }
  static_assert(offsetof(CO_FDCAN_REGISTERS, Ecr) == offsetof(CO_MCAN_REGISTERS, Ecr));
  const std::uint32_t errors = read(static_cast<const CO_FDCAN_REGISTERS*>(can->Registers)->Ecr);
  constexpr std::uint8_t passive = 128;
  const std::uint8_t received = (errors & CO_FDCAN_ECR_RP) != 0 ? passive : CO_FDCAN_ECR_REC(errors);
  return {CO_FDCAN_ECR_TEC(errors), received};
}

}  // extern "C"
