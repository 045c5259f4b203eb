// SPDX-License-Identifier: Apache-2.0
// The driver flash_pages on models of flash memories: geometry, rules of programming, faults, losses of power.
#include <doctest/doctest.h>

#include <cstring>

#include "flash_model.hpp"
#include "memory_check.hpp"
#include "stored_group.hpp"

#ifdef __x86_64__
#include <sys/mman.h>
#endif

namespace {

using namespace test;
using Bytes = std::vector<std::uint8_t>;

struct Memory {
  const char* name;
  std::vector<CO_FLASH_REGION> regions;
  std::uint32_t program_size;
  bool has_code;
  CO_NVM_SHAPE shape;
};

// Sectors 2 and 3 of an STM32F4; its sectors 3 (16 KB) and 4 (64 KB); the last two pages of an STM32G4; the last pages
// of its banks; the last sectors of both banks of an STM32H7; others.
const Memory memories[] = {
    {"STM32F4, sectors of a size", {{0x08004000, 16384, 1, 3}}, 4, false, {49152, 4, 16384}},
    {"STM32F4, unequal sectors", {{0x0800C000, 16384, 3, 1}, {0x08010000, 65536, 4, 1}}, 1, false, {32768, 1, 16384}},
    {"STM32G4, one bank", {{0x0807F000, 2048, 126, 2}}, 8, true, {4096, 8, 2048}},
    {"STM32G4, two banks", {{0x0803F000, 2048, 126, 2}, {0x0807F000, 2048, 254, 2}}, 8, true, {8192, 8, 2048}},
    {"STM32H7", {{0x080E0000, 131072, 7, 1}, {0x081E0000, 131072, 15, 1}}, 32, true, {262144, 32, 131072}},
    {"STM32U5", {{0x080FC000, 8192, 126, 2}}, 16, true, {16384, 16, 8192}},
    {"STM32F1", {{0x0800F800, 1024, 62, 4}}, 2, false, {4096, 2, 1024}},
    {"three sizes", {{0x4000, 128, 9, 2}, {0x1000, 64, 0, 3}, {0x2000, 256, 5, 1}}, 4, true, {6 * 64, 4, 64}},
};

FlashModel model_of(const Memory& memory) { return {memory.regions, memory.program_size, memory.has_code}; }

const CO_IF_NVM_DRV_EX& driver = FlashPagesNvmDriver;

const Memory& three_sizes = memories[7];

TEST_CASE("flash_pages: all pages are erase units of the size of the smallest page") {
  for (const Memory& memory : memories) {
    CAPTURE(memory.name);
    FlashModel model = model_of(memory);
    const CO_NVM_SHAPE shape = driver.Shape(model.context());
    CHECK(shape.Capacity == memory.shape.Capacity);
    CHECK(shape.ProgramSize == memory.shape.ProgramSize);
    CHECK(shape.EraseSize == memory.shape.EraseSize);
  }
}

TEST_CASE("flash_pages: addresses of unequal regions are those of the used parts of their pages in the given order") {
  FlashModel model = model_of(three_sizes);
  void* const ctx = model.context();
  const std::uint32_t pages[] = {0x4000, 0x4080, 0x1000, 0x1040, 0x1080, 0x2000};
  Bytes all(384);
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    all[n] = static_cast<std::uint8_t>(n * 7 + n / 64);
  }
  REQUIRE(driver.Erase(ctx, 0, 384));
  REQUIRE(driver.Write(ctx, 0, all.data(), 384) == 384);
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    REQUIRE(model.byte(pages[n / 64] + n % 64) == all[n]);
  }
  CHECK(model.byte(0x4040) == 0xFF);
  CHECK(model.byte(0x2040) == 0xFF);
  Bytes read(384);
  CHECK(driver.Read(ctx, 0, read.data(), 384) == 384);
  CHECK(read == all);
  Bytes some(70, 0xAA);
  CHECK(driver.Read(ctx, 61, some.data(), 70) == 70);
  CHECK(std::equal(some.begin(), some.end(), all.begin() + 61));
  CHECK(model.erases == 6);
  CHECK(model.is_used_well());
}

TEST_CASE("flash_pages: a unit is programmed once after each erase") {
  FlashModel model = model_of(memories[2]);
  void* const ctx = model.context();
  const Bytes zero(16, 0);
  const Bytes ones(16, 0xFF);
  REQUIRE(driver.Write(ctx, 8, zero.data(), 8) == 8);
  CHECK(driver.Write(ctx, 8, zero.data(), 8) == 0);
  CHECK(driver.Write(ctx, 0, zero.data(), 16) == 8);  // the second unit is not erased
  CHECK(model.programs == 2);
  REQUIRE(driver.Erase(ctx, 0, 2048));
  CHECK(driver.Write(ctx, 8, zero.data(), 8) == 8);
  CHECK(model.is_used_well());
  // Units of FFh that were programmed cannot be distinguished; the memory refuses them.
  REQUIRE(driver.Write(ctx, 32, ones.data(), 8) == 8);
  CHECK(driver.Write(ctx, 32, zero.data(), 8) == 0);
}

TEST_CASE("flash_pages: writes of parts of units are refused and those at the end of the memory are truncated") {
  FlashModel model = model_of(memories[2]);
  void* const ctx = model.context();
  const Bytes bytes(32, 3);
  CHECK(driver.Write(ctx, 4, bytes.data(), 8) == 0);
  CHECK(driver.Write(ctx, 0, bytes.data(), 12) == 0);
  CHECK(driver.Write(ctx, 0, bytes.data(), 0) == 0);
  CHECK(driver.Write(ctx, 4096, bytes.data(), 8) == 0);
  CHECK(driver.Write(ctx, 0xFFFFFFF8, bytes.data(), 16) == 0);
  CHECK(model.programs == 0);
  CHECK(driver.Write(ctx, 4088, bytes.data(), 16) == 8);
  CHECK(model.programs == 1);
  CHECK(model.is_used_well());
}

TEST_CASE("flash_pages: only whole erase units within the memory are erased") {
  FlashModel model = model_of(memories[2]);
  void* const ctx = model.context();
  const std::uint32_t ranges[][2] = {{0, 1},       {1, 2048}, {0, 2047},         {2048, 4096},
                                     {4096, 2048}, {0, 8192}, {0xFFFFF800, 4096}};
  for (const auto& range : ranges) {
    CHECK_FALSE(driver.Erase(ctx, range[0], range[1]));
  }
  CHECK(model.erases == 0);
  CHECK(driver.Erase(ctx, 0, 0));
  CHECK(driver.Erase(ctx, 2048, 2048));
  CHECK(model.erases == 1);
  CHECK(model.is_used_well());
}

TEST_CASE("flash_pages: a unit that cannot be read ends a read and is not programmed") {
  FlashModel model = model_of(three_sizes);
  void* const ctx = model.context();
  model.damage(0x1000);
  Bytes read(384);
  CHECK(driver.Read(ctx, 0, read.data(), 384) == 128);  // the pages before the damaged one
  CHECK(driver.Read(ctx, 132, read.data(), 60) == 60);
  CHECK(driver.Write(ctx, 128, read.data(), 4) == 0);
  CHECK(model.programs == 0);
}

TEST_CASE("flash_pages: an error of a function of the memory ends the access") {
  FlashModel model = model_of(memories[2]);
  void* const ctx = model.context();
  const Bytes bytes(64, 5);
  model.fail_at = 3;
  CHECK(driver.Write(ctx, 0, bytes.data(), 64) == 16);
  CHECK(model.programs == 3);
  model.fail_at = 5;
  CHECK_FALSE(driver.Erase(ctx, 0, 4096));
  CHECK(model.erases == 2);
}

TEST_CASE("flash_pages: an impossible geometry has no capacity") {
  FlashModel model = model_of(memories[2]);
  const auto* const good = static_cast<const CO_FLASH_PAGES*>(model.context());
  const auto is_refused = [](CO_FLASH_PAGES flash) {
    std::uint8_t byte[64] = {};
    const bool refused = driver.Shape(&flash).Capacity == 0;
    return refused && driver.Read(&flash, 0, byte, 1) == 0 && driver.Write(&flash, 0, byte, 64) == 0 &&
           !driver.Erase(&flash, 0, 2048);
  };
  CHECK_FALSE(is_refused(*good));
  for (const std::uint32_t size : {0U, 3U, 12U, 33U, 64U}) {
    CAPTURE(size);
    CO_FLASH_PAGES flash = *good;
    flash.ProgramSize = size;
    CHECK(is_refused(flash));
  }
  CO_FLASH_PAGES none = *good;
  none.RegionNum = 0;
  CHECK(is_refused(none));
  const CO_FLASH_REGION without_size[] = {
      {0x0807F000, 2048, 126, 1}, {0x0807F800, 0, 127, 1}, {0x08080000, 4096, 128, 1}};
  CO_FLASH_PAGES gap = *good;
  gap.Regions = without_size;
  gap.RegionNum = 3;
  CHECK(is_refused(gap));
  const CO_FLASH_REGION odd = {0x0807F000, 2044, 126, 2};
  CO_FLASH_PAGES fraction = *good;
  fraction.Regions = &odd;
  CHECK(is_refused(fraction));
}

#ifdef __x86_64__
TEST_CASE("flash_pages: without a Read function the memory is read like RAM") {
  void* const mapped = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_32BIT, -1, 0);
  REQUIRE(mapped != MAP_FAILED);
  std::memset(mapped, 0xFF, 4096);
  const CO_FLASH_REGION region = {static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(mapped)), 1024, 0, 4};
  const CO_FLASH_ACCESS access = {nullptr,
                                  [](void*, std::uint32_t address, const void* unit) {
                                    std::memcpy(reinterpret_cast<void*>(std::uintptr_t{address}), unit, 4);
                                    return true;
                                  },
                                  nullptr};
  CO_FLASH_PAGES flash = {&access, nullptr, &region, 1, 4};
  const Bytes bytes = {1, 2, 3, 4, 5, 6, 7, 8};
  Bytes read(8);
  CHECK(driver.Write(&flash, 1020, bytes.data(), 8) == 8);
  CHECK(driver.Read(&flash, 1020, read.data(), 8) == 8);
  CHECK(read == bytes);
  CHECK(driver.Write(&flash, 1020, bytes.data(), 8) == 0);
  munmap(mapped, 4096);
}
#endif

TEST_CASE("flash_pages: the driver check passes") {
  for (const Memory& memory : memories) {
    if (memory.shape.EraseSize <= 2048) {  // limits the duration
      CAPTURE(memory.name);
      FlashModel model = model_of(memory);
      CHECK(failed_checks(model) == std::vector<std::string>{});
      CHECK(model.is_used_well());
    }
  }
}

#if USE_PARA

TEST_CASE("flash_pages: a loss of power at each operation of the memory leaves the old or the new values") {
  for (const Memory& memory : memories) {
    // Two groups need four slots of 80 bytes.
    if (memory.shape.EraseSize >= 128 && memory.shape.Capacity / memory.shape.EraseSize >= 4) {
      CAPTURE(memory.name);
      const std::uint64_t cuts = cut_each_store(model_of(memory));
      CHECK(cuts >= 4U * 5U * (1 + 80 / CO_STORE_BUFFER));
    }
  }
  const Memory large[] = {{"STM32F4", {{0x08004000, 16384, 1, 3}, {0x08010000, 65536, 4, 1}}, 4, false, {}},
                          {"STM32H7", {{0x080E0000, 2048, 6, 2}, {0x081E0000, 2048, 14, 2}}, 32, true, {}},
                          {"STM32U5", {{0x080FC000, 2048, 126, 4}}, 16, true, {}},
                          {"two pages for a slot", {{0x1000, 64, 0, 5}, {0x2000, 256, 9, 3}}, 8, true, {}}};
  for (const Memory& memory : large) {
    CAPTURE(memory.name);
    CHECK(cut_each_store(model_of(memory)) >= 60);
  }
}

TEST_CASE("flash_pages: a group whose units cannot be read has its default values until it is stored again") {
  FlashModel model = model_of(memories[3]);
  StoredGroup node;
  node.boot(model);
  REQUIRE(node.save(model, values_of(5)) == CO_ERR_NONE);
  REQUIRE(node.save(model, values_of(6)) == CO_ERR_NONE);
  model.damage(0x0803F000);
  model.damage(0x0803F800);
  CHECK(node.boot(model) == StoredGroup::defaults());
  CHECK(node.error == CO_ERR_PARA_LOAD);
  CHECK(node.save(model, values_of(7)) == CO_ERR_NONE);
  CHECK(node.boot(model) == values_of(7));
}

TEST_CASE("flash_pages: an erase without effect that is reported as successful is detected") {
  FlashModel model = model_of(memories[3]);
  StoredGroup node;
  auto* const flash = static_cast<CO_FLASH_PAGES*>(model.context());
  static const CO_FLASH_ACCESS good = *flash->Access;
  static const CO_FLASH_ACCESS weak = {[](void*, std::uint32_t, std::uint32_t) { return true; }, good.Program,
                                       good.Read};
  struct Weak {
    CO_FLASH_PAGES* flash;
    Power power{};
    [[nodiscard]] void* context() const { return flash; }
    static const CO_IF_NVM_DRV_EX& driver() { return FlashPagesNvmDriver; }
  } memory{flash};
  node.boot(memory);
  REQUIRE(node.save(memory, values_of(5)) == CO_ERR_NONE);
  REQUIRE(node.save(memory, values_of(6)) == CO_ERR_NONE);
  flash->Access = &weak;
  CHECK(node.save(memory, values_of(7)) == CO_ERR_IF_NVM_WRITE);
  CHECK(node.boot(memory) == values_of(6));
  CHECK(model.is_used_well());
}

#endif

}  // namespace
