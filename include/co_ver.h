// SPDX-License-Identifier: Apache-2.0
/// \file co_ver.h
/// The version of the stack. Not part of co_core.h.
#ifndef CO_VER_H_
#define CO_VER_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CO_VER_MAJOR 0
#define CO_VER_MINOR 1
#define CO_VER_BUILD 0

/// Return the three numbers of the compiled library, and major * 10000 + minor * 100 + build. Context: any.
uint8_t COVerMajor(void);
uint8_t COVerMinor(void);
uint8_t COVerBuild(void);
uint32_t COVersion(void);
/// Does nothing; exists for firmware that calls it.
void CO_VerInit(void);

#ifdef __cplusplus
}
#endif

#endif
