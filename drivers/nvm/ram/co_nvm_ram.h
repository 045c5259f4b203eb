// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_ram.h
/// Driver for a parameter memory in RAM: for tests, for nodes without persistent parameters, and for battery-backed RAM
/// or memory-mapped FRAM. C and C++, bare metal.
///
///     static uint8_t bytes[1024];
///     static CO_NVM_RAM memory = { bytes, sizeof(bytes) };
///     CONvmRamClear(&memory);                                // not if the RAM is battery-backed
///     ext.Nvm = &RamNvmDriver;  ext.NvmCtx = &memory;        // CO_NODE_EXT
///
/// Accesses are limited to the size of the memory: the functions return the number of bytes processed. Init does not
/// change the content, so it survives CONodeInit() like that of real memory.
///
/// Context: the loop. Owner: the caller owns the bytes; they must outlive the node.
#ifndef CO_NVM_RAM_H_
#define CO_NVM_RAM_H_

#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A memory in RAM. The caller sets the members; they must not change while a node uses the memory.
typedef struct CO_NVM_RAM_T {
  uint8_t* Mem;   ///< content, owned by the caller
  uint32_t Size;  ///< bytes at Mem
} CO_NVM_RAM;

/// Sets all bytes to FFh, like erased memory. To be called before CONodeInit().
void CONvmRamClear(CO_NVM_RAM* ram);

/// The driver; its context is a CO_NVM_RAM.
extern const CO_IF_NVM_DRV_EX RamNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
