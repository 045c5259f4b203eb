// SPDX-License-Identifier: Apache-2.0
/// \file co_sync.h
/// SYNC consumer and producer. [CiA 301, 7.2.5] Configured by 1005h, 1006h, 1007h and 1019h; there are no functions to
/// call.
///
/// At a SYNC the synchronous TPDOs are sampled and sent, then the data of the synchronous RPDOs received since the last
/// SYNC are written. A producer processes its own SYNC. It ignores SYNC messages of other nodes (also while 1006h is 0
/// and it produces none) and counts them as malformed. A SYNC whose length does not match 1019h is reported with 8240h;
/// a SYNC without counter where one is expected triggers only the TPDOs without a SYNC start value.
#ifndef CO_SYNC_H_
#define CO_SYNC_H_

#include "co_cfg.h"
#include "co_obj.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Values for 1005h
/// \a generate: 1 = the node produces SYNC, \a id: CAN-ID
/// \{
#define CO_SYNC_COBID_ON 0x40000000u    ///< bit 30: the node produces SYNC
#define CO_SYNC_COBID_EXT 0x20000000u   ///< bit 29: 29-bit CAN-ID
#define CO_SYNC_COBID_MASK 0x1FFFFFFFu  ///< bits 0…28: CAN-ID
/// Value with an 11-bit CAN-ID.
#define CO_COBID_SYNC_STD(generate, id) ((((uint32_t)(id)) & 0x7FFu) | ((((uint32_t)(generate)) & 1u) << 30))
/// Value with a 29-bit CAN-ID.
#define CO_COBID_SYNC_EXT(generate, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((((uint32_t)(generate)) & 1u) << 30))
/// \}

struct CO_NODE_T;

/// SYNC of a node. The application must not access the members.
typedef struct CO_SYNC_T {
  CO_TMR_MEM Tmr;        ///< producer
  CO_TMR_MEM WindowTmr;  ///< synchronous window
  uint32_t Identifier;   ///< identifier of SYNC frames; UINT32_MAX: none
  uint32_t Window;       ///< synchronous window in ticks; 0: always open
  uint8_t Overflow;      ///< value of 1019h
  uint8_t Counter;       ///< counter of the last SYNC produced
  uint8_t Produces;      ///< 1005h bit 30
  uint8_t Wrong;         ///< error 8240h is set
} CO_SYNC;

/// \name 1005h, COB-ID SYNC
/// [CiA 301, 7.5.2.5] Data: a uint32_t, or the value itself (flag D). Bit 30: the node produces SYNC. Bit 29: 29-bit
/// CAN-ID. While bit 30 is set, the other bits cannot be changed; restricted CAN-IDs are refused (0609 0030h).
/// \{

extern const CO_OBJ_TYPE COTSyncId CO_NEEDS(USE_SYNC);  ///< functions of CO_TSYNC_ID

#define CO_TSYNC_ID ((const CO_OBJ_TYPE*)&COTSyncId)  ///< type of 1005h
/// \}

/// \name 1006h, communication cycle period
/// The period of SYNC in µs, 0: no SYNC is produced. [CiA 301, 7.5.2.6] 1007h, synchronous window length: time in µs
/// after a SYNC in which synchronous PDOs are sent and processed, 0: no limit. [CiA 301, 7.5.2.7] Data: a uint32_t, or
/// the value itself (flag D). A time beyond the range of the timer is refused (0609 0030h), and so is a period below
/// CO_SYNC_PERIOD_MIN (0609 0032h). A producer with a shorter period in its table or in a stored group sends no SYNC;
/// the node's error is then CO_ERR_OBJ_RANGE_LOW. A write takes effect at once; with a plain CO_TUNSIGNED32 instead, at
/// the next reset.
/// \{

extern const CO_OBJ_TYPE COTSyncCycle CO_NEEDS(USE_SYNC);  ///< functions of both types

#define CO_TSYNC_CYCLE ((const CO_OBJ_TYPE*)&COTSyncCycle)   ///< type of 1006h
#define CO_TSYNC_WINDOW ((const CO_OBJ_TYPE*)&COTSyncCycle)  ///< type of 1007h
/// \}

/// \name 1019h, synchronous counter overflow value
/// [CiA 301, 7.5.2.22] Data: a uint8_t, or the value itself (flag D). 0: SYNC has no counter; 2…240: it counts from 1
/// to that value. Others are refused (0609 0030h), and so is a change while 1006h is not 0 (0800 0022h).
/// \{

extern const CO_OBJ_TYPE COTSyncCount CO_NEEDS(USE_SYNC);  ///< functions of CO_TSYNC_COUNT

#define CO_TSYNC_COUNT ((const CO_OBJ_TYPE*)&COTSyncCount)  ///< type of 1019h
/// \}

#ifdef __cplusplus
}
#endif

#endif
