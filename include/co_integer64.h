// SPDX-License-Identifier: Apache-2.0
/// \file co_integer64.h
/// INTEGER40…64 and UNSIGNED40…64. [CiA 301, 7.1.4]
/// Data: a variable of eight bytes, or the value itself (flag D, on CPUs with 64-bit addresses).
#ifndef CO_INTEGER64_H_
#define CO_INTEGER64_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTInt64;
extern const CO_OBJ_TYPE COTUnsigned40;  ///< 5, 6, 7 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTUnsigned48;
extern const CO_OBJ_TYPE COTUnsigned56;
extern const CO_OBJ_TYPE COTSigned40;  ///< 5, 6, 7 bytes on the bus, in an int64_t
extern const CO_OBJ_TYPE COTSigned48;
extern const CO_OBJ_TYPE COTSigned56;

#define CO_TUNSIGNED64 ((const CO_OBJ_TYPE*)&COTInt64)
#define CO_TSIGNED64 ((const CO_OBJ_TYPE*)&COTInt64)
#define CO_TUNSIGNED40 ((const CO_OBJ_TYPE*)&COTUnsigned40)
#define CO_TUNSIGNED48 ((const CO_OBJ_TYPE*)&COTUnsigned48)
#define CO_TUNSIGNED56 ((const CO_OBJ_TYPE*)&COTUnsigned56)
#define CO_TSIGNED40 ((const CO_OBJ_TYPE*)&COTSigned40)
#define CO_TSIGNED48 ((const CO_OBJ_TYPE*)&COTSigned48)
#define CO_TSIGNED56 ((const CO_OBJ_TYPE*)&COTSigned56)

#ifdef __cplusplus
}
#endif

#endif
