// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/node.h
/// The memory of a node. Included by co_core.h.
#ifndef LEXICAN_DETAIL_NODE_H_
#define LEXICAN_DETAIL_NODE_H_

#include "co_cfg.h"
#include "co_csdo.h"
#include "co_dict.h"
#include "co_emcy.h"
#include "co_err.h"
#include "co_heartbeat.h"
#include "co_if.h"
#include "co_led.h"
#include "co_lss.h"
#include "co_lss_master.h"
#include "co_nmt.h"
#include "co_obj.h"
#include "co_pdo.h"
#include "co_recorder.h"
#include "co_srdo.h"
#include "co_ssdo.h"
#include "co_sync.h"
#include "co_time.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/routes.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal
typedef struct CO_REQUEST_T {  ///< access of an SDO server or client to an object, on the CPU's stack
  CO_OBJ* Obj;                 ///< object; null: none yet
  uint32_t Abort;              ///< abort code that COObjTypeUserSDOAbort() has set; 0: none
} CO_REQUEST;

typedef struct CO_TRANSMIT_T {  ///< state of transmission
  uint8_t Off;                  ///< bits: disabled, because the bit rate is switched or CONodeStop() was called
  /// Block transfers are paused: they wait for the controller, or for the next call of CONodeProcess() or
  /// COTmrProcess().
  uint8_t Paused;
  uint8_t Burst;  ///< segments of block transfers sent in this call
  uint8_t Next;   ///< round-robin index: the block transfer that sends its next segment first
} CO_TRANSMIT;

#if CO_RPDO_N > 0 || CO_TPDO_N > 0
typedef struct CO_PDO_SETS_T {  ///< sets with a bit for each PDO
#if CO_RPDO_N > 0
  uint32_t Fresh[(CO_RPDO_N + 31) / 32];  ///< RPDOs that have data for the next SYNC
#endif
#if CO_TPDO_N > 0
  uint32_t Marked[(CO_TPDO_N + 31) / 32];  ///< TPDOs that are marked for transmission
  uint32_t Sync[(CO_TPDO_N + 31) / 32];    ///< synchronous TPDOs
#endif
} CO_PDO_SETS;
#endif

#if USE_PARA
typedef struct CO_STORAGE_T {  ///< storage of parameter groups
  /// Called after the network has written an object, while 1020h is not 0; otherwise null.
  void (*OnWrite)(struct CO_NODE_T* node, const struct CO_OBJ_T* obj);
  CO_TMR_MEM Tmr;      ///< checks the groups that are stored autonomously
  uint8_t Newest[32];  ///< slot of each group with its newest record, 2 bits each: 0 not known, 1, 2
#if CO_PARA_BUDGET > 0
  uint8_t Used;          ///< stores used of CO_PARA_BUDGET
  uint8_t Cause;         ///< source of the write in progress: whether the budget counts it
  CO_TMR_MEM BudgetTmr;  ///< refills CO_PARA_BUDGET
#endif
} CO_STORAGE;
#endif

#if USE_GUARDING
typedef struct CO_GUARDING_T {  ///< node guarding and life guarding
  uint8_t Toggle;               ///< bit 7 of the next node guarding response
  uint8_t Lost;                 ///< life guarding: the NMT master is missing
  CO_TMR_MEM Tmr;               ///< life guarding: time within which the NMT master has to send the next remote frame
} CO_GUARDING;
#endif
/// \endcond

/// A node. The application uses members as handles (&node.Dict, &node.Emcy, &node.Nmt, &node.Tmr, …) and may read
/// NodeId, Baudrate, Error, Nmt.Mode, Dict.Num, CSdo and HbCons; it must not access any other member. Frequently used
/// members come first, where small CPUs reach them with one instruction.
typedef struct CO_NODE_T {
  uint8_t NodeId;    ///< 1…127, or CO_LSS_NO_NODE_ID: unconfigured
  uint8_t State;     ///< bits: initialised and running, working (processing a frame, a timer of the stack or an access)
  uint16_t Pending;  ///< bits: deferred work, done where the outermost call ends
  CO_TRANSMIT Transmit;  ///< state of transmission
  uint8_t OdLocked;      ///< CO_NODE_EXT.OdLock is held
  uint8_t WindowOver;    ///< the synchronous window has elapsed
  uint8_t HasFresh;      ///< an RPDO has data for the next SYNC
#if USE_REAL_TIME
  uint8_t IsNodeLocked;  ///< the node lock is held (CO_NODE_EXT.Enter)
#endif
  CO_NMT Nmt;                       ///< NMT slave, handle for co_nmt.h
  const struct CO_NODE_EXT_T* Ext;  ///< settings of CONodeInitEx(), or defaults; null: the node has no drivers
  /// Passes a stream to or from a PDO, and keeps the position of the application; null: the table has no stream of the
  /// library.
  enum CO_ERR_T (*PassStream)(CO_OBJ* obj, struct CO_NODE_T* node, CO_OBJ_READ_FUNC function, void* data,
                              uint32_t bytes);
  CO_TX_QUEUE TxQueue;     ///< transmit queue
  CO_IF If;                ///< drivers, handle for co_if.h
  CO_REQUEST* Request;     ///< SDO request that is being processed; null: none
  uint8_t* SdoBuf;         ///< CO_NODE_SPEC.SdoBuf
  enum CO_ERR_T Error;     ///< last error, for CONodeGetErr()
  uint32_t ErrorKey;       ///< key of the object that Error is about
  CO_NODE_COUNTERS Count;  ///< counters, for CONodeGetCounters()
  CO_ROUTES Routes;        ///< routing table of received frames
  CO_DICT Dict;            ///< object dictionary, handle for co_dict.h
  CO_TMR Tmr;              ///< timers, handle for co_tmr.h
  CO_TMR_MEM SdoTmr;       ///< one time-out timer for all SDO servers
  CO_TMR_MEM HbProdTmr;    ///< heartbeat producer: period
#if USE_EMCY
  CO_EMCY Emcy;  ///< emergencies, handle for co_emcy.h
#endif
#if USE_SYNC
  CO_SYNC Sync;  ///< SYNC consumer and producer
#endif
#if USE_TIME
  CO_TIME Time;  ///< TIME consumer and producer, and the clock
#endif
#if USE_LED
  CO_LED Led;  ///< status LEDs
#endif
#if USE_LSS
  CO_LSS Lss;  ///< LSS slave
#endif
#if USE_LSS_MASTER
  CO_LSSM Lssm;  ///< LSS master, handle for co_lss_master.h
#endif
#if USE_PARA
  CO_STORAGE Storage;  ///< storage of parameter groups
#endif
#if USE_GUARDING
  CO_GUARDING Guarding;  ///< node guarding and life guarding
#endif
#if CO_HBCONS_N > 0
  CO_TMR_MEM HbConsTmr;             ///< one timer for all heartbeat consumers
  CO_HB_WATCH HbCons[CO_HBCONS_N];  ///< indexed by sub-index of 1016h
#endif
#if CO_RPDO_N > 0 || CO_TPDO_N > 0
  CO_PDO_SETS PdoSets;  ///< sets of PDOs
#endif
  CO_SDO Sdo[CO_SSDO_N];  ///< SDO servers, 1200h + index
#if USE_CSDO
  CO_CSDO CSdo[CO_CSDO_N];  ///< SDO clients, 1280h + index; see COCSdoFind()
#endif
#if CO_RPDO_N > 0
  CO_RPDO RPdo[CO_RPDO_N];  ///< RPDOs, 1400h + index
#endif
#if CO_TPDO_N > 0
  CO_TPDO TPdo[CO_TPDO_N];  ///< TPDOs, 1800h + index; handle for COTPdoTrigPdo() and COTPdoTrigObj()
#endif
#if CO_MPDO_N > 0
  CO_MPDO Mpdo;  ///< object scanner list and object dispatching list
#endif
  CO_IF_FRM TxFrame[CO_TX_QUEUE_N];  ///< memory of TxQueue, if CO_NODE_EXT.TxQueue is null
  uint32_t Baudrate;                 ///< bit/s, present bit rate
#if CO_SRDO_N > 0
  CO_SRDO Srdo[CO_SRDO_N];  ///< SRDOs, 1301h + index
#endif
#if USE_RECORDER
  CO_RECORDERS Recorders;  ///< recorders, and their time
#endif
} CO_NODE;

#ifdef __cplusplus
}
#endif

#endif
