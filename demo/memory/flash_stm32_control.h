// SPDX-License-Identifier: Apache-2.0
/// \file flash_stm32_control.h
/// The flash controller that STM32F4 and STM32G4 have in common. The source that includes it has defined the addresses
/// of its registers before, FLASH_ACR, FLASH_KEYR, FLASH_SR and FLASH_CR, and the bits SR_ERRORS.
#ifndef FLASH_STM32_CONTROL_H_
#define FLASH_STM32_CONTROL_H_

#include "flash_access.h"

#define ACR_DCEN (1u << 10)
#define ACR_DCRST (1u << 12)
#define SR_BSY (1u << 16)
#define CR_PG (1u << 0)
#define CR_STRT (1u << 16)
#define CR_LOCK (1u << 31)

// Unlocks the controller and sets its control register. Returns false if it is busy or stays locked.
static bool Begin(uint32_t control) {
  if (!AwaitClear(FLASH_SR, SR_BSY)) {
    return false;
  }
  Store(FLASH_SR, SR_ERRORS);
  if ((Load(FLASH_CR) & CR_LOCK) != 0) {
    Store(FLASH_KEYR, 0x45670123u);
    Store(FLASH_KEYR, 0xCDEF89ABu);
  }
  Store(FLASH_CR, control);
  return (Load(FLASH_CR) & CR_LOCK) == 0;
}

// Awaits the end of an operation and locks the controller. Returns false after an error.
static bool End(void) {
  const bool ended = AwaitClear(FLASH_SR, SR_BSY);
  const uint32_t errors = Load(FLASH_SR) & SR_ERRORS;
  Store(FLASH_CR, CR_LOCK);
  return ended && errors == 0;
}

// Empties the data cache, which may contain bytes from before an erase.
static void EmptyCache(void) {
  const uint32_t acr = Load(FLASH_ACR);
  Store(FLASH_ACR, acr & ~ACR_DCEN);
  Store(FLASH_ACR, (acr & ~ACR_DCEN) | ACR_DCRST);
  Store(FLASH_ACR, acr & ~ACR_DCEN);
  Store(FLASH_ACR, acr);
}

#endif
