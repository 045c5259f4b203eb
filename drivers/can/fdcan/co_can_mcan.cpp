// SPDX-License-Identifier: Apache-2.0
#include "co_can_fdcan.h"
#include "fdcan.hpp"

namespace co::fdcan {
namespace {

// Configurable message memory, with the filters first, like in the fixed one. Elements have 8 bytes of data.
// [M_CAN, 2.4.1: Message RAM configuration]
struct Configurable {
  using Registers = CO_MCAN_REGISTERS;

  static constexpr std::uint32_t received = CO_MCAN_IR_RF0N;
  static constexpr std::uint32_t receive_lost = CO_MCAN_IR_RF0L;
  static constexpr std::uint32_t sent = CO_MCAN_IR_TC;
  static constexpr std::uint32_t cancelled = CO_MCAN_IR_TCF;
  static constexpr std::uint32_t passive = CO_MCAN_IR_EP;
  static constexpr std::uint32_t bus_off = CO_MCAN_IR_BO;

  static constexpr unsigned element_words = 4;
  static unsigned words(const CO_CAN_FDCAN& can) { return CO_CAN_MCAN_RAM_WORDS(can.FifoNum); }
  static unsigned transmit_offset(const CO_CAN_FDCAN& can) {
    return CO_FDCAN_RAM_RECEIVE + element_words * can.FifoNum;
  }

  // Returns the start address and the number of elements of a section.
  static std::uint32_t section(const CO_CAN_FDCAN& can, unsigned word, std::uint32_t number) {
    constexpr std::uint32_t bytes_of_word = 4;
    return bytes_of_word * (can.RamOffset + word) | (number << CO_MCAN_NUMBER_SHIFT);
  }

  static void configure(const CO_CAN_FDCAN& can) {
    Registers& regs = *static_cast<Registers*>(can.Registers);
    write(regs.Gfc, CO_FDCAN_GFC_REJECT_STANDARD | CO_FDCAN_GFC_REJECT_EXTENDED);
    write(regs.Sidfc, section(can, 0, standard_filters));
    write(regs.Xidfc, section(can, standard_filters, extended_filters));
    write(regs.Rxf0c, section(can, CO_FDCAN_RAM_RECEIVE, can.FifoNum));
    write(regs.Rxbc, 0);
    write(regs.Rxf1c, 0);
    write(regs.Rxesc, 0);
    write(regs.Txbc,
          section(can, transmit_offset(can), 0) | (CO_CAN_MAILBOXES << CO_MCAN_TXBC_TFQS_SHIFT) | CO_MCAN_TXBC_TFQM);
    write(regs.Txesc, 0);
    write(regs.Txefc, 0);
  }
};

}  // namespace
}  // namespace co::fdcan

using namespace co;

const CO_IF_CAN_DRV_EX McanCanDriver = controller::Driver<fdcan::Port<fdcan::Configurable>>::table;

extern "C" void COCanMcanInterrupt(CO_CAN_FDCAN* can) {
  ASSERT_PTR(can);
  fdcan::Port<fdcan::Configurable>::interrupt(*can);
}
