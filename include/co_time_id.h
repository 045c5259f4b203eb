// SPDX-License-Identifier: Apache-2.0
/// \file co_time_id.h
/// 1012h, COB-ID TIME. [CiA 301, 7.5.2.15] Data: a uint32_t, or the value itself (flag D); values: co_time.h. Bit 31:
/// the node consumes TIME, bit 30: it produces TIME, bit 29: 29-bit CAN-ID. While bit 31 or 30 is set, bits 0 to 29
/// cannot be changed; restricted CAN-IDs are refused (0609 0030h). A write takes effect at once; with a plain
/// CO_TUNSIGNED32 instead, at the next reset.
#ifndef CO_TIME_ID_H_
#define CO_TIME_ID_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTTimeId CO_NEEDS(USE_TIME);  ///< functions of CO_TTIME_ID

#define CO_TTIME_ID ((const CO_OBJ_TYPE*)&COTTimeId)  ///< type of 1012h

#ifdef __cplusplus
}
#endif

#endif
