// SPDX-License-Identifier: Apache-2.0
// Sources: Microchip DS22237C (25A512), DS21204E (25LC040), DS22021F (25AA512); ST M95256, M95128; ON Semiconductor
// CAT25256; Ramtron FM25640, FM25CL64; see docs/drivers/eeprom_spi.md.
#include "co_nvm_eeprom_spi.h"

#include "../memory_parts.hpp"

namespace {

enum Instruction : uint8_t {
  write_data = 0x02,
  read_data = 0x03,
  write_disable = 0x04,
  read_status = 0x05,
  write_enable = 0x06
};

// Bits of the status register
constexpr uint8_t is_writing = 1U << 0;
constexpr uint8_t is_enabled = 1U << 1;

constexpr unsigned byte_bits = 8;
constexpr unsigned longest_address = 3;
constexpr unsigned ninth_bit = 3;      // bit of the instruction that is address bit 8 if the address has one byte
constexpr uint32_t poll_period = 250;  // microseconds
constexpr uint32_t millisecond = 1000;

// Contents of an erased page, transmitted repeatedly.
constexpr uint8_t erased[8] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

const CO_EEPROM_SPI& memory(void* ctx) { return *static_cast<const CO_EEPROM_SPI*>(ctx); }

// Returns the bytes that can be addressed; 0 if the settings of the context are impossible.
uint32_t capacity_of(const CO_EEPROM_SPI& eeprom) {
  if (eeprom.AddressBytes == 0 || eeprom.AddressBytes > longest_address) {
    return 0;
  }
  const unsigned bits = eeprom.AddressBytes == 1 ? byte_bits + 1 : byte_bits * eeprom.AddressBytes;
  return eeprom.Capacity <= 1U << bits ? eeprom.Capacity : 0;
}

// Scope in which the memory is selected.
class Selected {
 public:
  explicit Selected(const CO_EEPROM_SPI& eeprom) : eeprom_(eeprom) { eeprom.Bus->Select(eeprom.BusCtx, true); }
  ~Selected() { eeprom_.Bus->Select(eeprom_.BusCtx, false); }
  Selected(const Selected&) = delete;
  Selected& operator=(const Selected&) = delete;

  void send(const uint8_t* bytes, uint32_t num) const { eeprom_.Bus->Transfer(eeprom_.BusCtx, bytes, nullptr, num); }
  void receive(uint8_t* bytes, uint32_t num) const { eeprom_.Bus->Transfer(eeprom_.BusCtx, nullptr, bytes, num); }

  void send(Instruction instruction) const {
    const uint8_t byte = instruction;
    send(&byte, 1);
  }

  void send(Instruction instruction, uint32_t address) const {
    const unsigned num = eeprom_.AddressBytes;
    uint8_t bytes[1 + longest_address] = {};
    const uint32_t ninth = num == 1 ? address >> byte_bits << ninth_bit : 0;
    bytes[0] = static_cast<uint8_t>(instruction | ninth);
    for (unsigned n = num; n != 0; --n) {
      bytes[n] = static_cast<uint8_t>(address);
      address >>= byte_bits;
    }
    send(bytes, 1 + num);
  }

 private:
  const CO_EEPROM_SPI& eeprom_;
};

void command(const CO_EEPROM_SPI& eeprom, Instruction instruction) { Selected(eeprom).send(instruction); }

uint8_t status(const CO_EEPROM_SPI& eeprom) {
  const Selected selected(eeprom);
  uint8_t value = 0;
  selected.send(read_status);
  selected.receive(&value, 1);
  return value;
}

// Waits until no write cycle is in progress, for the time of a write cycle at most.
bool await_ready(const CO_EEPROM_SPI& eeprom) {
  for (uint32_t waited = 0;; waited += poll_period) {
    if ((status(eeprom) & is_writing) == 0) {
      return true;
    }
    if (waited >= eeprom.WriteTime * millisecond) {
      return false;
    }
    eeprom.Bus->Wait(eeprom.BusCtx, poll_period);
  }
}

// Sets or clears the write enable latch. Returns whether the status confirms it.
bool change_latch(const CO_EEPROM_SPI& eeprom, bool enable) {
  command(eeprom, enable ? write_enable : write_disable);
  return (status(eeprom) & (is_writing | is_enabled)) == (enable ? is_enabled : 0);
}

// Returns whether the memory executes instructions. If so, clears the write enable latch.
bool is_present(const CO_EEPROM_SPI& eeprom) { return change_latch(eeprom, true) && change_latch(eeprom, false); }

// Returns whether the memory has the bytes that write_page() has written.
bool has_bytes(const CO_EEPROM_SPI& eeprom, uint32_t address, const uint8_t* from, uint32_t num, uint32_t period) {
  const Selected selected(eeprom);
  selected.send(read_data, address);
  bool is_same = true;
  for (uint32_t n = 0; n < num; ++n) {
    uint8_t byte = 0;
    selected.receive(&byte, 1);
    is_same = is_same && byte == from[n % period];
  }
  return is_same;
}

// Writes num bytes of one page, waits for the end of the write cycle and reads the bytes back: SPI has no
// acknowledgement. The period bytes at from are repeated.
bool write_page(const CO_EEPROM_SPI& eeprom, uint32_t address, const uint8_t* from, uint32_t num, uint32_t period) {
  if (!await_ready(eeprom) || !change_latch(eeprom, true)) {
    return false;
  }
  {
    const Selected selected(eeprom);
    selected.send(write_data, address);
    for (uint32_t left = num; left != 0;) {
      const uint32_t piece = left < period ? left : period;
      selected.send(from, piece);
      left -= piece;
    }
  }
  return await_ready(eeprom) && has_bytes(eeprom, address, from, num, period);
}

// Returns the boundary that no write crosses.
uint32_t write_boundary(const CO_EEPROM_SPI& eeprom) { return eeprom.PageSize == 0 ? UINT32_MAX : eeprom.PageSize; }

void init(void* /*ctx*/) {}

uint32_t read(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size) {
  const CO_EEPROM_SPI& eeprom = memory(ctx);
  const uint32_t inside = co::nvm::bytes_inside(capacity_of(eeprom), start, size);
  if (inside == 0 || !await_ready(eeprom)) {
    return 0;
  }
  {
    const Selected selected(eeprom);
    selected.send(read_data, start);
    selected.receive(buffer, inside);
  }
  return is_present(eeprom) ? inside : 0;
}

uint32_t write(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size) {
  const CO_EEPROM_SPI& eeprom = memory(ctx);
  const uint32_t inside = co::nvm::bytes_inside(capacity_of(eeprom), start, size);
  const auto write_part = [&](uint32_t address, uint32_t done, uint32_t bytes) {
    return write_page(eeprom, address, buffer + done, bytes, bytes);
  };
  const uint32_t done = co::nvm::for_parts(start, inside, write_boundary(eeprom), write_part);
  return is_present(eeprom) ? done : 0;
}

bool erase(void* ctx, uint32_t start, uint32_t size) {
  const CO_EEPROM_SPI& eeprom = memory(ctx);
  if (!co::nvm::has_units(capacity_of(eeprom), start, size, CO_EEPROM_UNIT(eeprom.PageSize))) {
    return false;
  }
  const auto erase_page = [&](uint32_t address, uint32_t /*done*/, uint32_t bytes) {
    return write_page(eeprom, address, erased, bytes, sizeof erased);
  };
  return co::nvm::for_parts(start, size, write_boundary(eeprom), erase_page) == size && is_present(eeprom);
}

CO_NVM_SHAPE shape(void* ctx) {
  const CO_EEPROM_SPI& eeprom = memory(ctx);
  return co::nvm::shape_of_pages(capacity_of(eeprom), eeprom.PageSize, CO_EEPROM_PROGRAM(eeprom.PageSize));
}

}  // namespace

const CO_IF_NVM_DRV_EX EepromSpiNvmDriver = {init, read, write, erase, shape};
