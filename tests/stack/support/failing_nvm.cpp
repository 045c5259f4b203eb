// SPDX-License-Identifier: Apache-2.0
#include "failing_nvm.hpp"

namespace test {

// Executes one step. Returns false if the power is off, or is lost in this step.
bool FailingNvm::step(std::uint8_t& byte, std::uint8_t to) {
  if (is_off) {
    return false;
  }
  ++steps;
  if (steps != cut_at) {
    byte = steps >= ignore_from && steps < ignore_to ? byte : to;
    return true;
  }
  is_off = true;
  switch (partial_write) {
    case PartialWrite::untouched: break;
    case PartialWrite::half: byte = static_cast<std::uint8_t>((byte & 0xF0U) | (to & 0x0FU)); break;
    case PartialWrite::garbage: byte = static_cast<std::uint8_t>(byte ^ 0x5AU); break;
    case PartialWrite::done: byte = to; break;
  }
  return false;
}

void FailingNvm::power_up() {
  is_off = false;
  cut_at = 0;
  steps = 0;
}

void FailingNvm::check(std::uint32_t start, std::uint32_t size, std::uint32_t unit) {
  misused |= start % unit != 0 || size % unit != 0 || size > bytes.size() || start > bytes.size() - size;
}

struct FailingNvmDriver {
  static FailingNvm& memory(void* context) { return *static_cast<FailingNvm*>(context); }

  static void init(void*) {}

  static std::uint32_t read(void* context, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
    FailingNvm& nvm = memory(context);
    nvm.check(start, size, 1);
    const bool is_torn = start < nvm.torn_to && start + size > nvm.torn_from;
    if (nvm.misused || nvm.is_off || ++nvm.reads == nvm.refuse_read || is_torn || nvm.is_deaf) {
      return 0;
    }
    for (std::uint32_t n = 0; n < size; ++n) {
      buffer[n] = nvm.bytes[start + n];
    }
    if (nvm.reads == nvm.corrupt_read && size != 0) {
      buffer[size / 2] ^= 0x10;
    }
    return size;
  }

  static std::uint32_t write(void* context, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
    FailingNvm& nvm = memory(context);
    nvm.check(start, size, nvm.shape.ProgramSize);
    std::uint32_t done = 0;
    for (; !nvm.misused && done < size; ++done) {
      std::uint8_t& byte = nvm.bytes[start + done];
      nvm.misused |= nvm.shape.EraseSize != 0 && byte != 0xFF && nvm.ignore_to == 0;
      if (!nvm.step(byte, buffer[done])) {
        break;
      }
    }
    return done;
  }

  static bool erase(void* context, std::uint32_t start, std::uint32_t size) {
    FailingNvm& nvm = memory(context);
    nvm.check(start, size, nvm.shape.EraseSize);
    std::uint32_t done = 0;
    if (start <= nvm.torn_from && start + size >= nvm.torn_to) {
      nvm.torn_from = nvm.torn_to = 0;
    }
    while (!nvm.misused && done < size && nvm.step(nvm.bytes[start + done], 0xFF)) {
      ++done;
    }
    return done == size;
  }

  static CO_NVM_SHAPE shape(void* context) { return memory(context).shape; }
};

const CO_IF_NVM_DRV_EX FailingNvm::driver = {FailingNvmDriver::init, FailingNvmDriver::read, FailingNvmDriver::write,
                                             FailingNvmDriver::erase, FailingNvmDriver::shape};

}  // namespace test
