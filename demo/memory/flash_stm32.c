// SPDX-License-Identifier: Apache-2.0
// Parameters in the flash memory of an STM32F4 or STM32G4. Their flash controllers differ in these values only.
#include "flash_stm32.h"
#include "flash_access.h"

typedef struct FAMILY {
  uint32_t Acr, Keyr;  // addresses of registers; SR and CR follow KEYR
  uint32_t Errors;     // SR: all bits …ERR
  uint32_t Width;      // CR: bits of a write access
  uint32_t BankPages;  // number of pages in bank 1
  uint32_t Bank2;      // CR: the page is in bank 2
  uint32_t UnitWords;  // words of 32 bits that are programmed together
} FAMILY;

// STM32F4: sectors 1 and 2, 16 KB each. Source: RM0090, 3.5 (STM32F405 to 439) and 3.9 (registers). The linker script
// keeps these sectors free: the vector table is in sector 0, the program begins in sector 3.
static const FAMILY F4 = {.Acr = 0x40023C00u,
                          .Keyr = 0x40023C04u,
                          .Errors = 0x1F2u,  // RD, PGS, PGP, PGA, WRP, OP
                          .Width = 2u << 8,  // PSIZE: 32 bits, if VDD is 2.7 V or more
                          .BankPages = 12u,
                          .Bank2 = 0x10u << 3,
                          .UnitWords = 1u};
// Address, size, number of the first sector, count
static const CO_FLASH_REGION SectorsF4[] = {{0x08004000u, 16384u, 1u, 2u}};

// STM32G4 with 512 KB and two banks (DBANK = 1): the last two pages of each bank, 2 KB each, programmed in double words
// with an error-correcting code. Source: RM0440, 3.3 and 3.7 (registers). The first pages are those of bank 2, so that
// a program in bank 1 continues to run while they are erased.
static const FAMILY G4 = {.Acr = 0x40022000u,
                          .Keyr = 0x40022008u,
                          .Errors = 0xC3FAu,  // OPTV, RD, FAST, MIS, PGS, SIZ, PGA, WRP, PROG, OP
                          .BankPages = 128u,
                          .Bank2 = 1u << 11,  // BKER
                          .UnitWords = 2u};
static const CO_FLASH_REGION PagesG4[] = {{0x0807F000u, 2048u, 254u, 2u}, {0x0803F000u, 2048u, 126u, 2u}};
#define G4_ECCR 0x40022018u
#define ECCR_DAMAGED ((1u << 31) | (1u << 29))  // ECCD, ECCD2: two wrong bits

#define SR(flash) ((flash)->Keyr + 8u)
#define CR(flash) ((flash)->Keyr + 12u)
#define ACR_DCEN (1u << 10)
#define ACR_DCRST (1u << 12)
#define SR_BSY (1u << 16)
#define CR_PG (1u << 0)
#define CR_ERASE (1u << 1)
#define CR_PAGE(number) ((number) << 3)
#define CR_STRT (1u << 16)
#define CR_LOCK (1u << 31)

static volatile bool IsReading;
static volatile bool IsDamaged;

// Call this in NMI_Handler(). Returns true if a double word of the parameters that was programmed incompletely was
// read. Otherwise the program itself is damaged, or the NMI has another source.
bool FlashStm32g4Nmi(void) {
  if (!IsReading || (Load(G4_ECCR) & ECCR_DAMAGED) == 0) {
    return false;
  }
  IsDamaged = true;
  Store(G4_ECCR, Load(G4_ECCR) | ECCR_DAMAGED);
  return true;
}

static bool Begin(const FAMILY* flash, uint32_t control) {
  if (!AwaitClear(SR(flash), SR_BSY)) {
    return false;
  }
  Store(SR(flash), flash->Errors);
  if ((Load(CR(flash)) & CR_LOCK) != 0) {
    Store(flash->Keyr, 0x45670123u);
    Store(flash->Keyr, 0xCDEF89ABu);
  }
  Store(CR(flash), control);
  return (Load(CR(flash)) & CR_LOCK) == 0;
}

static bool End(const FAMILY* flash) {
  const bool ended = AwaitClear(SR(flash), SR_BSY);
  const uint32_t errors = Load(SR(flash)) & flash->Errors;
  Store(CR(flash), CR_LOCK);
  return ended && errors == 0;
}

// Empties the data cache, which may contain bytes from before an erase.
static void EmptyCache(const FAMILY* flash) {
  const uint32_t acr = Load(flash->Acr);
  Store(flash->Acr, acr & ~ACR_DCEN);
  Store(flash->Acr, (acr & ~ACR_DCEN) | ACR_DCRST);
  Store(flash->Acr, acr & ~ACR_DCEN);
  Store(flash->Acr, acr);
}

static bool ErasePage(void* ctx, uint32_t address, uint32_t number) {
  const FAMILY* const flash = (const FAMILY*)ctx;
  const uint32_t page = number < flash->BankPages ? CR_PAGE(number) : CR_PAGE(number - flash->BankPages) | flash->Bank2;
  const uint32_t control = CR_ERASE | page | flash->Width;
  (void)address;
  if (!Begin(flash, control)) {
    return false;
  }
  Store(CR(flash), control | CR_STRT);
  const bool erased = End(flash);
  EmptyCache(flash);
  return erased;
}

static bool ProgramUnit(void* ctx, uint32_t address, const void* unit) {
  const FAMILY* const flash = (const FAMILY*)ctx;
  const uint32_t* const words = (const uint32_t*)unit;
  if (!Begin(flash, CR_PG | flash->Width)) {
    return false;
  }
  for (uint32_t n = 0; n < flash->UnitWords; ++n) {
    Store(address + 4u * n, words[n]);
    Barrier();
  }
  return End(flash);
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

static const CO_FLASH_ACCESS Access = {ErasePage, ProgramUnit, ReadBytes};
const CO_FLASH_PAGES FlashStm32f4 = {&Access, (void*)&F4, SectorsF4, 1, 4};
const CO_FLASH_PAGES FlashStm32g4 = {&Access, (void*)&G4, PagesG4, 2, 8};
