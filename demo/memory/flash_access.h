// SPDX-License-Identifier: Apache-2.0
/// \file flash_access.h
/// Accesses of the examples to registers and flash memory, as words of 32 bits. With LEXICAN_REGISTER_MODEL defined,
/// they call a model, which a test defines.
#ifndef FLASH_ACCESS_H_
#define FLASH_ACCESS_H_

#include <stdbool.h>
#include <stdint.h>

/// Number of times that a status register is read before an operation has failed. An erase takes up to 4 seconds; a
/// product feeds its watchdog meanwhile.
#ifndef FLASH_WAIT_LIMIT
#define FLASH_WAIT_LIMIT 400000000u
#endif

#ifdef LEXICAN_REGISTER_MODEL

uint32_t lexican_model_read(uintptr_t address);
void lexican_model_write(uintptr_t address, uint32_t value);

static inline uint32_t Load(uint32_t address) { return lexican_model_read(address); }
static inline void Store(uint32_t address, uint32_t value) { lexican_model_write(address, value); }
static inline void Barrier(void) {}
static inline uint32_t IgnoreFaults(void) { return 0; }
static inline void RestoreFaults(uint32_t before) { (void)before; }

#else

/// Returns a word.
static inline uint32_t Load(uint32_t address) { return *(const volatile uint32_t*)(uintptr_t)address; }
/// Writes a word.
static inline void Store(uint32_t address, uint32_t value) { *(volatile uint32_t*)(uintptr_t)address = value; }
/// Completes all accesses before it.
static inline void Barrier(void) { __asm volatile("dsb\n\tisb" ::: "memory"); }

#if defined(__ARM_ARCH_7M__) || defined(__ARM_ARCH_7EM__)

#define SCB_CCR 0xE000ED14u
#define CCR_BFHFNMIGN (1u << 8)

/// Lets the CPU ignore bus faults of loads and stores, and disables interrupts. Returns the mask for RestoreFaults().
static inline uint32_t IgnoreFaults(void) {
  uint32_t before;
  __asm volatile("mrs %0, faultmask\n\tcpsid f" : "=r"(before)::"memory");
  Store(SCB_CCR, Load(SCB_CCR) | CCR_BFHFNMIGN);
  Barrier();
  return before;
}

/// Ends IgnoreFaults().
static inline void RestoreFaults(uint32_t before) {
  Barrier();
  Store(SCB_CCR, Load(SCB_CCR) & ~CCR_BFHFNMIGN);
  __asm volatile("msr faultmask, %0" ::"r"(before) : "memory");
}

#endif
#endif

/// Waits until bits of a register are 0. Returns false after FLASH_WAIT_LIMIT readings.
static inline bool AwaitClear(uint32_t address, uint32_t bits) {
  for (uint32_t n = 0; n < FLASH_WAIT_LIMIT; ++n) {
    if ((Load(address) & bits) == 0) {
      return true;
    }
  }
  return false;
}

/// Copies bytes of the flash memory.
static inline void CopyBytes(uint32_t address, uint8_t* to, uint32_t size) {
  for (uint32_t n = 0; n < size; ++n, ++address) {
    to[n] = (uint8_t)(Load(address & ~3u) >> 8u * (address & 3u));
  }
}

#endif
