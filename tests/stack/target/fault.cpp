// SPDX-License-Identifier: Apache-2.0
// Reads an unaligned word, to check that unaligned accesses cause a fault on the boards where the tests rely on that.
#include <cstdint>

#include "board.hpp"

int main() {
  static std::uint32_t words[2];
  std::uintptr_t address = reinterpret_cast<std::uintptr_t>(words) + 2;
  asm volatile("" : "+r"(address));
  const std::uint32_t word = *reinterpret_cast<volatile std::uint32_t*>(address);
  board::print("read what is not aligned\n");
  return word == 0 ? 0 : 1;
}
