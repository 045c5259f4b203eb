// SPDX-License-Identifier: Apache-2.0
// The driver eeprom_spi on models of EEPROM 25xx and FRAM.
#include <doctest/doctest.h>

#include "bus_fault_sweep.hpp"
#include "eeprom25.hpp"
#include "memory_check.hpp"
#include "stored_group.hpp"

namespace {

using namespace test;
using Bytes = std::vector<std::uint8_t>;

const Chip25 chips[] = {
    {"25LC010A", 128, 16, 1, 5, false, false},    {"25LC040A", 512, 16, 1, 5, false, false},
    {"M95080", 1024, 32, 2, 5, false, false},     {"25LC256", 32768, 64, 2, 5, false, false},
    {"CAT25256", 32768, 64, 2, 5, true, false},   {"25LC1024", 131072, 256, 3, 6, false, false},
    {"M95M02", 262144, 256, 3, 10, false, false}, {"FM25L04", 512, 0, 1, 0, false, false},
    {"FM25640", 8192, 0, 2, 0, false, false},     {"MB85RS2MT", 262144, 0, 3, 0, false, true},
};
const Chip25& lc256 = chips[3];
const Chip25& cat = chips[4];
const Chip25& fram = chips[8];
const Chip25& fujitsu = chips[9];

const CO_IF_NVM_DRV_EX& driver = EepromSpiNvmDriver;

Bytes pattern(std::uint32_t size, std::uint8_t seed) {
  Bytes bytes(size);
  for (std::uint32_t n = 0; n < size; ++n) {
    bytes[n] = static_cast<std::uint8_t>(seed + n * 7 + n / 256);
  }
  return bytes;
}

TEST_CASE("eeprom_spi: bytes are written and read at each boundary of pages") {
  for (const Chip25& chip : chips) {
    CAPTURE(chip.name);
    Eeprom25 memory(chip);
    void* const ctx = memory.context();
    for (const std::uint32_t at : {0U, 3U, 31U, 250U, 65530U, chip.capacity / 2 - 5, chip.capacity - 60}) {
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
    CHECK_FALSE(memory.is_enabled());
    CHECK(memory.faults == std::vector<std::string>{});
    CHECK(memory.is_used_well());
  }
}

TEST_CASE("eeprom_spi: a write uses one write cycle for each page") {
  Eeprom25 memory(lc256);
  void* const ctx = memory.context();
  const Bytes bytes = pattern(200, 1);
  CHECK(driver.Write(ctx, 64, bytes.data(), 64) == 64);
  CHECK(memory.cycles == 1);
  CHECK(driver.Write(ctx, 1, bytes.data(), 200) == 200);  // 63 + 64 + 64 + 9
  CHECK(memory.cycles == 5);
  Eeprom25 ferroelectric(fram);
  CHECK(driver.Write(ferroelectric.context(), 1, bytes.data(), 200) == 200);
  CHECK(ferroelectric.cycles == 1);
}

TEST_CASE("eeprom_spi: slots of records do not share pages and the geometry depends on the buffer of the node") {
  for (const Chip25& chip : chips) {
    CAPTURE(chip.name);
    Eeprom25 memory(chip);
    const CO_NVM_SHAPE shape = driver.Shape(memory.context());
    const bool is_flash = chip.page > CO_STORE_BUFFER;
    CHECK(shape.Capacity == chip.capacity);
    CHECK(shape.ProgramSize == (chip.page == 0 || is_flash ? 1 : chip.page));
    CHECK(shape.EraseSize == (is_flash ? chip.page : 0));
  }
}

TEST_CASE("eeprom_spi: accesses are limited to the capacity") {
  Eeprom25 memory(chips[1]);
  void* const ctx = memory.context();
  Bytes bytes = pattern(32, 4);
  CHECK(driver.Write(ctx, 504, bytes.data(), 32) == 8);
  CHECK(driver.Read(ctx, 504, bytes.data(), 32) == 8);
  CHECK(driver.Write(ctx, 512, bytes.data(), 1) == 0);
  CHECK(driver.Read(ctx, 0xFFFFFFFF, bytes.data(), 2) == 0);
  CHECK(driver.Write(ctx, 0, bytes.data(), 0) == 0);
  CHECK(driver.Read(ctx, 0, bytes.data(), 0) == 0);
  CHECK_FALSE(driver.Erase(ctx, 512, 16));
  CHECK_FALSE(driver.Erase(ctx, 8, 16));
  CHECK(driver.Erase(ctx, 0, 0));
  CHECK(memory.byte(0) == 0xFF);
  CHECK(memory.is_used_well());
}

TEST_CASE("eeprom_spi: an erase writes FFh into whole pages with one write cycle for each") {
  for (const Chip25& chip : chips) {
    if (chip.page != 0) {
      CAPTURE(chip.name);
      Eeprom25 memory(chip);
      void* const ctx = memory.context();
      const Bytes bytes(chip.capacity < 1024 ? chip.capacity : 1024, 0x12);
      REQUIRE(driver.Write(ctx, 0, bytes.data(), static_cast<std::uint32_t>(bytes.size())) == bytes.size());
      memory.cycles = 0;
      CHECK(driver.Erase(ctx, chip.page, 2 * chip.page));
      CHECK(memory.cycles == 2);
      CHECK(memory.byte(chip.page - 1) == 0x12);
      for (std::uint32_t at = chip.page; at < 3 * chip.page; ++at) {
        REQUIRE(memory.byte(at) == 0xFF);
      }
      CHECK(memory.byte(3 * chip.page) == 0x12);
      CHECK(memory.is_used_well());
    }
  }
}

TEST_CASE("eeprom_spi: the end of a write cycle is detected by its status within its longest time") {
  const Bytes bytes = pattern(16, 9);
  for (const Chip25* const chip : {&lc256, &cat}) {
    for (const std::uint32_t microseconds : {1U, 100U, 2600U, 4999U, 5000U}) {
      CAPTURE(microseconds);
      Eeprom25 memory(*chip);
      memory.write_time = microseconds;
      CHECK(driver.Write(memory.context(), 0, bytes.data(), 16) == 16);
      CHECK_FALSE(memory.is_busy());
      CHECK(memory.now <= microseconds + 350);
      CHECK(memory.is_used_well());
    }
  }
}

TEST_CASE("eeprom_spi: a write cycle that does not end is an error after its longest time") {
  Eeprom25 memory(lc256);
  memory.write_time = 1000000;
  Bytes bytes = pattern(32, 9);
  CHECK(driver.Write(memory.context(), 0, bytes.data(), 32) == 0);
  CHECK(memory.now >= 5000);
  CHECK(memory.now <= 7000);
  CHECK(driver.Read(memory.context(), 0, bytes.data(), 32) == 0);
  CHECK(memory.now <= 14000);
  CHECK(memory.cycles == 1);
}

TEST_CASE("eeprom_spi: an access waits for a write cycle that the CPU has begun before its reset") {
  Eeprom25 memory(lc256);
  Bytes bytes = pattern(8, 3);
  memory.byte(100) = 0x42;
  memory.begin_cycle();
  CHECK(driver.Read(memory.context(), 100, bytes.data(), 1) == 1);
  CHECK(bytes[0] == 0x42);
  memory.begin_cycle();
  CHECK(driver.Write(memory.context(), 100, bytes.data(), 8) == 8);
  CHECK(memory.is_used_well());
}

TEST_CASE("eeprom_spi: a device that is lost at any byte on the bus ends the access in a limited time") {
  for (const Chip25* const chip : {&lc256, &fram}) {
    CAPTURE(chip->name);
    const Bytes bytes = pattern(100, 8);
    Eeprom25 whole(*chip);
    REQUIRE(driver.Write(whole.context(), 30, bytes.data(), 100) == 100);
    for (const std::uint8_t level : {std::uint8_t{0xFF}, std::uint8_t{0x00}, std::uint8_t{0x55}, std::uint8_t{0x02}}) {
      for (std::uint64_t lost = 1; lost < whole.bus_bytes; ++lost) {
        CAPTURE(lost);
        Eeprom25 memory(*chip);
        memory.lost_after = lost;
        memory.lost_level = level;
        const std::uint32_t done = driver.Write(memory.context(), 30, bytes.data(), 100);
        // Level 0 is a correct answer to the last instructions: clear the latch, read the status. All bytes are
        // written.
        const bool is_last = lost >= whole.bus_bytes - 3 && level == 0;
        REQUIRE((done < 100 || is_last));
        REQUIRE(memory.now < whole.now + 7000);
        Bytes read(100);
        REQUIRE(driver.Read(memory.context(), 30, read.data(), 100) == 0);
        REQUIRE_FALSE(driver.Erase(memory.context(), 0, 64));
      }
    }
  }
}

TEST_CASE("eeprom_spi: a device that is lost while it is read is an error") {
  Bytes read(50);
  Eeprom25 whole(lc256);
  REQUIRE(driver.Read(whole.context(), 30, read.data(), 50) == 50);
  for (const std::uint8_t level : {std::uint8_t{0xFF}, std::uint8_t{0x00}}) {
    for (std::uint64_t lost = 1; lost < whole.bus_bytes - 3; ++lost) {
      CAPTURE(lost);
      Eeprom25 memory(lc256);
      memory.lost_after = lost;
      memory.lost_level = level;
      REQUIRE(driver.Read(memory.context(), 30, read.data(), 50) == 0);
    }
  }
}

TEST_CASE("eeprom_spi: with a fault of the bus at any access, bytes that are reported as written are in the memory") {
  for (const Chip25* const chip : {&lc256, &cat, &fram, &fujitsu}) {
    for (const std::uint32_t half : {1U, 4U, 20U}) {
      CAPTURE(chip->name);
      CAPTURE(half);
      Eeprom25 empty(*chip);
      empty.write_time = 600;
      empty.half = half;
      CHECK(test_bus_faults(empty, 230, 60) >= 200);
      CHECK(test_erase_faults(empty, 192, 128) >= 100);
    }
  }
}

TEST_CASE("eeprom_spi: bytes of protected blocks are not reported as written") {
  for (const Chip25* const chip : {&lc256, &fram}) {
    Eeprom25 memory(*chip);
    memory.is_protected = true;
    const Bytes bytes = pattern(16, 9);
    CHECK(driver.Write(memory.context(), 0, bytes.data(), 16) == 0);
  }
}

TEST_CASE("eeprom_spi: impossible settings have no capacity") {
  Eeprom25 memory(chips[1]);
  const auto* const good = static_cast<const CO_EEPROM_SPI*>(memory.context());
  const auto is_refused = [](CO_EEPROM_SPI eeprom) {
    std::uint8_t byte = 0;
    return driver.Read(&eeprom, 0, &byte, 1) == 0 && driver.Write(&eeprom, 0, &byte, 1) == 0 &&
           driver.Shape(&eeprom).Capacity == 0 && !driver.Erase(&eeprom, 0, 16);
  };
  CHECK_FALSE(is_refused(*good));
  CO_EEPROM_SPI eeprom = *good;
  eeprom.Capacity = 1;
  CHECK_FALSE(is_refused(eeprom));
  eeprom.AddressBytes = 0;
  CHECK(is_refused(eeprom));
  eeprom.AddressBytes = 4;
  CHECK(is_refused(eeprom));
  eeprom.AddressBytes = 1;
  eeprom.Capacity = 1024;
  CHECK(is_refused(eeprom));
  eeprom.AddressBytes = 2;
  eeprom.Capacity = 65537;
  CHECK(is_refused(eeprom));
}

TEST_CASE("eeprom_spi: the driver check passes") {
  for (const Chip25& chip : chips) {
    CAPTURE(chip.name);
    Chip25 part = chip;
    part.capacity = chip.capacity < 2048 ? chip.capacity : 2048;  // limits the duration
    Eeprom25 memory(part);
    CHECK(failed_checks(memory) == std::vector<std::string>{});
    CHECK(memory.is_used_well());
  }
}

#if USE_PARA

TEST_CASE("eeprom_spi: a loss of power at each write cycle leaves the old or the new values") {
  for (const Chip25& chip : chips) {
    if (chip.capacity >= 512) {
      CAPTURE(chip.name);
      Chip25 part = chip;
      part.capacity = chip.capacity < 2048 ? chip.capacity : 2048;
      CHECK(cut_each_store(Eeprom25(part)) >= 60);
    }
  }
}

TEST_CASE("eeprom_spi: a fault of the bus at each access of a store leaves the old or the new values") {
  for (const Chip25* const chip : {&lc256, &cat, &fram}) {
    CAPTURE(chip->name);
    Eeprom25 memory(*chip);
    memory.write_time = 600;
    memory.half = 20;
    CHECK(disturb_each_store(memory) >= 1000);
  }
}

TEST_CASE("eeprom_spi: a fault of the bus at each access of a start is reported or has no effect") {
  for (const Chip25* const chip : {&lc256, &cat, &fram}) {
    CAPTURE(chip->name);
    Eeprom25 memory(*chip);
    memory.half = 20;
    CHECK(disturb_each_start(memory) >= 100);
  }
}

TEST_CASE("eeprom_spi: a lost device is reported when a group is loaded and stored") {
  for (const std::uint8_t level : {std::uint8_t{0xFF}, std::uint8_t{0x00}}) {
    Eeprom25 memory(lc256);
    memory.lost_level = level;
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
}

#endif

}  // namespace
