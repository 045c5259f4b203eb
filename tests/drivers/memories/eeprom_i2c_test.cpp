// SPDX-License-Identifier: Apache-2.0
// The driver eeprom_i2c on models of EEPROM 24xx and FRAM.
#include <doctest/doctest.h>

#include "bus_fault_sweep.hpp"
#include "eeprom24.hpp"
#include "memory_check.hpp"
#include "stored_group.hpp"

namespace {

using namespace test;
using Bytes = std::vector<std::uint8_t>;

const Chip24 chips[] = {
    {"24LC01B", 128, 8, 0x50, 1, 0, 5},       {"24LC04B", 512, 16, 0x50, 1, 0, 5},
    {"24LC16B", 2048, 16, 0x50, 1, 0, 5},     {"24LC64", 8192, 32, 0x57, 2, 0, 5},
    {"24LC256", 32768, 64, 0x50, 2, 0, 5},    {"AT24C512C", 65536, 128, 0x52, 2, 0, 5},
    {"24LC1025", 131072, 128, 0x51, 2, 2, 5}, {"M24M02", 262144, 256, 0x54, 2, 0, 10},
    {"FM24C04", 512, 0, 0x50, 1, 0, 0},       {"FM24CL64", 8192, 0, 0x50, 2, 0, 0},
    {"MB85RC1M", 131072, 0, 0x50, 2, 0, 0},   {"address of 3 bytes", 131072, 32, 0x50, 3, 0, 5},
};
const Chip24& lc16 = chips[2];
const Chip24& lc256 = chips[4];
const Chip24& lc1025 = chips[6];
const Chip24& fram = chips[9];

const CO_IF_NVM_DRV_EX& driver = EepromI2cNvmDriver;

Bytes pattern(std::uint32_t size, std::uint8_t seed) {
  Bytes bytes(size);
  for (std::uint32_t n = 0; n < size; ++n) {
    bytes[n] = static_cast<std::uint8_t>(seed + n * 7 + n / 256);
  }
  return bytes;
}

TEST_CASE("eeprom_i2c: bytes are written and read at each boundary of pages and blocks") {
  for (const Chip24& chip : chips) {
    CAPTURE(chip.name);
    Eeprom24 memory(chip);
    void* const ctx = memory.context();
    const std::uint32_t block = 1U << (8U * chip.address_bytes);
    for (const std::uint32_t at : {0U, 3U, 31U, 250U, chip.capacity / 2 - 5, block - 5, chip.capacity - 60}) {
      if (at <= chip.capacity - 60) {
        CAPTURE(at);
        const Bytes bytes = pattern(60, static_cast<std::uint8_t>(at));
        Bytes read(60);
        REQUIRE(driver.Write(ctx, at, bytes.data(), 60) == 60);
        for (std::uint32_t n = 0; n < 60; ++n) {
          REQUIRE(memory.byte(at + n) == bytes[n]);
        }
        REQUIRE(driver.Read(ctx, at, read.data(), 60) == 60);
        CHECK(read == bytes);
      }
    }
    CHECK_FALSE(memory.is_busy());
    CHECK(memory.faults == std::vector<std::string>{});
    CHECK(memory.is_used_well());
  }
}

TEST_CASE("eeprom_i2c: a write uses one write cycle for each page") {
  Eeprom24 memory(lc256);
  void* const ctx = memory.context();
  const Bytes bytes = pattern(200, 1);
  CHECK(driver.Write(ctx, 64, bytes.data(), 64) == 64);
  CHECK(memory.cycles == 1);
  CHECK(driver.Write(ctx, 60, bytes.data(), 5) == 5);
  CHECK(memory.cycles == 3);
  CHECK(driver.Write(ctx, 1, bytes.data(), 200) == 200);  // 63 + 64 + 64 + 9
  CHECK(memory.cycles == 7);
  CHECK(memory.is_used_well());
}

TEST_CASE("eeprom_i2c: slots of records do not share pages and the geometry depends on the buffer of the node") {
  for (const Chip24& chip : chips) {
    CAPTURE(chip.name);
    Eeprom24 memory(chip);
    const CO_NVM_SHAPE shape = driver.Shape(memory.context());
    const bool is_flash = chip.page > CO_STORE_BUFFER;
    CHECK(shape.Capacity == chip.capacity);
    CHECK(shape.ProgramSize == (chip.page == 0 || is_flash ? 1 : chip.page));
    CHECK(shape.EraseSize == (is_flash ? chip.page : 0));
    CHECK(CO_EEPROM_SPACE(100, chip.page) ==
          CO_PARA_SPACE(100, is_flash ? shape.EraseSize : shape.ProgramSize, shape.ProgramSize));
  }
}

TEST_CASE("eeprom_i2c: a part of a page at the end of the memory is not used") {
  Eeprom24 memory({"1000 bytes", 1000, 16, 0x50, 2, 0, 5});
  CHECK(driver.Shape(memory.context()).Capacity == 992);
}

TEST_CASE("eeprom_i2c: accesses are limited to the capacity") {
  Eeprom24 memory(lc16);
  void* const ctx = memory.context();
  Bytes bytes = pattern(32, 4);
  CHECK(driver.Write(ctx, 2040, bytes.data(), 32) == 8);
  CHECK(driver.Read(ctx, 2040, bytes.data(), 32) == 8);
  CHECK(driver.Write(ctx, 2048, bytes.data(), 1) == 0);
  CHECK(driver.Read(ctx, 0xFFFFFFFF, bytes.data(), 2) == 0);
  CHECK(driver.Write(ctx, 0, bytes.data(), 0) == 0);
  CHECK_FALSE(driver.Erase(ctx, 2048, 16));
  CHECK_FALSE(driver.Erase(ctx, 8, 16));
  CHECK(memory.byte(0) == 0xFF);
  CHECK(memory.is_used_well());
}

TEST_CASE("eeprom_i2c: an erase writes FFh into whole pages") {
  for (const Chip24& chip : chips) {
    if (chip.page != 0) {
      CAPTURE(chip.name);
      Eeprom24 memory(chip);
      void* const ctx = memory.context();
      const Bytes bytes(chip.capacity < 1024 ? chip.capacity : 1024, 0x12);
      REQUIRE(driver.Write(ctx, 0, bytes.data(), static_cast<std::uint32_t>(bytes.size())) == bytes.size());
      CHECK(driver.Erase(ctx, chip.page, 2 * chip.page));
      CHECK(memory.byte(chip.page - 1) == 0x12);
      for (std::uint32_t at = chip.page; at < 3 * chip.page; ++at) {
        REQUIRE(memory.byte(at) == 0xFF);
      }
      CHECK(memory.byte(3 * chip.page) == 0x12);
      CHECK(memory.is_used_well());
    }
  }
}

TEST_CASE("eeprom_i2c: the end of a write cycle is detected by polling within its longest time") {
  const Bytes bytes = pattern(16, 9);
  for (const std::uint32_t microseconds : {1U, 100U, 2600U, 4999U, 5000U}) {
    CAPTURE(microseconds);
    Eeprom24 memory(lc16);
    memory.write_time = microseconds;
    CHECK(driver.Write(memory.context(), 0, bytes.data(), 16) == 16);
    CHECK_FALSE(memory.is_busy());
    CHECK(memory.now >= microseconds);
    CHECK(memory.now <= microseconds + 250 + 25 * memory.byte_time);
  }
}

TEST_CASE("eeprom_i2c: a write cycle that does not end is an error after its longest time") {
  Eeprom24 memory(lc16);
  memory.write_time = 1000000;
  Bytes bytes = pattern(32, 9);
  CHECK(driver.Write(memory.context(), 0, bytes.data(), 32) == 0);
  CHECK(memory.now >= 5000);
  CHECK(memory.now <= 7000);
  CHECK(driver.Read(memory.context(), 0, bytes.data(), 32) == 0);
  CHECK(memory.now <= 14000);
  CHECK(memory.cycles == 1);
}

TEST_CASE("eeprom_i2c: an access waits for a write cycle that the CPU has begun before its reset") {
  Eeprom24 memory(lc256);
  Bytes bytes = pattern(8, 3);
  memory.byte(100) = 0x42;
  memory.begin_cycle();
  CHECK(driver.Read(memory.context(), 100, bytes.data(), 1) == 1);
  CHECK(bytes[0] == 0x42);
  memory.begin_cycle();
  CHECK(driver.Write(memory.context(), 100, bytes.data(), 8) == 8);
  CHECK(memory.is_used_well());
}

TEST_CASE("eeprom_i2c: a device that is lost at any byte on the bus ends the access in a limited time") {
  for (const Chip24* const chip : {&lc256, &lc1025, &fram}) {
    CAPTURE(chip->name);
    const Bytes bytes = pattern(100, 8);
    Eeprom24 whole(*chip);
    REQUIRE(driver.Write(whole.context(), 30, bytes.data(), 100) == 100);
    for (std::uint64_t lost = 1; lost < whole.bus_bytes; ++lost) {
      CAPTURE(lost);
      Eeprom24 memory(*chip);
      memory.lost_after = lost;
      const std::uint32_t done = driver.Write(memory.context(), 30, bytes.data(), 100);
      REQUIRE(done < 100);
      for (std::uint32_t n = 0; n < done; ++n) {
        REQUIRE(memory.byte(30 + n) == bytes[n]);
      }
      REQUIRE(memory.now < whole.now + 7000);
      Bytes read(100);
      REQUIRE(driver.Read(memory.context(), 30, read.data(), 100) == 0);
      REQUIRE(memory.faults.empty());
    }
  }
}

TEST_CASE("eeprom_i2c: a device that is lost while it is read is an error") {
  Bytes read(20);
  Eeprom24 whole(lc256);
  REQUIRE(driver.Read(whole.context(), 5, read.data(), 20) == 20);
  CHECK(whole.bus_bytes == 1 + 3 + 1 + 20 + 1);  // poll, device and address, device, bytes, device
  for (std::uint64_t lost = 1; lost < whole.bus_bytes; ++lost) {
    CAPTURE(lost);
    Eeprom24 memory(lc256);
    memory.lost_after = lost;
    CHECK(driver.Read(memory.context(), 5, read.data(), 20) == 0);
  }
}

TEST_CASE("eeprom_i2c: with a fault of the bus at any access, bytes that are reported as written are in the memory") {
  for (const Chip24* const chip : {&lc16, &lc256, &lc1025, &fram}) {
    CAPTURE(chip->name);
    const std::uint32_t at = chip == &lc1025 ? 65500 : 230;
    Eeprom24 empty(*chip);
    empty.write_time = 600;
    CHECK(test_bus_faults(empty, at, 60) >= 100);
    CHECK(test_erase_faults(empty, at / 128 * 128, 256) >= 100);
  }
}

TEST_CASE("eeprom_i2c: write protection by a pin is an error where the device shows it") {
  Eeprom24 memory(lc256);
  const Bytes bytes = pattern(8, 3);
  memory.refuses_data = true;
  CHECK(driver.Write(memory.context(), 0, bytes.data(), 8) == 0);
  memory.refuses_data = false;
  memory.is_protected = true;  // not visible on the bus: the node reads back what it stores
  CHECK(driver.Write(memory.context(), 0, bytes.data(), 8) == 8);
  CHECK(memory.byte(0) == 0xFF);
}

TEST_CASE("eeprom_i2c: impossible settings have no capacity") {
  Eeprom24 memory(lc16);
  const auto* const good = static_cast<const CO_EEPROM_I2C*>(memory.context());
  const auto is_refused = [](CO_EEPROM_I2C eeprom) {
    std::uint8_t byte = 0;
    return driver.Read(&eeprom, 0, &byte, 1) == 0 && driver.Write(&eeprom, 0, &byte, 1) == 0 &&
           driver.Shape(&eeprom).Capacity == 0 && !driver.Erase(&eeprom, 0, 16);
  };
  CHECK_FALSE(is_refused(*good));
  CO_EEPROM_I2C eeprom = *good;
  eeprom.Capacity = 1;
  CHECK_FALSE(is_refused(eeprom));
  eeprom.AddressBytes = 0;
  CHECK(is_refused(eeprom));
  eeprom.AddressBytes = 4;
  CHECK(is_refused(eeprom));
  eeprom.AddressBytes = 1;
  eeprom.Capacity = 2049;
  CHECK(is_refused(eeprom));
  eeprom.Capacity = 4096;
  CHECK(is_refused(eeprom));
}

TEST_CASE("eeprom_i2c: the driver check passes") {
  for (const Chip24& chip : chips) {
    if (chip.capacity <= 8192) {  // limits the duration
      CAPTURE(chip.name);
      Eeprom24 memory(chip);
      CHECK(failed_checks(memory) == std::vector<std::string>{});
      CHECK(memory.is_used_well());
    }
  }
  const Chip24 large[] = {{"24LC256", 2048, 64, 0x50, 2, 0, 5}, {"M24M02", 2048, 256, 0x50, 2, 0, 10}};
  for (const Chip24& chip : large) {
    CAPTURE(chip.name);
    Eeprom24 memory(chip);
    CHECK(failed_checks(memory) == std::vector<std::string>{});
    CHECK(memory.is_used_well());
  }
}

#if USE_PARA

TEST_CASE("eeprom_i2c: a loss of power at each write cycle leaves the old or the new values") {
  const Chip24 small[] = {{"24LC04B", 512, 16, 0x50, 1, 0, 5},   {"24LC64", 2048, 32, 0x50, 2, 0, 5},
                          {"24LC256", 2048, 64, 0x50, 2, 0, 5},  {"AT24C512C", 2048, 128, 0x50, 2, 0, 5},
                          {"M24M02", 2048, 256, 0x50, 2, 0, 10}, {"FM24CL64", 2048, 0, 0x50, 2, 0, 0}};
  for (const Chip24& chip : small) {
    CAPTURE(chip.name);
    CHECK(cut_each_store(Eeprom24(chip)) >= 60);
  }
}

TEST_CASE("eeprom_i2c: a fault of the bus at each access of a store leaves the old or the new values") {
  for (const Chip24* const chip : {&lc16, &lc256, &fram}) {
    CAPTURE(chip->name);
    Eeprom24 memory(*chip);
    memory.write_time = 600;
    CHECK(disturb_each_store(memory) >= 1000);
  }
}

TEST_CASE("eeprom_i2c: a fault of the bus at each access of a start is reported or has no effect") {
  for (const Chip24* const chip : {&lc16, &lc256, &fram}) {
    CAPTURE(chip->name);
    CHECK(disturb_each_start(Eeprom24(*chip)) >= 100);
  }
}

TEST_CASE("eeprom_i2c: a lost device is reported when a group is loaded and stored") {
  Eeprom24 memory(lc256);
  StoredGroup node;
  node.boot(memory);
  REQUIRE(node.save(memory, values_of(5)) == CO_ERR_NONE);
  memory.lost_after = memory.bus_bytes;
  CHECK(node.save(memory, values_of(6)) == CO_ERR_IF_NVM_WRITE);
  CHECK(node.boot(memory) == StoredGroup::defaults());
  CHECK(node.error == CO_ERR_PARA_LOAD);
  memory.lost_after = 0;
  CHECK(node.boot(memory) == values_of(5));
  memory.is_protected = true;
  CHECK(node.save(memory, values_of(6)) == CO_ERR_IF_NVM_WRITE);
}

#endif

}  // namespace
