// SPDX-License-Identifier: Apache-2.0
/// \file stm32_flash.hpp
/// Registers and main memory of the flash of STM32F4, STM32G4 and STM32H7, for the examples in demo/memory. Written
/// from RM0090, 3.5 and 3.9 (F4), RM0440, 3.3 and 3.7 (G4), RM0433, 4.3 and 4.9 (H7).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "flash_model.hpp"

namespace test {

enum class Family : std::uint8_t { f4, g4, h7 };

/// The model that lexican_model_read() and lexican_model_write() access is the last one that was constructed or bound.
class Stm32Flash {
 public:
  /// \a flash: the pages of the example.
  Stm32Flash(Family family, const CO_FLASH_PAGES& flash);
  Stm32Flash(const Stm32Flash& other) : Stm32Flash(other.family_, other.example_) { *this = other; }
  Stm32Flash& operator=(const Stm32Flash& other) = default;
  ~Stm32Flash() = default;

  Power& power() { return cells.power; }
  std::uint32_t busy_readings = 2;  ///< readings of the status during which an operation lasts
  bool refuses_keys = false;
  std::function<void()> nmi;  ///< interrupt of a double error
  std::uint64_t cache_resets = 0;

  std::uint32_t read(std::uintptr_t address);
  void write(std::uintptr_t address, std::uint32_t value);

  /// Makes this object the one that the example accesses. Returns the context of the driver.
  void* context();
  static const CO_IF_NVM_DRV_EX& driver() { return FlashPagesNvmDriver; }
  [[nodiscard]] bool is_used_well() const { return cells.faults.empty(); }

  FlashModel cells;

 private:
  struct Bank {
    std::uint32_t control;
    std::uint32_t status = 0;
    std::uint32_t busy = 0;
    unsigned key = 0;
  };
  struct Bits {
    std::uintptr_t base, key, status, control;
    std::uint32_t lock, program, erase, start, busy, sequence_error, program_error;
  };
  [[nodiscard]] const Bits& bits() const;
  [[nodiscard]] std::uint32_t erased_page(std::uint32_t control, unsigned bank) const;
  void write_register(std::uint32_t offset, std::uint32_t value, unsigned bank);
  void begin_erase(Bank& bank, unsigned number);
  void put_word(std::uint32_t address, std::uint32_t value);
  void fault(const std::string& text) { cells.faults.push_back(text); }

  Family family_;
  CO_FLASH_PAGES example_;
  Bank banks_[2];
  std::uint32_t eccr_ = 0;
  std::uint32_t acr_;
  std::uint32_t next_ = 0;  // address of the next word of the unit
  std::vector<std::uint8_t> words_;
};

}  // namespace test
