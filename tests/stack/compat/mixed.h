// SPDX-License-Identifier: Apache-2.0
/// \file mixed.h
/// Declarations for mixed_table.c and mixed_use.c, each of which is C or C++.
#ifndef COMPAT_MIXED_H_
#define COMPAT_MIXED_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

#define MIXED_ENTRIES 8u
#define MIXED_DYNAMIC 3u

extern const CO_OBJ MixedTable[MIXED_ENTRIES];
extern CO_OBJ MixedDynamic[MIXED_DYNAMIC];
extern const CO_PARA MixedGroup;
extern uint32_t MixedLong;
extern uint8_t MixedBytes[4];

/// Writes a direct value to an entry of MixedDynamic.
void MixedSet(CO_OBJ* obj, uint32_t value);
/// Returns the value that the entry contains.
uint32_t MixedGet(const CO_OBJ* obj);

#ifdef __cplusplus
}
#endif

#endif
