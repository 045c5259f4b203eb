// SPDX-License-Identifier: Apache-2.0
/// \file mixed.h
/// What mixed_table.c and mixed_use.c share, whatever the language of each.
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

/// Puts a direct value into an entry of MixedDynamic.
void MixedSet(CO_OBJ* obj, uint32_t value);
/// The value that lies in an entry.
uint32_t MixedGet(const CO_OBJ* obj);

#ifdef __cplusplus
}
#endif

#endif
