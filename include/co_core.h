// SPDX-License-Identifier: Apache-2.0
/// \file co_core.h
/// A CANopen node: everything an application includes, except co_ver.h.
///
/// Contexts: all functions of the stack belong to one context, the loop (or one task), with two exceptions:
/// COTmrService() (timer interrupt) and CORingPut() (producer end of a driver's queue). With USE_REAL_TIME several
/// threads may use a node, in turns: see CO_NODE_EXT.Enter.
///
/// Null pointers: a function that returns CO_ERR answers CO_ERR_BAD_ARG; others call CONodeFatalError() and return,
/// unless they say otherwise.
#ifndef CO_CORE_H_
#define CO_CORE_H_

#include "co_types.h"

#include "co_cfg.h"

#include "co_domain.h"
#include "co_integer16.h"
#include "co_integer32.h"
#include "co_integer64.h"
#include "co_integer8.h"
#include "co_real.h"
#include "co_string.h"
#include "co_time_of_day.h"

#include "co_emcy_cons.h"
#include "co_emcy_hist.h"
#include "co_emcy_id.h"
#include "co_error_behaviour.h"
#include "co_hb_cons.h"
#include "co_hb_prod.h"
#include "co_nmt_startup.h"
#include "co_para.h"
#include "co_pdo_dispatch.h"
#include "co_pdo_event.h"
#include "co_pdo_id.h"
#include "co_pdo_inhibit.h"
#include "co_pdo_map.h"
#include "co_pdo_num.h"
#include "co_pdo_scan.h"
#include "co_pdo_start.h"
#include "co_pdo_type.h"
#include "co_sdo_id.h"
#include "co_sync_count.h"
#include "co_sync_cycle.h"
#include "co_sync_id.h"

#include "co_callbacks.h"
#include "co_configuration.h"
#include "co_csdo.h"
#include "co_dict.h"
#include "co_emcy.h"
#include "co_if.h"
#include "co_led.h"
#include "co_lss.h"
#include "co_lss_master.h"
#include "co_needs.h"
#include "co_nmt.h"
#include "co_pdo.h"
#include "co_ring.h"
#include "co_sdo.h"
#include "co_ssdo.h"
#include "co_sync.h"
#include "co_time.h"
#include "co_time_clock.h"
#include "co_time_id.h"
#include "co_tmr.h"

#if USE_OD
#include "co_od.h"
#endif

#include "co_err.h"
#include "co_obj.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What a node is made of. Filled by position or member by member; used only during CONodeInit().
typedef struct CO_NODE_SPEC_T {
  uint8_t NodeId;                  ///< 1…127, or CO_LSS_NO_NODE_ID (co_lss.h)
  uint32_t Baudrate;               ///< bit/s
  struct CO_OBJ_T* Dict;           ///< the dictionary; may be const (cast it), must live as long as the node
  uint16_t DictLen;                ///< length of that array
  struct CO_EMCY_TBL_T* EmcyCode;  ///< errors of the application (co_emcy.h), may be null
  struct CO_TMR_MEM_T* TmrMem;     ///< timers for the application; the stack needs none of them
  uint16_t TmrNum;                 ///< length of that array, may be 0
  uint32_t TmrFreq;                ///< ticks of the timer driver per second, not 0
  CO_IF_DRV* Drv;                  ///< drivers without context; may be null if CO_NODE_EXT names all drivers
  uint8_t* SdoBuf;                 ///< CO_SSDO_N * CO_SDO_BUF_BYTE bytes, or null
} CO_NODE_SPEC;

/// What a CAN controller reports.
typedef enum CO_CAN_EVENT_T {
  CO_CAN_OVERRUN = 0,  ///< a received frame was lost
  CO_CAN_PASSIVE,      ///< error passive
  CO_CAN_BUS_OFF,      ///< bus-off
  CO_CAN_RECOVERED,    ///< error active again
  CO_CAN_EVENT_NUM
} CO_CAN_EVENT;

/// What the node has counted since CONodeInit(). All counters saturate.
typedef struct CO_NODE_COUNTERS_T {
  uint32_t Received;   ///< frames read from the driver
  uint32_t Unclaimed;  ///< of these: for nobody here, or for a service that the NMT state forbids
  /// Of these: for us, but of a wrong length or kind, or with a DLC above 15; ignored. Frames with such a DLC that the
  /// application wants to send are counted, too.
  uint32_t Malformed;
  uint32_t Sent;                         ///< frames that the driver took
  uint32_t Dropped;                      ///< frames that found a queue full, or that a reset or NMT state threw away
  uint32_t SdoAborts;                    ///< SDO transfers that the server aborted
  uint32_t TimerExhausted;               ///< COTmrCreate() without a free timer
  uint32_t CanEvents[CO_CAN_EVENT_NUM];  ///< what CONodeCanEvent() was told, or CONodeProcess() has found
} CO_NODE_COUNTERS;

/// Everything that CO_NODE_SPEC has no place for. Initialise it with zero, set Size, then what you need; it is only
/// read and must live as long as the node.
typedef struct CO_NODE_EXT_T {
  uint32_t Size;                ///< sizeof(CO_NODE_EXT)
  const CO_IF_CAN_DRV_EX* Can;  ///< CAN driver with context, or null: CO_NODE_SPEC.Drv
  void* CanCtx;
  const CO_IF_TIMER_DRV_EX* Timer;  ///< timer driver with context, or null: CO_NODE_SPEC.Drv
  void* TimerCtx;
  const CO_IF_NVM_DRV_EX* Nvm;  ///< memory driver with context, or null: CO_NODE_SPEC.Drv
  void* NvmCtx;
  CO_IF_FRM* TxQueue;        ///< memory for frames that wait for the controller, or null: CO_TX_QUEUE_N in the node
  uint16_t TxQueueLen;       ///< frames at TxQueue
  void (*Lock)(void* user);  ///< instead of COTmrLock()/COTmrUnlock(); both or none
  void (*Unlock)(void* user);
  /// May \a size bytes at \a address be written? Null: yes. Asked before a basic type stores a value; for tables and
  /// variables that the linker has put into read-only memory. false: refused with CO_ERR_OBJ_ACC.
  bool (*Writable)(void* user, const void* address, uint32_t size);
  void* User;  ///< for the functions above and below, and for CONodeGetUser()
  /// Held while mapped objects are copied (co_pdo.h); both or none. Calls do not nest.
  void (*OdLock)(void* user);
  void (*OdUnlock)(void* user);
  uint16_t EmcyNum;  ///< errors in CO_NODE_SPEC.EmcyCode; 0: CO_EMCY_N
#if USE_REAL_TIME
  /// The lock of the node, both or none; a mutex, or what keeps an interrupt away. Who holds it has the turn: the node
  /// works in turns only, so any threads may use it. It is taken by
  ///   - the stack, in CONodeProcess(), CONodeRealTime(), COTmrProcess() (for each action) and CONodeNextDeadline();
  ///   - the application, around every other call and every access to what the node may use: CO_LOCK_OD(),
  ///     CO_LOCK_CAN_SEND() and CO_LOCK_EMCY() of co_od.h are three names of it.
  /// Callbacks, timer actions, the functions of types and of drivers run in a turn and must not take another, nor call
  /// one of those four functions: calls do not nest. Nobody need take it before there is a second thread, nor may a
  /// driver block: others wait for the turn. But while a memory driver that tells its shape reads, writes or erases,
  /// the turn is given up. So what stores, loads or resets belongs to one thread.
  void (*Enter)(void* user);
  void (*Leave)(void* user);
  /// Where CONodeRealTime() leaves the frames that it does not serve, and CONodeProcess() finds them. Prepared by
  /// CORingInit(), touched by nobody else. Null: no real-time thread.
  CO_RING* Mainline;
  /// Are frames that no service of the node wants left there, too? For applications with COIfCanReceive(). false: they
  /// take no place in the ring; they are counted (Unclaimed) and gone.
  bool Foreign;
#endif
#if USE_OD
  struct OD_T_* Od;  ///< the index of the dictionary (co_od.h), or null: no object is extended
#endif
  const CO_CALLBACKS* Callbacks;  ///< functions that receive the node and User (co_callbacks.h), or null
} CO_NODE_EXT;

/// \cond internal
// NMT, error control, LSS, SDO, heartbeat and EMCY consumers, SYNC and TIME, PDOs
#define CO_ROUTE_N                                                                                           \
  (2 + (USE_LSS ? 1 : 0) + (USE_LSS_MASTER ? 1 : 0) + CO_SSDO_N + (USE_CSDO ? CO_CSDO_N : 0) + CO_HBCONS_N + \
   CO_EMCY_CONS_N + (USE_SYNC ? 1 : 0) + (USE_TIME ? 1 : 0) + CO_RPDO_N + (USE_PDO_RTR ? CO_TPDO_N : 0))
#if CO_ROUTE_N > 255
typedef uint16_t CO_ROUTE_NUM;
#else
typedef uint8_t CO_ROUTE_NUM;
#endif

#define CO_ROUTE_CLASS_N (USE_FAST_PATHS ? 17 : 1)

typedef struct CO_ROUTES_T {  ///< who gets the frames of an identifier
  /// First route of each function code (CAN-ID >> 7) and of the 29-bit identifiers, or of all, and the end.
  CO_ROUTE_NUM Start[CO_ROUTE_CLASS_N + 1];
  uint32_t Id[CO_ROUTE_N + 1];  ///< identifiers with flags, ascending, and an end that is none
  uint16_t Owner[CO_ROUTE_N];   ///< service in bits 15…12, number of its instance in bits 11…0
} CO_ROUTES;

typedef struct CO_TX_QUEUE_T {  ///< frames that wait for the controller, by priority
  CO_IF_FRM* Frame;
  uint16_t Len;
  uint16_t Num;
  uint16_t Fixed;  ///< frames at the head that nothing may overtake: up to and including the boot-up
} CO_TX_QUEUE;
/// \endcond

/// A node. The application uses members as handles (&node.Dict, &node.Emcy, &node.Nmt, &node.Tmr, …), reads NodeId and
/// Baudrate, and touches nothing else. What is used most lies in front, where small CPUs reach it in one instruction.
typedef struct CO_NODE_T {
  uint8_t NodeId;
  uint8_t State;       ///< runs, serves a frame, changes its NMT state: bits
  uint8_t Pending;     ///< what is to be done when it has been answered
  uint8_t Paused;      ///< a block transfer waits for the controller, or for the next call that continues it
  uint8_t Burst;       ///< segments of block transfers in this call
  uint8_t Turn;        ///< whose turn it is when a block transfer may go on
  uint8_t OdLocked;    ///< CO_NODE_EXT.OdLock is held
  uint8_t Touched;     ///< change of an object while it is: TPDOs are to be sent
  uint8_t Held;        ///< nothing may be sent: the bit rate is being switched
  uint8_t WindowOver;  ///< the synchronous window is over
#if USE_PARA
  uint8_t Verified;  ///< 1020h is not 0
#endif
#if USE_REAL_TIME
  uint8_t InTurn;  ///< CO_NODE_EXT.Enter has been called
#endif
  CO_NMT Nmt;
  uint16_t RPdoFirst;  ///< of the RPDOs that wait for the SYNC, by CO_RPDO.Next
  uint16_t RPdoLast;
  uint16_t TPdoFirst;  ///< of the synchronous TPDOs, by CO_TPDO.Next
  const CO_NODE_EXT* Ext;
  CO_TX_QUEUE TxQueue;
  CO_IF If;
  CO_OBJ* Served;      ///< object of the SDO transfer being served; null: none
  uint32_t UserAbort;  ///< set by COObjTypeUserSDOAbort() for it
  enum CO_ERR_T Error;
  CO_NODE_COUNTERS Count;
  CO_ROUTES Routes;
  CO_DICT Dict;
  CO_TMR Tmr;
  uint32_t Baudrate;
  CO_SDO Sdo[CO_SSDO_N];
  uint8_t* SdoBuf;
  CO_TMR_MEM SdoTmr;
  CO_TMR_MEM HbProdTmr;
#if USE_CSDO
  CO_CSDO CSdo[CO_CSDO_N];
#endif
#if USE_EMCY
  CO_EMCY Emcy;
#endif
#if CO_RPDO_N > 0
  CO_RPDO RPdo[CO_RPDO_N];
#endif
#if CO_TPDO_N > 0
  CO_TPDO TPdo[CO_TPDO_N];
#endif
#if USE_SYNC
  CO_SYNC Sync;
#endif
#if USE_TIME
  CO_TIME Time;
#endif
#if USE_LED
  CO_LED Led;
#endif
#if USE_LSS
  CO_LSS Lss;
#endif
#if USE_LSS_MASTER
  CO_LSSM Lssm;
#endif
#if USE_PARA
  CO_TMR_MEM ParaTmr;  ///< groups that are stored autonomously
#if CO_PARA_BUDGET > 0
  uint8_t StoresUsed;    ///< of CO_PARA_BUDGET
  uint8_t StorePayer;    ///< whether the write in progress is counted
  CO_TMR_MEM BudgetTmr;  ///< refills CO_PARA_BUDGET
#endif
#endif
#if USE_GUARDING
  uint8_t GuardToggle;  ///< bit 7 of the next answer
  uint8_t GuardLost;    ///< the NMT master is missing
  CO_TMR_MEM GuardTmr;
#endif
#if CO_HBCONS_N > 0
  CO_TMR_MEM HbConsTmr;             ///< of all consumers
  CO_HB_WATCH HbCons[CO_HBCONS_N];  ///< by sub-index
#endif
#if USE_MPDO
  CO_MPDO Mpdo;
#endif
  CO_IF_FRM TxFrame[CO_TX_QUEUE_N];
  uint32_t ErrorKey;  ///< key of the object that Error is about
} CO_NODE;

/// Initialises a node and its drivers and puts the controller on the bus; nothing is sent. The node is then in CO_INIT;
/// CONodeGetErr() returns what went wrong. These errors leave the node in CO_INVALID, no other one stops it:
/// - CO_ERR_NODE_EXT, CO_ERR_NODE_CAN, CO_ERR_NODE_TIMER, CO_ERR_NODE_TMR_FREQ: no driver has been called, and none
/// will;
/// - CO_ERR_NODE_ID, CO_ERR_NODE_DICT: the drivers are initialised, the controller stays off the bus;
/// - CO_ERR_DICT_INIT, likewise: the dictionary is refused, CODictGetFault() names the entry.
///
/// \a node and what \a spec points to stay the caller's and must live as long as the node; \a spec itself need not.
/// Null arguments end in CONodeFatalError().
///
/// "undefined reference to CONodeInit_of_a_library_with_the_same_co_cfg_values_…" is the linker's refusal of a library
/// that was compiled with another configuration than the program (co_configuration.h): give both the same definitions,
/// preset and co_cfg.h.
void CONodeInit(CO_NODE* node, const CO_NODE_SPEC* spec) CO_CONFIGURED("CONodeInit");

/// The same with everything that CO_NODE_SPEC has no place for. CONodeInit() is this with a null \a ext.
void CONodeInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) CO_CONFIGURED("CONodeInitEx");

/// From CO_INIT: sends the boot-up message and enters Pre-operational. [301:7.3.2.2.1] Else nothing.
void CONodeStart(CO_NODE* node);

/// Stops the timers of the stack, goes off the bus; the node is in CO_INVALID until CONodeInit().
void CONodeStop(CO_NODE* node);

/// Returns the last error and clears it. COErrName() and COErrText() (co_err.h) say what it means, CONodeGetErrKey()
/// which object it is about.
/// \retval CO_ERR_NONE     no error since the last call
/// \retval CO_ERR_BAD_ARG  \a node is null
CO_ERR CONodeGetErr(CO_NODE* node);

/// Returns the key of the object that the last error is about: the error that CONodeGetErr() returned last or, if there
/// is a newer one, will return. It may be called before CONodeGetErr() or after it. CO_GET_IDX() and CO_GET_SUB()
/// return index and sub-index; the flags are 0. The object is
/// - CO_ERR_DICT_INIT: the entry that CODictGetFault() names;
/// - CO_ERR_OBJ_INIT: the first entry whose Init function failed;
/// - CO_ERR_RPDO_COM_OBJ, CO_ERR_TPDO_COM_OBJ: sub-index 1 (COB-ID) or 2 (transmission type) of 1400h… or 1800h…;
/// - CO_ERR_RPDO_MAP_OBJ, CO_ERR_TPDO_MAP_OBJ: the entry of 1600h… or 1A00h… that is wrong, or the first one behind 64
///   bits; sub-index 0: there are no entries, too many, or the PDO cannot be a multiplex PDO;
/// - CO_ERR_PARA_… and an error of a group that is stored autonomously: the sub-index of 1010h;
/// - CO_ERR_CFG_…, CO_ERR_OBJ_RANGE_LOW: the object that is missing or has a wrong value;
/// - CO_ERR_SDO_READ, CO_ERR_SDO_WRITE: the object of the transfer;
/// - an error of a type function that a PDO, 1001h or 1003h has called: the object;
/// - COTPdoTrigObj(), OD_requestTPDO(): the object; COTPdoTrigPdo(): the TPDO, sub-index 0 of 1800h….
/// \retval 0  the error is about no object, CONodeGetErr() returned CO_ERR_NONE, or \a node is null
uint32_t CONodeGetErrKey(const CO_NODE* node);

/// Reads and processes at most one frame, after the frames that still wait to be sent were offered to the driver and
/// paused block transfers continued, by up to CO_SDO_BLOCK_PACE segments in a call. COTmrProcess() continues both, too.
/// Blocks only if the driver's Read does. In CO_INVALID it reads one frame and drops it, counted as received and
/// unclaimed, unless the node has no drivers.
void CONodeProcess(CO_NODE* node);

/// The part of a real-time thread, to be called at a fixed rate where CO_NODE_EXT.Mainline is given: COTmrService(),
/// all frames that the driver has, of which those of SYNC and PDOs are served and the others left to CONodeProcess(),
/// and the timers of SYNC and PDOs. The driver's Read must not block. All in one turn, for which it waits, at most, for
/// a frame or a timer action of another thread, or for what the application does in a turn. After CONodeStop() the
/// timers of the application go on, and each call drops a frame, as CONodeProcess() does.
///
/// The other thread, the mainline, calls CONodeProcess() and COTmrProcess(), which runs all other timers. Order is kept
/// among the frames of either. Resets (CONmtReset()) are the mainline's, too: whoever asks for one, and wherever, it
/// waits for CONodeProcess(). So does the report of frames that found the ring full, once for all that are lost since
/// the last (CORingLost() counts them): CO_CAN_OVERRUN, with EMCY 8110h and CONodeCanChange().
///
/// Callbacks run where what they tell of happens: in this function COPdoReceive(), COPdoUpdate(), COPdoSyncUpdate(),
/// and COPdoTransmit() of PDOs that a SYNC, a timer or a remote request sends. COPdoTransmit() also runs in the
/// mainline, or wherever the application asks for a PDO: by COTPdoRequest() and its like, an object with flag A, the
/// NMT state. PDOs that share their identifier with another service are the mainline's altogether. Read and Write
/// functions of mapped types, COLedChange(), and what a callback leads to by itself (CONmtModeChange() by
/// CONmtSetMode()) run in either. All other callbacks are the mainline's.
void CONodeRealTime(CO_NODE* node) CO_NEEDS(USE_REAL_TIME);

/// Ticks until COTmrService() and COTmrProcess() have something to do: timers, frames that the driver has refused
/// (again after 1 ms), paused block transfers. 0 = now, UINT32_MAX = nothing is planned. Received frames end the wait
/// sooner.
uint32_t CONodeNextDeadline(CO_NODE* node);

/// To be called by a CAN driver or the loop: the controller has changed its state. Counts it and calls
/// CONodeCanChange(). SocketCAN error frames read by the driver are turned into it by the node itself, in
/// CONodeProcess(). Context: the loop; of several threads the mainline.
void CONodeCanEvent(CO_NODE* node, CO_CAN_EVENT event);

/// A copy of the counters; all 0 if \a node is null.
CO_NODE_COUNTERS CONodeGetCounters(const CO_NODE* node);

/// The user pointer of CO_NODE_EXT; null if there is none.
void* CONodeGetUser(const CO_NODE* node);

/// \name Callbacks of the application (see co_nmt.h on how to define them)
/// \{

/// A frame that no service of the node has claimed; not called in CO_INIT and CO_INVALID. Where there is a real-time
/// thread: see CO_NODE_EXT.Foreign.
void COIfCanReceive(CO_IF_FRM* frm);

/// The CAN controller has changed its state.
void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event);
/// \}

#ifdef __cplusplus
}
#endif

#endif
