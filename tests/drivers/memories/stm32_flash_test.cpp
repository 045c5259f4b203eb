// SPDX-License-Identifier: Apache-2.0
// The examples demo/memory/flash_stm32*.c on models of the registers of STM32F4, STM32G4 and STM32H7.
#include "stm32_flash.hpp"

#include <doctest/doctest.h>

#include "demo/memory/memory.h"
#include "memory_check.hpp"
#include "stored_group.hpp"

namespace {

using namespace test;
using Bytes = std::vector<std::uint8_t>;

struct Example {
  const char* name;
  Family family;
  const CO_FLASH_PAGES* flash;
};

const Example examples[] = {{"STM32F4", Family::f4, &FlashStm32f4},
                            {"STM32G4", Family::g4, &FlashStm32g4},
                            {"STM32H7", Family::h7, &FlashStm32h7}};

Stm32Flash model_of(const Example& example) {
  Stm32Flash model(example.family, *example.flash);
  if (example.family == Family::g4) {
    model.nmi = FlashStm32g4Nmi;
  }
  return model;
}

const CO_IF_NVM_DRV_EX& driver = FlashPagesNvmDriver;

TEST_CASE("examples for STM32 flash: units are programmed and pages are erased in each bank") {
  for (const Example& example : examples) {
    CAPTURE(example.name);
    Stm32Flash model = model_of(example);
    void* const ctx = model.context();
    const CO_NVM_SHAPE shape = driver.Shape(ctx);
    Bytes bytes(64);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      bytes[n] = static_cast<std::uint8_t>(n + 1);
    }
    for (std::uint32_t at = 0; at < shape.Capacity; at += shape.EraseSize) {
      CAPTURE(at);
      Bytes read(61);
      REQUIRE(driver.Erase(ctx, at, shape.EraseSize));
      REQUIRE(driver.Write(ctx, at, bytes.data(), 64) == 64);
      REQUIRE(driver.Read(ctx, at + 3, read.data(), 61) == 61);
      CHECK(std::equal(read.begin(), read.end(), bytes.begin() + 3));
      CHECK(driver.Write(ctx, at, bytes.data(), 32) == 0);
      REQUIRE(driver.Erase(ctx, at, shape.EraseSize));
      CHECK(driver.Read(ctx, at, read.data(), 61) == 61);
      CHECK(read == Bytes(61, 0xFF));
    }
    CHECK(model.cache_resets > 0);
    CHECK(model.cells.faults == std::vector<std::string>{});
  }
}

TEST_CASE("examples for STM32 flash: errors of the memory and operations without an end are reported") {
  for (const Example& example : examples) {
    CAPTURE(example.name);
    Stm32Flash model = model_of(example);
    void* const ctx = model.context();
    const CO_NVM_SHAPE shape = driver.Shape(ctx);
    const Bytes bytes(64, 5);
    model.cells.fail_at = 1;
    CHECK(driver.Write(ctx, 0, bytes.data(), shape.ProgramSize) == 0);
    model.cells.fail_at = 2;
    CHECK_FALSE(driver.Erase(ctx, 0, shape.EraseSize));
    model.cells.fail_at = 0;
    CHECK(driver.Write(ctx, 0, bytes.data(), shape.ProgramSize) == shape.ProgramSize);
    model.refuses_keys = true;
    CHECK(driver.Write(ctx, 32, bytes.data(), shape.ProgramSize) == 0);
    CHECK_FALSE(driver.Erase(ctx, 0, shape.EraseSize));
    model.refuses_keys = false;
    CHECK(model.cells.faults == std::vector<std::string>{});
    model.busy_readings = UINT32_MAX;
    CHECK(driver.Write(ctx, 64, bytes.data(), shape.ProgramSize) == 0);
    CHECK_FALSE(driver.Erase(ctx, 0, shape.EraseSize));
  }
}

TEST_CASE("examples for STM32 flash: a damaged unit cannot be read and the units beside it can") {
  for (const Example& example : examples) {
    if (example.family != Family::f4) {  // no error-correcting code
      CAPTURE(example.name);
      Stm32Flash model = model_of(example);
      void* const ctx = model.context();
      const CO_NVM_SHAPE shape = driver.Shape(ctx);
      std::uint8_t byte = 0;
      model.cells.damage(example.flash->Regions[1].Address + shape.ProgramSize);
      const std::uint32_t bank = example.flash->Regions[0].PageNum * shape.EraseSize;
      CHECK(driver.Read(ctx, bank + shape.ProgramSize, &byte, 1) == 0);
      CHECK(driver.Read(ctx, bank + 2 * shape.ProgramSize - 1, &byte, 1) == 0);
      CHECK(driver.Read(ctx, bank + 2 * shape.ProgramSize, &byte, 1) == 1);
      CHECK(driver.Read(ctx, bank, &byte, 1) == 1);
      CHECK(driver.Read(ctx, 0, &byte, 1) == 1);
    }
  }
}

#if USE_PARA

// Both groups need four pages: only the example for STM32G4 has them.
struct G4 : Stm32Flash {
  G4() : Stm32Flash(Family::g4, FlashStm32g4), power(cells.power) { nmi = FlashStm32g4Nmi; }
  G4(const G4& other) : Stm32Flash(other), power(cells.power) {}
  G4& operator=(const G4&) = delete;
  Power& power;
};

TEST_CASE("examples for STM32 flash: a loss of power at each operation leaves the old or the new values") {
  CHECK(cut_each_store(G4()) >= 100);
}

#endif

}  // namespace
