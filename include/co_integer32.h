// SPDX-License-Identifier: Apache-2.0
/// \file co_integer32.h
/// INTEGER24, UNSIGNED24, INTEGER32 and UNSIGNED32. [CiA 301, 7.1.4]
/// Data: a variable of four bytes, or the value itself (flag D).
#ifndef CO_INTEGER32_H_
#define CO_INTEGER32_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTInt32;       ///< functions of CO_TUNSIGNED32 and CO_TSIGNED32
extern const CO_OBJ_TYPE COTUnsigned24;  ///< 3 bytes on the bus, in a uint32_t
extern const CO_OBJ_TYPE COTSigned24;    ///< 3 bytes on the bus, in an int32_t

#define CO_TUNSIGNED32 ((const CO_OBJ_TYPE*)&COTInt32)       ///< UNSIGNED32; Data: a uint32_t
#define CO_TSIGNED32 ((const CO_OBJ_TYPE*)&COTInt32)         ///< INTEGER32; Data: an int32_t
#define CO_TUNSIGNED24 ((const CO_OBJ_TYPE*)&COTUnsigned24)  ///< UNSIGNED24; Data: a uint32_t
#define CO_TSIGNED24 ((const CO_OBJ_TYPE*)&COTSigned24)      ///< INTEGER24; Data: an int32_t

#ifdef __cplusplus
}
#endif

#endif
