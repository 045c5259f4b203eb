// SPDX-License-Identifier: Apache-2.0
/// \file eeprom24.hpp
/// EEPROM 24xx and FRAM on an I2C bus, byte by byte, written from the data sheets: Microchip DS20001203X (24LC256),
/// DS21703L (24LC16B), DS20001941L (24LC1025), Atmel AT24C256C, ST M24256 (write cycle only after a stop condition that
/// follows an acknowledged byte).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus_fault.hpp"
#include "co_nvm_eeprom_i2c.h"
#include "power.hpp"

namespace test {

/// Properties of a memory.
struct Chip24 {
  const char* name;
  std::uint32_t capacity;
  std::uint32_t page;  ///< 0: FRAM
  std::uint8_t device;
  std::uint8_t address_bytes;
  std::uint8_t block_shift;
  std::uint8_t write_time;  ///< ms
};

class Eeprom24 {
 public:
  explicit Eeprom24(const Chip24& chip) : chip_(chip), bytes_(chip.capacity, 0xFF) {}

  Power power;
  BusFaults bus_fault;
  /// Returns whether the bus reports a fault when it happens, or at the next access that tests the acknowledge.
  static bool shows(BusFault kind) { return kind != BusFault::reads_ff && kind != BusFault::half_reads_ff; }
  std::vector<std::string> faults;  ///< violations of the rules of the memory and of the bus
  std::uint64_t now = 0;            ///< microseconds
  std::uint32_t byte_time = 23;     ///< duration of a byte, microseconds (9 bits at 400 kbit/s)
  std::uint32_t write_time = 0;     ///< duration of a write cycle, microseconds; 0: 90 % of the longest one
  std::uint64_t cycles = 0;         ///< write cycles begun
  std::uint64_t bus_bytes = 0;      ///< bytes on the bus, device addresses included
  std::uint64_t lost_after = 0;     ///< number of bytes on the bus after which the device does not answer; 0: never
  std::uint64_t waits = 0;          ///< calls of Wait
  bool is_protected = false;        ///< protected by a pin as in memories of Microchip: acknowledged, no write cycle
  bool refuses_data = false;        ///< protected by a pin as in memories of ST: data are not acknowledged

  // The bus
  bool start(std::uint8_t control);
  bool put(std::uint8_t byte);
  std::uint8_t get(bool acknowledge);
  std::uint8_t shift_out();         ///< first part of get(): the byte
  void end_byte(bool acknowledge);  ///< second part of get(): the bit after it
  void stop();
  /// Ends a transfer without a stop condition after an acknowledged byte: the device writes nothing.
  void lose();

  std::uint8_t& byte(std::uint32_t address) { return bytes_.at(address); }
  /// Begins a write cycle without a change, as if the CPU had been reset after a write.
  void begin_cycle() { busy_until_ = now + cycle_time(); }
  [[nodiscard]] bool is_busy() const { return now < busy_until_; }

  void* context();
  static const CO_IF_NVM_DRV_EX& driver() { return EepromI2cNvmDriver; }
  [[nodiscard]] bool is_used_well() const { return faults.empty() && !is_selected_; }

 private:
  [[nodiscard]] bool answers();
  [[nodiscard]] std::uint32_t cycle_time() const { return write_time != 0 ? write_time : chip_.write_time * 900U; }
  [[nodiscard]] std::uint32_t block() const { return 1U << (8U * chip_.address_bytes); }
  void begin_data();
  void program();

  Chip24 chip_;
  std::vector<std::uint8_t> bytes_;
  std::uint64_t busy_until_ = 0;
  bool is_selected_ = false;
  bool is_reading_ = false;
  bool has_ended_ = false;  // the master has not acknowledged a byte that it has read
  unsigned address_left_ = 0;
  std::uint32_t block_ = 0;
  std::uint32_t address_ = 0;
  std::uint32_t page_start_ = 0;
  std::vector<std::uint8_t> latched_;  // page with the received bytes
  std::vector<bool> is_received_;
  std::uint32_t received_ = 0;
  CO_EEPROM_I2C context_{};
};

}  // namespace test
