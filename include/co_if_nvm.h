// SPDX-License-Identifier: Apache-2.0
/// \file co_if_nvm.h
/// What a driver for non-volatile memory has to supply.
#ifndef CO_IF_NVM_H_
#define CO_IF_NVM_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A memory driver without context. The address space is the application's. Functions return the bytes done; fewer than
/// asked for means an error. They are called in the loop context and may block.
typedef struct CO_IF_NVM_DRV_T {
  void (*Init)(void);
  uint32_t (*Read)(uint32_t start, uint8_t* buffer, uint32_t size);
  uint32_t (*Write)(uint32_t start, uint8_t* buffer, uint32_t size);
} CO_IF_NVM_DRV;

/// Shape of a memory, in bytes.
typedef struct CO_NVM_SHAPE_T {
  uint32_t Capacity;     ///< addresses 0…Capacity-1
  uint32_t ProgramSize;  ///< writes start at and span multiples of it; 1: byte by byte
  uint32_t EraseSize;    ///< erase unit, a multiple of it; 0: memory that needs no erase (EEPROM, FRAM, file)
} CO_NVM_SHAPE;

/// The same with a context, a shape and an erase function (CO_NODE_EXT).
typedef struct CO_IF_NVM_DRV_EX_T {
  void (*Init)(void* ctx);
  uint32_t (*Read)(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size);         ///< returns the bytes read
  uint32_t (*Write)(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size);  ///< returns the bytes written
  bool (*Erase)(void* ctx, uint32_t start, uint32_t size);  ///< to FFh; may be null if EraseSize is 0
  CO_NVM_SHAPE (*Shape)(void* ctx);
} CO_IF_NVM_DRV_EX;

#ifdef __cplusplus
}
#endif

#endif
