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

extern const CO_OBJ_TYPE COTInt64;       ///< functions of CO_TUNSIGNED64 and CO_TSIGNED64
extern const CO_OBJ_TYPE COTUnsigned40;  ///< 5 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTUnsigned48;  ///< 6 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTUnsigned56;  ///< 7 bytes on the bus, in a uint64_t
extern const CO_OBJ_TYPE COTSigned40;    ///< 5 bytes on the bus, in an int64_t
extern const CO_OBJ_TYPE COTSigned48;    ///< 6 bytes on the bus, in an int64_t
extern const CO_OBJ_TYPE COTSigned56;    ///< 7 bytes on the bus, in an int64_t

#define CO_TUNSIGNED64 ((const CO_OBJ_TYPE*)&COTInt64)       ///< UNSIGNED64; Data: a uint64_t
#define CO_TSIGNED64 ((const CO_OBJ_TYPE*)&COTInt64)         ///< INTEGER64; Data: an int64_t
#define CO_TUNSIGNED40 ((const CO_OBJ_TYPE*)&COTUnsigned40)  ///< UNSIGNED40; Data: a uint64_t
#define CO_TUNSIGNED48 ((const CO_OBJ_TYPE*)&COTUnsigned48)  ///< UNSIGNED48; Data: a uint64_t
#define CO_TUNSIGNED56 ((const CO_OBJ_TYPE*)&COTUnsigned56)  ///< UNSIGNED56; Data: a uint64_t
#define CO_TSIGNED40 ((const CO_OBJ_TYPE*)&COTSigned40)      ///< INTEGER40; Data: an int64_t
#define CO_TSIGNED48 ((const CO_OBJ_TYPE*)&COTSigned48)      ///< INTEGER48; Data: an int64_t
#define CO_TSIGNED56 ((const CO_OBJ_TYPE*)&COTSigned56)      ///< INTEGER56; Data: an int64_t

#ifdef __cplusplus
}
#endif

#endif
