// SPDX-License-Identifier: Apache-2.0
/// \file co_sync_cycle.h
/// 1006h, communication cycle period: the period of SYNC in µs, 0: no SYNC is produced. [CiA 301, 7.5.2.6] 1007h,
/// synchronous window length: time in µs after a SYNC in which synchronous PDOs are sent and processed, 0: no limit.
/// [CiA 301, 7.5.2.7] Data: a uint32_t, or the value itself (flag D). A time beyond the range of the timer is refused
/// (0609 0030h), and so is a period below CO_SYNC_PERIOD_MIN (0609 0032h). A producer with a shorter period in its
/// table or in a stored group sends no SYNC; the node's error is then CO_ERR_OBJ_RANGE_LOW. A write takes effect at
/// once; with a plain CO_TUNSIGNED32 instead, at the next reset.
#ifndef CO_SYNC_CYCLE_H_
#define CO_SYNC_CYCLE_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTSyncCycle CO_NEEDS(USE_SYNC);  ///< functions of both types

#define CO_TSYNC_CYCLE ((const CO_OBJ_TYPE*)&COTSyncCycle)   ///< type of 1006h
#define CO_TSYNC_WINDOW ((const CO_OBJ_TYPE*)&COTSyncCycle)  ///< type of 1007h

#ifdef __cplusplus
}
#endif

#endif
