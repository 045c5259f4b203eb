// SPDX-License-Identifier: Apache-2.0
// Sources: Microchip DS20001203X (24LC256), DS21703L (24LC16B), DS20001941L (24LC1025); Atmel AT24C256C; ST M24256,
// M24128; see docs/drivers/eeprom_i2c.md.
#include "co_nvm_eeprom_i2c.h"

#include "../memory_parts.hpp"

namespace {

constexpr unsigned byte_bits = 8;
constexpr unsigned longest_address = 3;
constexpr uint32_t most_blocks = 8;    // three bits of the device address
constexpr uint32_t poll_period = 250;  // microseconds
constexpr uint32_t millisecond = 1000;

// Contents of an erased page. Longer pages are erased in several write cycles.
constexpr uint8_t erased[64] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                                0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                                0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                                0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,
                                0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

const CO_EEPROM_I2C& memory(void* ctx) { return *static_cast<const CO_EEPROM_I2C*>(ctx); }

// Device address and address bytes of a location.
struct Location {
  uint8_t device;
  uint8_t bytes[longest_address];
};

// Returns the number of bytes that the address bytes can address: the size of a block.
uint32_t block_size(const CO_EEPROM_I2C& eeprom) {
  return eeprom.AddressBytes <= longest_address ? 1U << (byte_bits * eeprom.AddressBytes) : UINT32_MAX;
}

// Returns the bytes that can be addressed; 0 if the settings of the context are impossible.
uint32_t capacity_of(const CO_EEPROM_I2C& eeprom) {
  const bool has_address = eeprom.AddressBytes != 0 && eeprom.AddressBytes <= longest_address;
  const bool is_possible =
      has_address && eeprom.Capacity != 0 && (eeprom.Capacity - 1) / block_size(eeprom) < most_blocks;
  return is_possible ? eeprom.Capacity : 0;
}

Location locate(const CO_EEPROM_I2C& eeprom, uint32_t address) {
  const uint32_t block = address / block_size(eeprom);
  Location location = {static_cast<uint8_t>(eeprom.Device | block << eeprom.BlockShift), {}};
  for (unsigned n = eeprom.AddressBytes; n != 0; --n) {
    location.bytes[n - 1] = static_cast<uint8_t>(address);
    address >>= byte_bits;
  }
  return location;
}

// Waits until the device acknowledges its address, for the time of a write cycle at most.
bool await_ready(const CO_EEPROM_I2C& eeprom, uint8_t device) {
  for (uint32_t waited = 0;; waited += poll_period) {
    if (eeprom.Bus->Write(eeprom.BusCtx, device, nullptr, 0, nullptr, 0)) {
      return true;
    }
    if (waited >= eeprom.WriteTime * millisecond) {
      return false;
    }
    eeprom.Bus->Wait(eeprom.BusCtx, poll_period);
  }
}

// Writes a part of one page and waits for the end of the write cycle.
bool write_page(const CO_EEPROM_I2C& eeprom, uint32_t address, const uint8_t* from, uint32_t num) {
  const Location to = locate(eeprom, address);
  return await_ready(eeprom, to.device) &&
         eeprom.Bus->Write(eeprom.BusCtx, to.device, to.bytes, eeprom.AddressBytes, from, num) &&
         await_ready(eeprom, to.device);
}

// Reads bytes of one block. A device that is lost meanwhile returns FFh, so it is addressed once more at the end.
bool read_block(const CO_EEPROM_I2C& eeprom, uint32_t address, uint8_t* to, uint32_t num) {
  const Location from = locate(eeprom, address);
  return await_ready(eeprom, from.device) &&
         eeprom.Bus->Read(eeprom.BusCtx, from.device, from.bytes, eeprom.AddressBytes, to, num) &&
         eeprom.Bus->Write(eeprom.BusCtx, from.device, nullptr, 0, nullptr, 0);
}

// Returns the boundary that no write crosses.
uint32_t write_boundary(const CO_EEPROM_I2C& eeprom) {
  return eeprom.PageSize == 0 ? block_size(eeprom) : eeprom.PageSize;
}

void init(void* /*ctx*/) {}

uint32_t read(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size) {
  const CO_EEPROM_I2C& eeprom = memory(ctx);
  const uint32_t inside = co::nvm::bytes_inside(capacity_of(eeprom), start, size);
  return co::nvm::for_parts(start, inside, block_size(eeprom), [&](uint32_t address, uint32_t done, uint32_t bytes) {
    return read_block(eeprom, address, buffer + done, bytes);
  });
}

uint32_t write(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size) {
  const CO_EEPROM_I2C& eeprom = memory(ctx);
  const uint32_t inside = co::nvm::bytes_inside(capacity_of(eeprom), start, size);
  return co::nvm::for_parts(start, inside, write_boundary(eeprom),
                            [&](uint32_t address, uint32_t done, uint32_t bytes) {
                              return write_page(eeprom, address, buffer + done, bytes);
                            });
}

bool erase(void* ctx, uint32_t start, uint32_t size) {
  const CO_EEPROM_I2C& eeprom = memory(ctx);
  if (!co::nvm::has_units(capacity_of(eeprom), start, size, CO_EEPROM_UNIT(eeprom.PageSize))) {
    return false;
  }
  const uint32_t boundary = eeprom.PageSize != 0 && eeprom.PageSize < sizeof erased ? eeprom.PageSize : sizeof erased;
  const auto erase_part = [&](uint32_t address, uint32_t /*done*/, uint32_t bytes) {
    return write_page(eeprom, address, erased, bytes);
  };
  return co::nvm::for_parts(start, size, boundary, erase_part) == size;
}

CO_NVM_SHAPE shape(void* ctx) {
  const CO_EEPROM_I2C& eeprom = memory(ctx);
  return co::nvm::shape_of_pages(capacity_of(eeprom), eeprom.PageSize, CO_EEPROM_PROGRAM(eeprom.PageSize));
}

}  // namespace

const CO_IF_NVM_DRV_EX EepromI2cNvmDriver = {init, read, write, erase, shape};
