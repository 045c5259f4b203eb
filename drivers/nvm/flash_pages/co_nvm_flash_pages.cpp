// SPDX-License-Identifier: Apache-2.0
#include "co_nvm_flash_pages.h"

#include <string.h>

#include "../memory_parts.hpp"

namespace {

constexpr uint8_t erased = 0xFF;

const CO_FLASH_PAGES& memory(void* ctx) { return *static_cast<const CO_FLASH_PAGES*>(ctx); }

constexpr bool is_unit(uint32_t size) { return size != 0 && size <= CO_FLASH_UNIT_MAX && (size & (size - 1)) == 0; }

// Returns the size of the smallest page, which is the size of every erase unit; 0 if there is no page, or a region has
// none.
uint32_t smallest_page(const CO_FLASH_PAGES& flash) {
  uint32_t smallest = flash.RegionNum != 0 ? flash.Regions[0].PageSize : 0;
  for (uint32_t n = 1; n < flash.RegionNum; ++n) {
    const uint32_t size = flash.Regions[n].PageSize;
    smallest = size < smallest ? size : smallest;
  }
  return smallest;
}

CO_NVM_SHAPE shape(void* ctx) {
  const CO_FLASH_PAGES& flash = memory(ctx);
  const uint32_t page = smallest_page(flash);
  if (page == 0 || !is_unit(flash.ProgramSize) || page % flash.ProgramSize != 0) {
    return {0, 1, 1};
  }
  uint32_t pages = 0;
  for (uint32_t n = 0; n < flash.RegionNum; ++n) {
    pages += flash.Regions[n].PageNum;
  }
  return {pages * page, flash.ProgramSize, page};
}

struct Page {
  uint32_t address;
  uint32_t number;
};

// Returns the page of an erase unit, which must exist.
Page page_of(const CO_FLASH_PAGES& flash, uint32_t unit) {
  const CO_FLASH_REGION* region = flash.Regions;
  while (unit >= region->PageNum) {
    unit -= region->PageNum;
    ++region;
  }
  return {region->Address + unit * region->PageSize, region->FirstNumber + unit};
}

uint32_t physical(const CO_FLASH_PAGES& flash, uint32_t page_size, uint32_t address) {
  return page_of(flash, address / page_size).address + address % page_size;
}

// Reads bytes of one page.
bool read_page(const CO_FLASH_PAGES& flash, uint32_t address, void* to, uint32_t size) {
  if (flash.Access->Read != nullptr) {
    return flash.Access->Read(flash.Ctx, address, to, size);
  }
  memcpy(to, reinterpret_cast<const void*>(static_cast<uintptr_t>(address)), size);
  return true;
}

bool is_erased(const uint8_t* bytes, uint32_t num) {
  uint32_t n = 0;
  while (n < num && bytes[n] == erased) {
    ++n;
  }
  return n == num;
}

// Programs a unit, which must be erased, from an aligned copy of the caller's bytes.
bool program(const CO_FLASH_PAGES& flash, uint32_t address, const uint8_t* from) {
  alignas(8) uint8_t unit[CO_FLASH_UNIT_MAX];
  if (!read_page(flash, address, unit, flash.ProgramSize) || !is_erased(unit, flash.ProgramSize)) {
    return false;
  }
  memcpy(unit, from, flash.ProgramSize);
  return flash.Access->Program(flash.Ctx, address, unit);
}

void init(void* /*ctx*/) {}

uint32_t read(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size) {
  const CO_FLASH_PAGES& flash = memory(ctx);
  const CO_NVM_SHAPE geometry = shape(ctx);
  const uint32_t inside = co::nvm::bytes_inside(geometry.Capacity, start, size);
  return co::nvm::for_parts(start, inside, geometry.EraseSize, [&](uint32_t address, uint32_t done, uint32_t bytes) {
    return read_page(flash, physical(flash, geometry.EraseSize, address), buffer + done, bytes);
  });
}

uint32_t write(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size) {
  const CO_FLASH_PAGES& flash = memory(ctx);
  const CO_NVM_SHAPE geometry = shape(ctx);
  const uint32_t unit = geometry.ProgramSize;
  const uint32_t inside = co::nvm::bytes_inside(geometry.Capacity, start, size);
  if (start % unit != 0 || inside % unit != 0) {
    return 0;
  }
  return co::nvm::for_parts(start, inside, unit, [&](uint32_t address, uint32_t done, uint32_t /*bytes*/) {
    return program(flash, physical(flash, geometry.EraseSize, address), buffer + done);
  });
}

bool erase(void* ctx, uint32_t start, uint32_t size) {
  const CO_FLASH_PAGES& flash = memory(ctx);
  const CO_NVM_SHAPE geometry = shape(ctx);
  if (!co::nvm::has_units(geometry.Capacity, start, size, geometry.EraseSize)) {
    return false;
  }
  const auto erase_page = [&](uint32_t address, uint32_t /*done*/, uint32_t /*bytes*/) {
    const Page page = page_of(flash, address / geometry.EraseSize);
    return flash.Access->Erase(flash.Ctx, page.address, page.number);
  };
  return co::nvm::for_parts(start, size, geometry.EraseSize, erase_page) == size;
}

}  // namespace

const CO_IF_NVM_DRV_EX FlashPagesNvmDriver = {init, read, write, erase, shape};
