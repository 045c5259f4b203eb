// SPDX-License-Identifier: Apache-2.0
/// \file co_integer16.h
/// INTEGER16 and UNSIGNED16. [CiA 301, 7.1.4] Data: a variable of two bytes, or the value itself (flag D).
#ifndef CO_INTEGER16_H_
#define CO_INTEGER16_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTInt16;  ///< functions of both types

#define CO_TUNSIGNED16 ((const CO_OBJ_TYPE*)&COTInt16)  ///< UNSIGNED16; Data: a uint16_t
#define CO_TSIGNED16 ((const CO_OBJ_TYPE*)&COTInt16)    ///< INTEGER16; Data: an int16_t

#ifdef __cplusplus
}
#endif

#endif
