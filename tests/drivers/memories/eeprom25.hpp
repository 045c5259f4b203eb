// SPDX-License-Identifier: Apache-2.0
/// \file eeprom25.hpp
/// EEPROM 25xx and FRAM on an SPI bus, byte by byte, written from the data sheets: Microchip DS22237C (25A512),
/// DS21204E (25LC040), DS22021F (25AA512), ST M95256, ON Semiconductor CAT25256 (status FFh in a write cycle), Ramtron
/// FM25640.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus_fault.hpp"
#include "co_nvm_eeprom_spi.h"
#include "power.hpp"

namespace test {

/// Properties of a memory.
struct Chip25 {
  const char* name;
  std::uint32_t capacity;
  std::uint32_t page;  ///< 0: FRAM
  std::uint8_t address_bytes;
  std::uint8_t write_time;  ///< ms
  bool shows_only_busy;     ///< the status is FFh in a write cycle
  bool keeps_latch;         ///< the write enable latch stays set after a write
};

class Eeprom25 {
 public:
  explicit Eeprom25(const Chip25& chip) : chip_(chip), bytes_(chip.capacity, 0xFF) {}

  Power power;
  BusFaults bus_fault;
  static bool shows(BusFault) { return false; }  ///< SPI has no acknowledgement
  std::uint32_t half = 1;                        ///< bytes of an access up to a fault in its middle
  std::vector<std::string> faults;               ///< violations of the rules of the memory and of the bus
  std::uint64_t now = 0;                         ///< microseconds; a byte takes one
  std::uint32_t write_time = 0;    ///< duration of a write cycle, microseconds; 0: 90 % of the longest one
  std::uint64_t cycles = 0;        ///< write cycles begun
  std::uint64_t bus_bytes = 0;     ///< bytes on the bus
  std::uint64_t lost_after = 0;    ///< number of bytes on the bus after which the device does not answer; 0: never
  std::uint8_t lost_level = 0xFF;  ///< byte that is read then
  bool is_protected = false;       ///< all blocks are protected

  void select(bool selected);
  std::uint8_t transfer(std::uint8_t byte);
  std::uint8_t shift_out();          ///< first part of transfer(): the answer, which does not depend on the byte
  void shift_in(std::uint8_t byte);  ///< second part of transfer()

  std::uint8_t& byte(std::uint32_t address) { return bytes_.at(address); }
  void begin_cycle() { busy_until_ = now + cycle_time(); }
  [[nodiscard]] bool is_busy() const { return now < busy_until_; }
  [[nodiscard]] bool is_enabled() const { return is_enabled_; }

  void* context();
  static const CO_IF_NVM_DRV_EX& driver() { return EepromSpiNvmDriver; }
  [[nodiscard]] bool is_used_well() const { return faults.empty() && !is_selected_; }

 private:
  [[nodiscard]] std::uint32_t cycle_time() const { return write_time != 0 ? write_time : chip_.write_time * 900U; }
  [[nodiscard]] bool is_lost() const {
    return power.is_off || (lost_after != 0 && bus_bytes > lost_after) || frame_bytes_ > heard_;
  }
  void begin_fault();
  std::uint8_t answer();
  void end_cycle();
  void decode(std::uint8_t byte);
  void receive(std::uint8_t byte);
  void deselect();
  void program();
  [[nodiscard]] std::uint8_t status() const;

  Chip25 chip_;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t busy_until_ = 0;
  bool is_in_cycle_ = false;
  bool is_enabled_ = false;
  bool is_selected_ = false;
  std::uint32_t index_ = 0;
  std::uint32_t frame_bytes_ = 0;     // bytes since the selection, the present one included
  std::uint32_t heard_ = UINT32_MAX;  // bytes after the selection that reach the device
  bool is_cut_executed_ = false;      // the device executes the bytes that have reached it
  bool is_deaf_ = false;              // the bytes of the device do not reach the CPU
  std::uint8_t fault_level_ = 0xFF;   // byte that is read instead
  std::uint8_t instruction_ = 0;
  bool is_ignored_ = false;
  std::uint32_t address_ = 0;
  std::uint32_t page_start_ = 0;
  std::uint32_t received_ = 0;
  std::vector<std::uint8_t> latched_;
  std::vector<bool> is_received_;
  CO_EEPROM_SPI context_{};
};

}  // namespace test
