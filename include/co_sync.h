// SPDX-License-Identifier: Apache-2.0
/// \file co_sync.h
/// SYNC, consumer and producer. [301:7.2.5] Configured by 1005h, 1006h, 1007h and 1019h; there is nothing to call.
///
/// At a SYNC the synchronous TPDOs are sampled and sent, then the synchronous RPDOs that have come since the last one
/// are written. A producer takes its own SYNC for itself, and ignores those of others (also while 1006h is 0 and it
/// produces none), which it counts as malformed. A SYNC of another length than 1019h says is reported with 8240h;
/// without a counter, where one is expected, it counts for the TPDOs without a SYNC start value only.
#ifndef CO_SYNC_H_
#define CO_SYNC_H_

#include "co_cfg.h"
#include "co_tmr.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Values for 1005h
/// \a generate: 1 = the node produces SYNC, \a id: CAN-ID
/// \{
#define CO_SYNC_COBID_ON 0x40000000u   ///< bit 30: the node produces SYNC
#define CO_SYNC_COBID_EXT 0x20000000u  ///< bit 29: 29-bit CAN-ID
#define CO_SYNC_COBID_MASK 0x1FFFFFFFu
#define CO_COBID_SYNC_STD(generate, id) ((((uint32_t)(id)) & 0x7FFu) | ((((uint32_t)(generate)) & 1u) << 30))
#define CO_COBID_SYNC_EXT(generate, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((((uint32_t)(generate)) & 1u) << 30))
/// \}

struct CO_NODE_T;

/// The application touches nothing of it.
typedef struct CO_SYNC_T {
  CO_TMR_MEM Tmr;        ///< of the producer
  CO_TMR_MEM WindowTmr;  ///< ends the synchronous window
  uint32_t Identifier;   ///< of SYNC frames; UINT32_MAX: none
  uint32_t Window;       ///< ticks; 0: always open
  uint8_t Overflow;      ///< 1019h
  uint8_t Counter;       ///< of the last SYNC produced
  uint8_t Produces;      ///< 1005h bit 30
  uint8_t Wrong;         ///< 8240h is reported
} CO_SYNC;

#ifdef __cplusplus
}
#endif

#endif
