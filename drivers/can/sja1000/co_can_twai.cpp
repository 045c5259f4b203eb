// SPDX-License-Identifier: Apache-2.0
#include "co_can_twai.h"

#include "sja1000.hpp"

namespace co::sja1000 {
namespace {

// TWAI of ESP32 and later ones. Reading the interrupt register may lose a transmit interrupt [Errata, 3.13.4]; the
// status, which is read after it, shows the result. So it is read once for each interrupt, which is triggered by level.
struct Twai {
  using Context = CO_CAN_TWAI;

  // The register layer of ESP-IDF (twai_ll.h) says so; the manuals do not.
  static constexpr bool abort_sets_complete = true;
  static constexpr unsigned interrupt_reads = 1;
  static constexpr std::uint32_t safe_frames = 62;  // of the 64 that make the FIFO fail

  static std::uint32_t read(const Context& can, std::uint8_t address) {
    return registers::read(can.Registers[address]);
  }
  static void write(const Context& can, std::uint8_t address, std::uint32_t value) {
    registers::write(can.Registers[address], value);
  }

  static void select_pelican(const Context& can) {
    write(can, CO_SJA1000_CDR, can.IsEsp32 ? CO_SJA1000_CDR_PELICAN | CO_SJA1000_CDR_OFF : CO_TWAI_CDR_OFF);
  }
  static void write_configuration(const Context& /*can*/) {}
  static std::uint32_t interrupts(const Context& can) { return can.IsEsp32 ? CO_SJA1000_IR_BEI : 0; }

  static bool has_errata(const Context& can) { return can.IsEsp32; }

  // Returns whether the frame in the receive buffer was overwritten by a part of a later one.
  static bool is_incomplete(const Context& can, std::uint32_t status) {
    return (status & (can.IsEsp32 ? CO_SJA1000_SR_DOS : CO_SJA1000_SR_MS)) != 0;
  }

  // [Errata, 3.13.11]
  static bool is_fifo_broken(const Context& can) {
    constexpr std::uint32_t frames = 0x7F;
    return can.IsEsp32 && (read(can, CO_SJA1000_RMC) & frames) >= safe_frames;
  }

  // Returns whether the data of the next received frame can be wrong. [Errata, 3.13.5] An error of the checksum is
  // detected at the acknowledge delimiter; the erratum does not name it, but ESP-IDF treats it likewise.
  static bool spoils_next_frame(const Context& can, std::uint32_t flags) {
    if (!can.IsEsp32 || (flags & CO_SJA1000_IR_BEI) == 0) {
      return false;
    }
    const std::uint32_t cause = read(can, CO_SJA1000_ECC);
    const std::uint32_t segment = cause & CO_SJA1000_ECC_SEGMENT;
    const bool is_checksum =
        segment == CO_SJA1000_ECC_ACK_DELIMITER && (cause & CO_SJA1000_ECC_TYPE) == CO_SJA1000_ECC_OTHER;
    const bool is_in_data = segment == CO_SJA1000_ECC_DATA || segment == CO_SJA1000_ECC_CRC;
    return (cause & CO_SJA1000_ECC_RECEIVING) != 0 && (is_in_data || is_checksum);
  }

  // A receive error counter above 0 prevents the end of the recovery. [Errata, 3.13.1] As in ESP-IDF, bus-off is caused
  // once more, which clears it: the counter may have changed before listen-only mode.
  static void clear_receive_errors(const Context& can) {
    if (!can.IsEsp32) {
      return;
    }
    write(can, CO_SJA1000_MOD, CO_SJA1000_MOD_RM | CO_SJA1000_MOD_LOM);
    write(can, CO_SJA1000_TXERR, 0);
    write(can, CO_SJA1000_TXERR, 255);
    static_cast<void>(read(can, CO_SJA1000_IR));
  }

  static void reset_peripheral(const Context& can) {
    if (can.ResetPeripheral != nullptr) {
      can.ResetPeripheral();
    }
  }
};

using TwaiDriver = controller::Driver<Port<Twai>>;

}  // namespace
}  // namespace co::sja1000

using namespace co;
using namespace co::sja1000;

const CO_IF_CAN_DRV_EX TwaiCanDriver = TwaiDriver::table;

extern "C" {

void COCanTwaiInterrupt(CO_CAN_TWAI* can) {
  ASSERT_PTR(can);
  Port<Twai>::interrupt(*can);
}

bool COCanTwaiHasFrames(const CO_CAN_TWAI* can) { return TwaiDriver::has_frames(can); }
uint32_t COCanTwaiLost(const CO_CAN_TWAI* can) { return TwaiDriver::lost(can); }
CO_CAN_ERROR_COUNTERS COCanTwaiErrors(const CO_CAN_TWAI* can) { return TwaiDriver::errors(can); }

}  // extern "C"
