// SPDX-License-Identifier: Apache-2.0
// Access to the numbers that type functions get: in the byte order of the CPU, at any alignment.
#pragma once

#include <stdint.h>

namespace co::integer {

[[nodiscard]] uint16_t get_u16(const void* from);
[[nodiscard]] uint32_t get_u32(const void* from);
void put_u32(void* to, uint32_t value);

}  // namespace co::integer
