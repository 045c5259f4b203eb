// SPDX-License-Identifier: Apache-2.0
/// \file registers.h
/// The only two functions by which drivers/can/bxcan, fdcan, flexcan and, for TWAI, sja1000 access registers and
/// message memory. Each accesses one aligned word of 32 bits. They compile to single loads and stores.
///
/// With LEXICAN_REGISTER_MODEL defined (by a test, for the driver's source and for the test), they call a model of the
/// controller instead. Addresses are passed as the driver computes them, so the registers need not be memory.
#ifndef LEXICAN_DRIVERS_CAN_REGISTERS_H_
#define LEXICAN_DRIVERS_CAN_REGISTERS_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifdef LEXICAN_REGISTER_MODEL

/// Returns the value of a register. Defined by the test.
uint32_t lexican_model_read(uintptr_t address);
/// Writes a register. Defined by the test.
void lexican_model_write(uintptr_t address, uint32_t value);

// NOLINTBEGIN(cppcoreguidelines-pro-type-cstyle-cast): a header of C
static inline uint32_t lexican_reg_read(const volatile uint32_t* reg) { return lexican_model_read((uintptr_t)reg); }
static inline void lexican_reg_write(volatile uint32_t* reg, uint32_t value) {
  lexican_model_write((uintptr_t)reg, value);
}
// NOLINTEND(cppcoreguidelines-pro-type-cstyle-cast)

#else

/// Returns the value of a register.
static inline uint32_t lexican_reg_read(const volatile uint32_t* reg) { return *reg; }
/// Writes a register.
static inline void lexican_reg_write(volatile uint32_t* reg, uint32_t value) { *reg = value; }

#endif

#ifdef __cplusplus
}
#endif

#endif
