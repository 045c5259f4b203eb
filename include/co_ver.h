// SPDX-License-Identifier: Apache-2.0
/// \file co_ver.h
/// The version of the stack. Not part of co_core.h.
#ifndef CO_VER_H_
#define CO_VER_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CO_VER_MAJOR 0  ///< major version of these headers
#define CO_VER_MINOR 1  ///< minor version of these headers, 0…99
#define CO_VER_BUILD 0  ///< build of these headers, 0…99

/// Returns the major version of the compiled library. Context of all these functions: any.
uint8_t COVerMajor(void);
uint8_t COVerMinor(void);  ///< returns the minor version of the compiled library
uint8_t COVerBuild(void);  ///< returns the build of the compiled library
uint32_t COVersion(void);  ///< returns major * 10000 + minor * 100 + build of the compiled library
/// Does nothing; exists for firmware that calls it.
void CO_VerInit(void);

#ifdef __cplusplus
}
#endif

#endif
