// SPDX-License-Identifier: Apache-2.0
#include "stm32_flash.hpp"

namespace test {
namespace {

Stm32Flash* bound = nullptr;

constexpr std::uint32_t data_cache = 1U << 10;
constexpr std::uint32_t reset_data_cache = 1U << 12;
constexpr std::uint32_t double_error = 1U << 31;        // ECCR of G4
constexpr std::uint32_t double_error_h7 = 1U << 26;     // SR of H7
constexpr std::uintptr_t invalidate_line = 0xE000EF5C;  // of the CPU of H7
constexpr std::uintptr_t main_memory = 0x08000000;
constexpr std::uintptr_t main_memory_end = 0x08200000;

std::vector<CO_FLASH_REGION> regions_of(const CO_FLASH_PAGES& flash) {
  return {flash.Regions, flash.Regions + flash.RegionNum};
}

}  // namespace

const Stm32Flash::Bits& Stm32Flash::bits() const {
  static const Bits f4 = {0x40023C00, 0x04, 0x0C, 0x10, 1U << 31, 1, 2, 1U << 16, 1U << 16, 1U << 7, 1U << 1};
  static const Bits g4 = {0x40022000, 0x08, 0x10, 0x14, 1U << 31, 1, 2, 1U << 16, 1U << 16, 1U << 7, 1U << 3};
  static const Bits h7 = {0x52002000, 0x04, 0x10, 0x0C, 1, 2, 4, 1U << 7, 7, 1U << 18, 1U << 22};
  return family_ == Family::f4 ? f4 : family_ == Family::g4 ? g4 : h7;
}

Stm32Flash::Stm32Flash(Family family, const CO_FLASH_PAGES& flash)
    : cells(regions_of(flash), flash.ProgramSize, family != Family::f4),
      family_(family),
      example_(flash),
      banks_{},
      acr_(data_cache | 0x600U) {
  for (Bank& bank : banks_) {
    bank = {bits().lock, 0, 0, 0};
  }
}

void* Stm32Flash::context() {
  bound = this;
  if (power().operations == 0) {  // a reset of the CPU locks the registers
    for (Bank& bank : banks_) {
      bank = {bits().lock, 0, 0, 0};
    }
    words_.clear();
  }
  return const_cast<CO_FLASH_PAGES*>(&example_);
}

// Returns the number of the page, counted over both banks, that a control register selects.
std::uint32_t Stm32Flash::erased_page(std::uint32_t control, unsigned bank) const {
  switch (family_) {
    case Family::f4: {
      const std::uint32_t code = control >> 3U & 31U;
      return code < 12 ? code : code - 4;
    }
    case Family::g4: return (control >> 3U & 127U) + ((control & 1U << 11U) != 0 ? 128 : 0);
    default: return (control >> 8U & 7U) + 8 * bank;
  }
}

void Stm32Flash::begin_erase(Bank& bank, unsigned number) {
  const std::uint32_t page = erased_page(bank.control, number);
  bank.busy = busy_readings;
  for (std::uint32_t n = 0; n < example_.RegionNum; ++n) {
    const CO_FLASH_REGION& region = example_.Regions[n];
    if (page - region.FirstNumber < region.PageNum) {
      const std::uint32_t address = region.Address + (page - region.FirstNumber) * region.PageSize;
      bank.status |= cells.erase(address, page) ? 0 : bits().program_error;
      return;
    }
  }
  fault("erase of page " + std::to_string(page));
}

void Stm32Flash::write_register(std::uint32_t offset, std::uint32_t value, unsigned number) {
  Bank& bank = banks_[number];
  if (offset == bits().key) {
    const bool is_next = value == (bank.key == 0 ? 0x45670123U : 0xCDEF89ABU);
    if (!is_next || (bank.control & bits().lock) == 0) {
      fault("key");
    }
    bank.key = is_next ? bank.key + 1 : 0;
    if (bank.key == 2) {
      bank.key = 0;
      bank.control &= ~(refuses_keys ? 0 : bits().lock);
    }
  } else if (offset == (family_ == Family::h7 ? 0x14U : bits().status)) {
    bank.status &= ~value;
  } else if (offset == bits().control) {
    if ((bank.control & bits().lock) != 0) {
      if (!refuses_keys) {
        fault("control register is locked");
      }
      return;
    }
    if (bank.busy != 0) {
      fault("control register is written during an operation");
    }
    const bool has_width =
        family_ == Family::g4 || (value & bits().lock) != 0 || (value >> (family_ == Family::f4 ? 8U : 4U) & 3U) != 0;
    if (!has_width) {
      fault("PSIZE is not set");
    }
    bank.control = value & ~bits().start;
    if ((value & bits().start) != 0) {
      (value & bits().erase) != 0 ? begin_erase(bank, number) : fault("start without an operation");
    }
  } else {
    fault("register " + std::to_string(offset));
  }
}

// Writes a word of the main memory: the unit is programmed when its last word is written.
void Stm32Flash::put_word(std::uint32_t address, std::uint32_t value) {
  Bank& bank = banks_[family_ == Family::h7 && address >= 0x08100000 ? 1 : 0];
  if ((bank.control & (bits().program | bits().lock | bits().erase)) != bits().program || bank.busy != 0) {
    fault("word without PG");
    bank.status |= bits().sequence_error;
    return;
  }
  if (words_.empty() ? address % example_.ProgramSize != 0 : address != next_) {
    fault("order of words");
    words_.clear();
    return;
  }
  next_ = address + 4;
  for (unsigned n = 0; n < 4; ++n) {
    words_.push_back(static_cast<std::uint8_t>(value >> 8 * n));
  }
  if (words_.size() == example_.ProgramSize) {
    alignas(8) std::uint8_t unit[CO_FLASH_UNIT_MAX];
    std::copy(words_.begin(), words_.end(), unit);
    words_.clear();
    bank.busy = busy_readings;
    bank.status |= cells.program(next_ - example_.ProgramSize, unit) ? 0 : bits().program_error;
  }
}

void Stm32Flash::write(std::uintptr_t address, std::uint32_t value) {
  if (address >= main_memory && address < main_memory_end) {
    put_word(static_cast<std::uint32_t>(address), value);
  } else if (address == bits().base && family_ != Family::h7) {
    if ((value & reset_data_cache) != 0) {
      ++cache_resets;
      if ((value & data_cache) != 0) {
        fault("reset of a cache that is enabled");
      }
    }
    acr_ = value;
  } else if (family_ == Family::g4 && address == bits().base + 0x18) {
    eccr_ &= ~(value & double_error);
  } else if (family_ == Family::h7 && address == invalidate_line) {
    ++cache_resets;
  } else {
    const std::uintptr_t offset = address - bits().base;
    const bool is_second = family_ == Family::h7 && offset >= 0x100;
    write_register(static_cast<std::uint32_t>(offset & 0xFFU), value, is_second ? 1 : 0);
  }
}

std::uint32_t Stm32Flash::read(std::uintptr_t address) {
  if (address >= main_memory && address < main_memory_end) {
    std::uint8_t bytes[4] = {};
    if (!cells.read(static_cast<std::uint32_t>(address), bytes, 4) && !power().is_off) {
      banks_[address >= 0x08100000 ? 1 : 0].status |= family_ == Family::h7 ? double_error_h7 : 0;
      eccr_ |= family_ == Family::g4 ? double_error : 0;
      if (nmi) {
        nmi();
      }
    }
    return bytes[0] + bytes[1] * 0x100U + bytes[2] * 0x10000U + bytes[3] * 0x1000000U;
  }
  if (address == bits().base && family_ != Family::h7) {
    return acr_;
  }
  if (family_ == Family::g4 && address == bits().base + 0x18) {
    return eccr_;
  }
  const std::uintptr_t offset = (address - bits().base) & 0xFFU;
  Bank& bank = banks_[family_ == Family::h7 && address - bits().base >= 0x100 ? 1 : 0];
  if (offset == bits().status) {
    const bool is_busy = bank.busy != 0;
    bank.busy -= is_busy && busy_readings != UINT32_MAX ? 1 : 0;
    return bank.status | (is_busy ? bits().busy : 0);
  }
  if (offset != bits().control) {
    fault("read of register " + std::to_string(offset));
  }
  return bank.control;
}

}  // namespace test

extern "C" uint32_t lexican_model_read(uintptr_t address);
extern "C" void lexican_model_write(uintptr_t address, uint32_t value);

uint32_t lexican_model_read(uintptr_t address) { return test::bound->read(address); }
void lexican_model_write(uintptr_t address, uint32_t value) { test::bound->write(address, value); }
