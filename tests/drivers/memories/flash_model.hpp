// SPDX-License-Identifier: Apache-2.0
/// \file flash_model.hpp
/// Flash memory with pages and units of programming, with and without an error-correcting code. Rules of STM32 flash:
/// RM0440 (STM32G4), 3.3: units of 64 bits, programmed once after an erase; RM0433 (STM32H7), 4.3: units of 256 bits;
/// RM0090 (STM32F4), 3.6: bits can only be cleared.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "co_nvm_flash_pages.h"
#include "power.hpp"

namespace test {

class FlashModel {
 public:
  /// \a has_code: a unit that was programmed incompletely cannot be read.
  FlashModel(std::vector<CO_FLASH_REGION> regions, std::uint32_t program_size, bool has_code = true);

  Power power;
  std::vector<std::string> faults;  ///< violations of the rules of the memory
  std::uint64_t erases = 0;
  std::uint64_t programs = 0;
  std::uint64_t fail_at = 0;  ///< operation, from 1, that reports an error without effect; 0: none

  bool erase(std::uint32_t address, std::uint32_t number);
  bool program(std::uint32_t address, const void* unit);
  bool read(std::uint32_t address, void* to, std::uint32_t size) const;

  /// Sets a byte as if it had been programmed.
  std::uint8_t& byte(std::uint32_t address);
  /// Makes a unit unreadable.
  void damage(std::uint32_t address);

  /// Returns the context of the driver, which refers to this object.
  void* context();
  static const CO_IF_NVM_DRV_EX& driver() { return FlashPagesNvmDriver; }
  /// Returns whether the memory was used according to its rules.
  [[nodiscard]] bool is_used_well() const { return faults.empty(); }

 private:
  struct Unit {
    std::vector<std::uint8_t> bytes;
    bool is_erased = true;
    bool is_damaged = false;
  };
  struct Page {
    std::uint32_t address;
    std::uint32_t number;
    std::vector<Unit> units;
  };
  struct Place {
    Page* page;
    Unit* unit;
    std::uint32_t offset;  // in the unit
  };
  Place find(std::uint32_t address);
  void erase_unit(Unit& unit) const;
  void leave(Unit& unit, const std::vector<std::uint8_t>& to, bool is_first_half, bool is_erase);

  std::vector<CO_FLASH_REGION> regions_;
  std::uint32_t program_size_;
  bool has_code_;
  std::vector<Page> pages_;
  CO_FLASH_PAGES context_{};
};

}  // namespace test
