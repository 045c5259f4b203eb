// SPDX-License-Identifier: Apache-2.0
// The examples demo/memory/eeprom_i2c_pins.c and eeprom_spi_pins.c, level by level, on the models of their memories.
#include <doctest/doctest.h>

#include "demo/memory/memory.h"
#include "pins.hpp"

namespace {

using namespace test;
using Bytes = std::vector<std::uint8_t>;

Bytes pattern() {
  Bytes bytes(150);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    bytes[n] = static_cast<std::uint8_t>(n * 5 + 1);
  }
  return bytes;
}

// Checks accesses of an example, whose memory is a model.
template <class Lines>
void check_accesses(Lines& lines, const CO_IF_NVM_DRV_EX& driver, const void* context) {
  void* const ctx = const_cast<void*>(context);
  const Bytes bytes = pattern();
  Bytes read(150);
  REQUIRE(driver.Write(ctx, 1000, bytes.data(), 150) == 150);
  for (std::uint32_t n = 0; n < 150; ++n) {
    REQUIRE(lines.memory.byte(1000 + n) == bytes[n]);
  }
  REQUIRE(driver.Read(ctx, 1000, read.data(), 150) == 150);
  CHECK(read == bytes);
  lines.memory.begin_cycle();
  REQUIRE(driver.Read(ctx, 1149, read.data(), 1) == 1);
  CHECK(read[0] == bytes[149]);
  CHECK(lines.memory.faults == std::vector<std::string>{});
  CHECK(lines.memory.is_used_well());
}

TEST_CASE("example for I2C on two pins: bytes are written and read") {
  I2cLines lines;
  i2c = &lines;
  lines.memory.byte_time = 0;  // the waits of the example advance the time
  EepromI2cFree();
  check_accesses(lines, EepromI2cNvmDriver, &EepromI2c);
  i2c = nullptr;
}

TEST_CASE("example for I2C on two pins: a lost memory and a stuck line are errors") {
  I2cLines lines;
  i2c = &lines;
  void* const ctx = const_cast<CO_EEPROM_I2C*>(&EepromI2c);
  const Bytes bytes = pattern();
  Bytes read(150);
  lines.memory.lost_after = 1;
  CHECK(EepromI2cNvmDriver.Write(ctx, 0, bytes.data(), 150) == 0);
  CHECK(EepromI2cNvmDriver.Read(ctx, 0, read.data(), 150) == 0);
  lines.memory.lost_after = 0;
  lines.is_scl_stuck = true;
  CHECK(EepromI2cNvmDriver.Read(ctx, 0, read.data(), 150) == 0);
  lines.is_scl_stuck = false;
  lines.held = 1000000;
  CHECK(EepromI2cNvmDriver.Read(ctx, 0, read.data(), 150) == 0);
  CHECK(lines.memory.now < 100000);
  i2c = nullptr;
}

TEST_CASE("example for I2C on two pins: a memory that holds SDA low after a reset of the CPU is freed") {
  for (unsigned clocks = 1; clocks <= 9; ++clocks) {
    I2cLines lines;
    i2c = &lines;
    lines.held = clocks;
    EepromI2cFree();
    CHECK(lines.sda());
    check_accesses(lines, EepromI2cNvmDriver, &EepromI2c);
  }
  i2c = nullptr;
}

TEST_CASE("example for SPI on four pins: bytes are written and read, and a lost memory is an error") {
  SpiLines lines;
  spi = &lines;
  check_accesses(lines, EepromSpiNvmDriver, &EepromSpi);
  lines.memory.lost_after = 1;
  std::uint8_t byte = 0;
  CHECK(EepromSpiNvmDriver.Read(const_cast<CO_EEPROM_SPI*>(&EepromSpi), 0, &byte, 1) == 0);
  spi = nullptr;
}

}  // namespace
