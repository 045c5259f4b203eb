// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_flash_pages.h
/// Memory driver for flash memory that is erased by pages and programmed in units, such as the flash of a
/// microcontroller (docs/drivers/flash_pages.md). C and C++, bare metal or in a task of an RTOS. Tested on a model, not
/// on silicon.
///
///     static const CO_FLASH_REGION regions[] = {{0x0803F000, 2048, 126, 2}};  // address, page size, number, count
///     static const CO_FLASH_ACCESS access = {ErasePage, ProgramUnit, ReadFlash};
///     static const CO_FLASH_PAGES flash = {&access, NULL, regions, 1, 8};     // programmed in units of 8 bytes
///     ext.Nvm = &FlashPagesNvmDriver;  ext.NvmCtx = (void*)&flash;            // CO_NODE_EXT
///
/// Pages. The memory consists of one or several regions, each with pages of one size, such as sectors of equal size or
/// the last pages of a bank. Each page is an erase unit; all erase units have the size of the smallest page. Only the
/// first part of a larger page is used. Addresses of parameter groups (CO_PARA.Offset) begin with 0 at the first page
/// of the first region.
///
/// Units. A unit is programmed once after each erase, as flash with an error-correcting code requires: the driver
/// programs a unit only if all its bytes read FFh. It does not buffer, cache or move data: the atomic stores of the
/// node (docs/storage.md) use two erase units for each group.
///
/// A loss of power can leave a unit incompletely programmed or a page incompletely erased. With an error-correcting
/// code, reading it may raise a fault (STM32: NMI or bus fault): Read must catch it and return false.
///
/// Context: the thread that stores and loads, with or without the node lock (docs/porting.md). Owner: the caller; the
/// context and what it refers to must outlive the node. They may be constant.
#ifndef CO_NVM_FLASH_PAGES_H_
#define CO_NVM_FLASH_PAGES_H_

#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Largest unit of programming, bytes.
#define CO_FLASH_UNIT_MAX 32u

/// Functions of the flash memory. Each waits for the end of its operation and returns within a limited time.
typedef struct CO_FLASH_ACCESS_T {
  /// Erases a page. \a address: address of its first byte; \a number: number of the page or sector, counted from
  /// CO_FLASH_REGION.FirstNumber.
  /// \retval true   the page is erased
  /// \retval false  the memory has reported an error, or the time has elapsed
  bool (*Erase)(void* ctx, uint32_t address, uint32_t number);
  /// Programs one unit. \a address: a multiple of CO_FLASH_PAGES.ProgramSize within the page; \a unit: its bytes,
  /// aligned to 8.
  /// \retval true   the unit is programmed
  /// \retval false  the memory has reported an error, or the time has elapsed
  bool (*Program)(void* ctx, uint32_t address, const void* unit);
  /// Reads \a size bytes of one page. Null: the memory is read like RAM, which requires that reading a damaged unit
  /// raises no fault.
  /// \retval true   \a to has the bytes
  /// \retval false  a unit is damaged
  bool (*Read)(void* ctx, uint32_t address, void* to, uint32_t size);
} CO_FLASH_ACCESS;

/// Pages of equal size at consecutive addresses.
typedef struct CO_FLASH_REGION_T {
  uint32_t Address;      ///< address of the first page
  uint32_t PageSize;     ///< bytes, a multiple of the unit of programming
  uint32_t FirstNumber;  ///< number of the first page, for CO_FLASH_ACCESS.Erase
  uint32_t PageNum;      ///< number of pages
} CO_FLASH_REGION;

/// A flash memory: the context of FlashPagesNvmDriver. With impossible values its capacity is 0, and the node stores
/// nothing (CO_ERR_PARA_STORE).
typedef struct CO_FLASH_PAGES_T {
  const CO_FLASH_ACCESS* Access;   ///< functions
  void* Ctx;                       ///< first argument of the functions
  const CO_FLASH_REGION* Regions;  ///< RegionNum regions; CO_PARA.Offset counts through them in this order
  uint32_t RegionNum;              ///< number of regions
  uint32_t ProgramSize;            ///< unit of programming: 1, 2, 4, 8, 16 or 32 bytes, at most CO_STORE_BUFFER
} CO_FLASH_PAGES;

/// The driver; its context is a CO_FLASH_PAGES.
extern const CO_IF_NVM_DRV_EX FlashPagesNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
