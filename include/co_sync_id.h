// SPDX-License-Identifier: Apache-2.0
/// \file co_sync_id.h
/// 1005h, COB-ID SYNC. [CiA 301, 7.5.2.5] Data: a uint32_t, or the value itself (flag D). Bit 30: the node produces
/// SYNC. Bit 29: 29-bit CAN-ID. While bit 30 is set, the other bits cannot be changed; restricted CAN-IDs are refused
/// (0609 0030h).
#ifndef CO_SYNC_ID_H_
#define CO_SYNC_ID_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTSyncId CO_NEEDS(USE_SYNC);  ///< functions of CO_TSYNC_ID

#define CO_TSYNC_ID ((const CO_OBJ_TYPE*)&COTSyncId)  ///< type of 1005h

#ifdef __cplusplus
}
#endif

#endif
