// SPDX-License-Identifier: Apache-2.0
/// \file co_integer8.h
/// BOOLEAN, INTEGER8 and UNSIGNED8. [CiA 301, 7.1.4] Data: a variable of one byte, or the value itself (flag D).
#ifndef CO_INTEGER8_H_
#define CO_INTEGER8_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTInt8;     ///< functions of CO_TUNSIGNED8 and CO_TSIGNED8
extern const CO_OBJ_TYPE COTBoolean;  ///< accepts 0 and 1 only (else CO_ERR_OBJ_RANGE)

#define CO_TUNSIGNED8 ((const CO_OBJ_TYPE*)&COTInt8)   ///< UNSIGNED8; Data: a uint8_t
#define CO_TSIGNED8 ((const CO_OBJ_TYPE*)&COTInt8)     ///< INTEGER8; Data: an int8_t
#define CO_TBOOLEAN ((const CO_OBJ_TYPE*)&COTBoolean)  ///< BOOLEAN; Data: a uint8_t, 0 or 1

#ifdef __cplusplus
}
#endif

#endif
