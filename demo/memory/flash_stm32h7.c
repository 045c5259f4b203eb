// SPDX-License-Identifier: Apache-2.0
// Parameters in the last sector of each bank of an STM32H743 with 2 MB: sectors of 128 KB, programmed in words of 256
// bits with an error-correcting code. Source: RM0433, 4.3 and 4.9 (registers); ARM DDI 0403, B3.2.8 (BFHFNMIGN).
#include "flash_access.h"
#include "flash_stm32.h"

// Registers of bank 1; those of bank 2 are 100h behind them.
#define FLASH_KEYR 0x52002004u
#define FLASH_CR 0x5200200Cu
#define FLASH_SR 0x52002010u
#define FLASH_CCR 0x52002014u
#define SCB_DCIMVAC 0xE000EF5Cu

#define SR_BUSY 0x7u            // BSY, WBNE, QW
#define SR_ERRORS 0x1EE0000u    // RDSERR, RDPERR, OPERR, INCERR, STRBERR, PGSERR, WRPERR
#define SR_DBECCERR (1u << 26)  // two wrong bits
#define CR_LOCK (1u << 0)
#define CR_PG (1u << 1)
#define CR_SER (1u << 2)
#define CR_PSIZE_64 (3u << 4)
#define CR_START (1u << 7)
#define CR_SNB(sector) ((sector) << 8)

#define SECTOR 131072u
#define UNIT 32u

// Returns the distance of the registers of a bank from those of bank 1.
static uint32_t BankOf(uint32_t address) { return address < 0x08100000u ? 0u : 0x100u; }

static bool Begin(uint32_t bank, uint32_t control) {
  if (!AwaitClear(FLASH_SR + bank, SR_BUSY)) {
    return false;
  }
  Store(FLASH_CCR + bank, SR_ERRORS);
  if ((Load(FLASH_CR + bank) & CR_LOCK) != 0) {
    Store(FLASH_KEYR + bank, 0x45670123u);
    Store(FLASH_KEYR + bank, 0xCDEF89ABu);
  }
  Store(FLASH_CR + bank, control);
  return (Load(FLASH_CR + bank) & CR_LOCK) == 0;
}

static bool End(uint32_t bank) {
  const bool ended = AwaitClear(FLASH_SR + bank, SR_BUSY);
  const uint32_t errors = Load(FLASH_SR + bank) & SR_ERRORS;
  Store(FLASH_CR + bank, CR_LOCK);
  return ended && errors == 0;
}

// Removes lines of the memory from the data cache of the CPU.
static void ForgetLines(uint32_t address, uint32_t size) {
  Barrier();
  for (uint32_t n = 0; n < size; n += 32u) {
    Store(SCB_DCIMVAC, address + n);
  }
  Barrier();
}

static bool EraseSector(void* ctx, uint32_t address, uint32_t number) {
  const uint32_t bank = BankOf(address);
  const uint32_t control = CR_SER | CR_SNB(number % 8u) | CR_PSIZE_64;
  (void)ctx;
  if (!Begin(bank, control)) {
    return false;
  }
  Store(FLASH_CR + bank, control | CR_START);
  const bool erased = End(bank);
  ForgetLines(address, SECTOR);
  return erased;
}

static bool ProgramUnit(void* ctx, uint32_t address, const void* unit) {
  const uint32_t* const words = (const uint32_t*)unit;
  const uint32_t bank = BankOf(address);
  (void)ctx;
  if (!Begin(bank, CR_PG | CR_PSIZE_64)) {
    return false;
  }
  Barrier();
  for (uint32_t n = 0; n < UNIT / 4u; ++n) {
    Store(address + 4u * n, words[n]);
  }
  Barrier();
  const bool programmed = End(bank);
  ForgetLines(address, UNIT);
  return programmed;
}

// Reads with interrupts and bus faults disabled: a unit that was programmed incompletely raises a bus fault.
static bool ReadBytes(void* ctx, uint32_t address, void* to, uint32_t size) {
  const uint32_t bank = BankOf(address);
  (void)ctx;
  Store(FLASH_CCR + bank, SR_DBECCERR);
  const uint32_t before = IgnoreFaults();
  CopyBytes(address, (uint8_t*)to, size);
  RestoreFaults(before);
  return (Load(FLASH_SR + bank) & SR_DBECCERR) == 0;
}

static const CO_FLASH_ACCESS Access = {EraseSector, ProgramUnit, ReadBytes};
static const CO_FLASH_REGION Sectors[] = {{0x080E0000u, SECTOR, 7u, 1u}, {0x081E0000u, SECTOR, 15u, 1u}};
const CO_FLASH_PAGES FlashStm32h7 = {&Access, NULL, Sectors, 2, UNIT};
