// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_ram.h
/// A parameter memory in RAM: for tests, for nodes that need not remember, and for battery-backed RAM or memory-mapped
/// FRAM. C and C++, bare metal.
///
///     static uint8_t bytes[1024];
///     static CO_NVM_RAM memory = { bytes, sizeof(bytes) };
///     CONvmRamClear(&memory);                                // unless the bytes have survived
///     ext.Nvm = &RamNvmDriver;  ext.NvmCtx = &memory;        // CO_NODE_EXT
///
/// Accesses beyond the end are cut there: the functions return what they have done. Init leaves the content alone, so
/// that it survives CONodeInit() as it would in a real memory.
///
/// Context: the loop. Owner: the bytes stay the caller's and must live as long as the node.
#ifndef CO_NVM_RAM_H_
#define CO_NVM_RAM_H_

#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CO_NVM_RAM_T {
  uint8_t* Mem;
  uint32_t Size;  ///< bytes at Mem
} CO_NVM_RAM;

/// Makes the memory as a fresh one is: all bytes FFh.
void CONvmRamClear(CO_NVM_RAM* ram);

/// The driver; its context is a CO_NVM_RAM.
extern const CO_IF_NVM_DRV_EX RamNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
