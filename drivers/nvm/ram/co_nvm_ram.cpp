// SPDX-License-Identifier: Apache-2.0
#include "co_nvm_ram.h"

#include <cstdint>
#include <cstring>

namespace {

constexpr int erased = 0xFF;

CO_NVM_RAM& memory(void* ctx) { return *static_cast<CO_NVM_RAM*>(ctx); }

// Returns the number of bytes of an access that are within the memory.
std::uint32_t bytes_inside(const CO_NVM_RAM& ram, std::uint32_t start, std::uint32_t size) {
  if (start >= ram.Size) {
    return 0;
  }
  const std::uint32_t left = ram.Size - start;
  return (size < left) ? size : left;
}

void init(void* /*ctx*/) {}

std::uint32_t read(void* ctx, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  const CO_NVM_RAM& ram = memory(ctx);
  const std::uint32_t bytes = bytes_inside(ram, start, size);
  if (bytes != 0) {
    std::memcpy(buffer, ram.Mem + start, bytes);
  }
  return bytes;
}

std::uint32_t write(void* ctx, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
  const CO_NVM_RAM& ram = memory(ctx);
  const std::uint32_t bytes = bytes_inside(ram, start, size);
  if (bytes != 0) {
    std::memcpy(ram.Mem + start, buffer, bytes);
  }
  return bytes;
}

CO_NVM_SHAPE shape(void* ctx) { return {memory(ctx).Size, 1, 0}; }

}  // namespace

extern "C" void CONvmRamClear(CO_NVM_RAM* ram) {
  if (ram != nullptr && ram->Size != 0) {
    std::memset(ram->Mem, erased, ram->Size);
  }
}

const CO_IF_NVM_DRV_EX RamNvmDriver = {init, read, write, nullptr, shape};
