// SPDX-License-Identifier: Apache-2.0
#include "registers.hpp"

namespace co::zynqmp {

std::uint32_t read(const volatile std::uint32_t* registers, Register which) {
  return registers[static_cast<unsigned>(which) / 4];
}

void write(volatile std::uint32_t* registers, Register which, std::uint32_t value) {
  registers[static_cast<unsigned>(which) / 4] = value;
}

}  // namespace co::zynqmp
