// SPDX-License-Identifier: Apache-2.0
// Parameters in the last two pages of each bank of an STM32G4 with 512 KB and two banks (DBANK = 1): pages of 2 KB,
// programmed in double words with an error-correcting code. Source: RM0440, 3.3 and 3.7 (registers).
#include "flash_access.h"
#include "flash_stm32.h"

#define FLASH_ACR 0x40022000u
#define FLASH_KEYR 0x40022008u
#define FLASH_SR 0x40022010u
#define FLASH_CR 0x40022014u
#define FLASH_ECCR 0x40022018u

#define ACR_DCEN (1u << 10)
#define ACR_DCRST (1u << 12)
#define SR_BSY (1u << 16)
#define SR_ERRORS 0xC3FAu  // OPTVERR, RDERR, FASTERR, MISERR, PGSERR, SIZERR, PGAERR, WRPERR, PROGERR, OPERR
#define CR_PG (1u << 0)
#define CR_PER (1u << 1)
#define CR_PNB(page) ((page) << 3)
#define CR_BKER (1u << 11)
#define CR_STRT (1u << 16)
#define CR_LOCK (1u << 31)
#define ECCR_DAMAGED ((1u << 31) | (1u << 29))  // ECCD, ECCD2: two wrong bits

static volatile bool IsReading;
static volatile bool IsDamaged;

// Call this in NMI_Handler(). Returns true if a double word of the parameters that was programmed incompletely was
// read. Otherwise the program itself is damaged, or the NMI has another source.
bool FlashStm32g4Nmi(void) {
  if (!IsReading || (Load(FLASH_ECCR) & ECCR_DAMAGED) == 0) {
    return false;
  }
  IsDamaged = true;
  Store(FLASH_ECCR, Load(FLASH_ECCR) | ECCR_DAMAGED);
  return true;
}

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

static bool ErasePage(void* ctx, uint32_t address, uint32_t number) {
  const uint32_t control = CR_PER | CR_PNB(number % 128u) | (number < 128u ? 0u : CR_BKER);
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

static bool ProgramDoubleWord(void* ctx, uint32_t address, const void* unit) {
  const uint32_t* const words = (const uint32_t*)unit;
  (void)ctx;
  if (!Begin(CR_PG)) {
    return false;
  }
  Store(address, words[0]);
  Barrier();
  Store(address + 4u, words[1]);
  Barrier();
  return End();
}

static bool ReadBytes(void* ctx, uint32_t address, void* to, uint32_t size) {
  (void)ctx;
  IsDamaged = false;
  IsReading = true;
  CopyBytes(address, (uint8_t*)to, size);
  Barrier();
  IsReading = false;
  return !IsDamaged;
}

static const CO_FLASH_ACCESS Access = {ErasePage, ProgramDoubleWord, ReadBytes};
// The first pages are those of bank 2, so that a program in bank 1 continues to run while they are erased.
static const CO_FLASH_REGION Pages[] = {{0x0807F000u, 2048u, 254u, 2u}, {0x0803F000u, 2048u, 126u, 2u}};
const CO_FLASH_PAGES FlashStm32g4 = {&Access, NULL, Pages, 2, 8};
