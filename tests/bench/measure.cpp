// SPDX-License-Identifier: Apache-2.0
#include "measure.hpp"

namespace bench {

std::uint32_t ticks_of_clock() {
  constexpr unsigned number = 16;
  Operation nothing;
  return static_cast<std::uint32_t>(ticks_of("clock", nothing, number) / number);
}

}  // namespace bench
