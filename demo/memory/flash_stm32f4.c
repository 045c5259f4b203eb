// SPDX-License-Identifier: Apache-2.0
// Parameters in sectors 1 and 2 (16 KB each) of an STM32F4. Source: RM0090, 3.5 (STM32F405 to 439) and 3.9 (registers).
// The linker script keeps these sectors free: the vector table is in sector 0, the program begins in sector 3.
#include "flash_access.h"
#include "flash_stm32.h"

#define FLASH_ACR 0x40023C00u
#define FLASH_KEYR 0x40023C04u
#define FLASH_SR 0x40023C0Cu
#define FLASH_CR 0x40023C10u

#define ACR_DCEN (1u << 10)
#define ACR_DCRST (1u << 12)
#define SR_BSY (1u << 16)
#define SR_ERRORS 0x1F2u  // RDERR, PGSERR, PGPERR, PGAERR, WRPERR, OPERR
#define CR_PG (1u << 0)
#define CR_SER (1u << 1)
#define CR_SNB(sector) ((sector) << 3)
#define CR_PSIZE_32 (2u << 8)  // 32 bits at a time: VDD is 2.7 V or more
#define CR_STRT (1u << 16)
#define CR_LOCK (1u << 31)

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

static bool EraseSector(void* ctx, uint32_t address, uint32_t number) {
  const uint32_t code = number < 12u ? number : number + 4u;  // sectors of the second bank begin with 10h
  const uint32_t control = CR_SER | CR_SNB(code) | CR_PSIZE_32;
  (void)ctx;
  (void)address;
  if (!Begin(control)) {
    return false;
  }
  Store(FLASH_CR, control | CR_STRT);
  const bool erased = End();
  EmptyCache();
  return erased;
}

static bool ProgramWord(void* ctx, uint32_t address, const void* unit) {
  (void)ctx;
  if (!Begin(CR_PG | CR_PSIZE_32)) {
    return false;
  }
  Store(address, *(const uint32_t*)unit);
  Barrier();
  return End();
}

static bool ReadBytes(void* ctx, uint32_t address, void* to, uint32_t size) {
  (void)ctx;
  CopyBytes(address, (uint8_t*)to, size);
  return true;
}

static const CO_FLASH_ACCESS Access = {EraseSector, ProgramWord, ReadBytes};
static const CO_FLASH_REGION Sectors[] = {{0x08004000u, 16384u, 1u, 2u}};  // address, size, number of the first, count
const CO_FLASH_PAGES FlashStm32f4 = {&Access, NULL, Sectors, 1, 4};
