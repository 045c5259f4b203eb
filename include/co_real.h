// SPDX-License-Identifier: Apache-2.0
/// \file co_real.h
/// REAL32 and REAL64 (IEEE 754). [CiA 301, 7.1.4] Data: a float, a double.
#ifndef CO_REAL_H_
#define CO_REAL_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTReal32;  ///< functions of CO_TREAL32
extern const CO_OBJ_TYPE COTReal64;  ///< functions of CO_TREAL64

#define CO_TREAL32 ((const CO_OBJ_TYPE*)&COTReal32)  ///< REAL32; Data: a float
#define CO_TREAL64 ((const CO_OBJ_TYPE*)&COTReal64)  ///< REAL64; Data: a double

#ifdef __cplusplus
}
#endif

#endif
