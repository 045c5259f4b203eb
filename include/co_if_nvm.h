// SPDX-License-Identifier: Apache-2.0
/// \file co_if_nvm.h
/// The functions that a driver for non-volatile memory has to provide.
#ifndef CO_IF_NVM_H_
#define CO_IF_NVM_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Geometry of a memory, in bytes.
typedef struct CO_NVM_SHAPE_T {
  uint32_t Capacity;     ///< addresses are 0…Capacity-1
  uint32_t ProgramSize;  ///< alignment and granularity of writes; 1: single bytes
  uint32_t EraseSize;    ///< erase unit, a multiple of ProgramSize; 0: no erase needed (EEPROM, FRAM, file)
} CO_NVM_SHAPE;

/// A memory driver with context argument, geometry and erase function (CO_NODE_EXT.Nvm). Required for atomic
/// (power-fail safe) stores. Read and Write return the number of bytes done; less than \a size means an error. All
/// functions are called in the loop context and may block.
typedef struct CO_IF_NVM_DRV_EX_T {
  void (*Init)(void* ctx);  ///< prepares the memory; does not change its content
  uint32_t (*Read)(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size);         ///< returns the bytes read
  uint32_t (*Write)(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size);  ///< returns the bytes written
  bool (*Erase)(void* ctx, uint32_t start, uint32_t size);  ///< sets bytes to FFh; may be null if EraseSize is 0
  /// Returns the geometry. May be null: then stores are not atomic, and nodes of CONodeInitCtx() store nothing.
  CO_NVM_SHAPE (*Shape)(void* ctx);
} CO_IF_NVM_DRV_EX;

/// \name As in CANopen-Stack
/// \{

/// A classic memory driver (without context). The application defines the address space. Otherwise the functions are
/// those of CO_IF_NVM_DRV_EX.
typedef struct CO_IF_NVM_DRV_T {
  void (*Init)(void);  ///< prepares the memory; does not change its content
  uint32_t (*Read)(uint32_t start, uint8_t* buffer, uint32_t size);   ///< returns the bytes read
  uint32_t (*Write)(uint32_t start, uint8_t* buffer, uint32_t size);  ///< returns the bytes written
} CO_IF_NVM_DRV;
/// \}

#ifdef __cplusplus
}
#endif

#endif
