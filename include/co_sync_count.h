// SPDX-License-Identifier: Apache-2.0
/// \file co_sync_count.h
/// 1019h, synchronous counter overflow value. [CiA 301, 7.5.2.22] Data: a uint8_t, or the value itself (flag D). 0:
/// SYNC has no counter; 2…240: it counts from 1 to that value. Others are refused (0609 0030h), and so is a change
/// while 1006h is not 0 (0800 0022h).
#ifndef CO_SYNC_COUNT_H_
#define CO_SYNC_COUNT_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTSyncCount CO_NEEDS(USE_SYNC);  ///< functions of CO_TSYNC_COUNT

#define CO_TSYNC_COUNT ((const CO_OBJ_TYPE*)&COTSyncCount)  ///< type of 1019h

#ifdef __cplusplus
}
#endif

#endif
