// SPDX-License-Identifier: Apache-2.0
/// \file co_core.h
/// A CANopen node. This is the only header that an application has to include, except for co_ver.h.
///
/// Contexts: all functions of the stack are called from one context, the loop (or one task), with two exceptions:
/// COTmrService() (timer interrupt) and CORingPut() (producer end of a driver's queue). With USE_REAL_TIME several
/// threads may use a node under the node lock: see CO_NODE_EXT.Enter.
///
/// Null pointers: a function that returns CO_ERR returns CO_ERR_BAD_ARG; other functions call CONodeFatalError() and
/// return, unless their description says otherwise.
#ifndef CO_CORE_H_
#define CO_CORE_H_

#include "co_callbacks.h"
#include "co_cfg.h"
#include "co_domain.h"
#include "co_gfc.h"
#include "co_module_list.h"
#include "co_number.h"
#include "co_os.h"
#include "co_para.h"
#include "co_pdo_types.h"
#include "co_ring.h"
#include "co_sdo.h"
#include "co_string.h"
#include "co_time_of_day.h"
#include "lexican/detail/configuration.h"
#include "lexican/detail/needs.h"
#include "lexican/detail/node.h"

#if USE_OD
#include "co_od.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Initialisation data of a node, filled by position or member by member. Read during CONodeInit() only.
typedef struct CO_NODE_SPEC_T {
  uint8_t NodeId;                  ///< 1…127, or CO_LSS_NO_NODE_ID (co_lss.h)
  uint32_t Baudrate;               ///< bit/s
  struct CO_OBJ_T* Dict;           ///< the dictionary; may be const (cast it), must live as long as the node
  uint16_t DictLen;                ///< length of that array
  struct CO_EMCY_TBL_T* EmcyCode;  ///< errors of the application (co_emcy.h), may be null
  struct CO_TMR_MEM_T* TmrMem;     ///< timers of the application, may be null; the stack uses none of them
  uint16_t TmrNum;                 ///< length of that array, may be 0
  uint32_t TmrFreq;                ///< ticks of the timer driver per second, not 0
  CO_IF_DRV* Drv;                  ///< classic drivers (without context); may be null if CO_NODE_EXT names all drivers
  uint8_t* SdoBuf;                 ///< CO_SSDO_N * CO_SDO_BUF_BYTE bytes, or null
} CO_NODE_SPEC;

/// Settings that are not in CO_NODE_SPEC. Initialise the structure with zero, set Size, then the members that the
/// application needs. The node only reads it; it must live as long as the node.
typedef struct CO_NODE_EXT_T {
  uint32_t Size;                    ///< sizeof(CO_NODE_EXT)
  const CO_IF_CAN_DRV_EX* Can;      ///< CAN driver with context, or null: CO_NODE_SPEC.Drv
  void* CanCtx;                     ///< argument of the functions of Can
  const CO_IF_TIMER_DRV_EX* Timer;  ///< timer driver with context, or null: CO_NODE_SPEC.Drv
  void* TimerCtx;                   ///< argument of the functions of Timer
  const CO_IF_NVM_DRV_EX* Nvm;      ///< memory driver with context, or null: CO_NODE_SPEC.Drv
  void* NvmCtx;                     ///< argument of the functions of Nvm
  CO_IF_FRM* TxQueue;               ///< memory for the transmit queue, or null: CO_TX_QUEUE_N frames in the node
  uint16_t TxQueueLen;              ///< frames at TxQueue
  void (*Lock)(void* user);         ///< replaces COTmrLock() and COTmrUnlock(); both or none
  void (*Unlock)(void* user);       ///< counterpart of Lock
  /// Returns whether \a size bytes at \a address may be written; null: all addresses may. Called before a basic type
  /// stores a value. It protects tables and variables that the linker has placed in read-only memory: on false the
  /// write is refused with CO_ERR_OBJ_ACC.
  bool (*Writable)(void* user, const void* address, uint32_t size);
  void* User;  ///< for the functions above and below, and for CONodeGetUser()
  /// Lock that the stack holds while it copies mapped objects (co_pdo.h); both functions or none. Calls do not nest.
  void (*OdLock)(void* user);
  void (*OdUnlock)(void* user);  ///< releases the lock of OdLock
  uint16_t EmcyNum;              ///< number of errors in CO_NODE_SPEC.EmcyCode; 0: CO_EMCY_N
#if USE_REAL_TIME
  /// The node lock, both functions or none: a mutex, or a function that disables an interrupt. The node works only
  /// while the lock is held, so any thread may use it. It is locked by
  ///   - the stack, in CONodeProcess(), CONodeRealTime(), COTmrProcess() (for each action) and CONodeNextDeadline();
  ///   - the application, around every other call and every access to memory that the node may use: CO_LOCK_OD(),
  ///     CO_LOCK_CAN_SEND() and CO_LOCK_EMCY() of co_od.h are three names of it.
  /// Callbacks, timer actions, type functions and driver functions run with the lock held. They must neither lock it
  /// again nor call one of those four functions: calls do not nest. A program with a single thread does not need the
  /// lock. A driver must not block, because other threads wait for the lock. While a memory driver that has a Shape
  /// function reads, writes or erases, the stack releases the lock; therefore only one thread may store, load or reset.
  void (*Enter)(void* user);
  void (*Leave)(void* user);  ///< releases the lock of Enter
  /// Ring of the frames that CONodeRealTime() does not process itself and hands over to CONodeProcess(). Prepared by
  /// CORingInit(); the application must not access it afterwards. Null: no real-time thread.
  CO_RING* Mainline;
  /// Whether CONodeRealTime() also puts unrelated frames (no consumer in this node) into Mainline, for applications
  /// that define COIfCanReceive(). False: such frames are counted (CO_NODE_COUNTERS.Unclaimed) and discarded.
  bool Foreign;
#endif
#if USE_OD
  struct OD_T_* Od;  ///< index of the dictionary (co_od.h), or null: no object can be extended
#endif
  const CO_CALLBACKS* Callbacks;  ///< functions that receive the node and User (co_callbacks.h), or null
  uint32_t SdoBufLen;             ///< bytes at CO_NODE_SPEC.SdoBuf (CO_SDO_BUFFER()); 0: unknown, not checked
} CO_NODE_EXT;

/// Initialises a node and its drivers and puts the controller on the bus; no frame is sent. The node is then in
/// CO_INIT, and CONodeGetErr() returns the last error. Only these errors leave the node in CO_INVALID:
/// - CO_ERR_NODE_EXT, CO_ERR_NODE_CAN, CO_ERR_NODE_TIMER, CO_ERR_NODE_TMR_FREQ: the node calls no driver, now or later;
/// - CO_ERR_NODE_ID, CO_ERR_NODE_DICT, CO_ERR_NODE_SDO_BUF: the drivers are initialised, the controller is off the bus;
/// - CO_ERR_DICT_INIT: the drivers are initialised, the controller stays off the bus; CODictGetFault() returns the
///   faulty entry.
///
/// The caller owns \a node and all memory that \a spec refers to; they must live as long as the node. \a spec itself
/// may be destroyed after the call. A null argument calls CONodeFatalError().
///
/// The linker error "undefined reference to CONodeInit_of_a_library_with_the_same_co_cfg_values_…" means that the
/// library was compiled with another configuration than the program (lexican/detail/configuration.h): compile both with
/// the same definitions, preset and co_cfg.h.
void CONodeInit(CO_NODE* node, const CO_NODE_SPEC* spec) CO_CONFIGURED("CONodeInit");

/// Like CONodeInit(), with the settings of \a ext. CONodeInit() is CONodeInitEx() with a null \a ext.
void CONodeInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) CO_CONFIGURED("CONodeInitEx");

/// Like CONodeInitEx(), for programs whose drivers all have a context argument (CO_NODE_EXT.Can, Timer and Nvm):
/// CO_NODE_SPEC.Drv is not used, and the program does not contain the adapters for classic drivers (about 530 bytes). A
/// memory driver needs its Shape function: without, no parameter group is stored.
void CONodeInitCtx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) CO_CONFIGURED("CONodeInitCtx");

/// Sends the boot-up message and enters Pre-operational, if the node is in CO_INIT; otherwise has no effect.
/// [CiA 301, 7.3.2.2.1]
void CONodeStart(CO_NODE* node);

/// Stops the timers of the stack and takes the controller off the bus; the node is in CO_INVALID until CONodeInit().
/// In a callback or type function this happens where the outermost call ends: the node's memory must be valid, and
/// CONodeInit() must not be called, until then. No further frame is transmitted.
void CONodeStop(CO_NODE* node);

/// Returns the last error and clears it. COErrName() and COErrText() (co_err.h) return its name and its meaning,
/// CONodeGetErrKey() the object that it is about.
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

/// Bytes that the longest text of CONodeGetErrText() needs, with its NUL.
#define CO_NODE_ERR_TEXT 400

/// Like CONodeGetErr(), and writes name, object and meaning of the error to \a text, with the fault of the dictionary
/// if there is one: "CO_ERR_TPDO_MAP_OBJ, object 1A00h:02: …". For CO_ERR_NONE the text is "no error", and what is
/// missing: CONodeStart(), a bit rate, COTmrService() or COTmrProcess() for a timer that has elapsed, 1017h. Text
/// beyond \a size bytes is cut off; it always ends with a NUL. Names and meanings take about 8 KB of flash, only in a
/// program that calls this function, COErrName(), COErrText() or those of co_dict.h. With USE_DICT_CHECK 0 each call
/// returns CO_ERR_DICT_INIT while entries are in the wrong order, also if the node runs.
///
/// \retval CO_ERR_NONE       no error since the last call
/// \retval CO_ERR_DICT_INIT  the dictionary is refused, or its entries are in the wrong order
/// \retval CO_ERR_BAD_ARG    an argument is null, or \a size is 0
CO_ERR CONodeGetErrText(CO_NODE* node, char* text, uint32_t size);

/// Reads and processes at most one frame. Before that, it offers the frames in the transmit queue to the driver and
/// continues paused block transfers by up to CO_SDO_BLOCK_PACE segments; COTmrProcess() does both, too. Blocks only if
/// the driver's Read function does. In CO_INVALID it reads one frame and discards it, counted as received and
/// unclaimed, unless the node has no drivers.
void CONodeProcess(CO_NODE* node);

/// Runs the real-time part of the node; to be called at a fixed rate by a real-time thread where CO_NODE_EXT.Mainline
/// is given. It calls COTmrService(), reads all frames that the driver has, processes those of SYNC and PDOs, puts the
/// others into the ring Mainline for CONodeProcess(), and runs the timers of SYNC and PDOs. The driver's Read function
/// must not block. The function holds the node lock throughout. It waits for the lock at most while another thread
/// processes a frame, runs a timer action, or holds the lock in the application. After CONodeStop() the timers of the
/// application still run, and each call discards one frame, as in CONodeProcess().
///
/// The other thread, the mainline, calls CONodeProcess() and COTmrProcess(), which run all other timers. The order of
/// frames is kept among the frames of either thread. Resets (CONmtReset()) are executed by the mainline: a reset
/// requested in any thread is deferred to the next CONodeProcess(). The report of frames that were lost because the
/// ring was full is deferred likewise: one CO_CAN_OVERRUN, with EMCY 8110h and CONodeCanChange(), for all frames lost
/// since the last report (CORingLost() counts them).
///
/// Callbacks run in the thread in which their event occurs. This function calls COPdoReceive(), COPdoUpdate(),
/// COPdoSyncUpdate(), and COPdoTransmit() of PDOs that a SYNC, a timer or a remote request triggers. COPdoTransmit()
/// also runs in the mainline, or in the thread in which the application triggers a PDO: by COTPdoRequest() and similar
/// functions, by an object with flag A, or by a change of the NMT state. PDOs that share their identifier with another
/// service are processed by the mainline only. Read and Write functions of mapped types, COLedChange(), and callbacks
/// that are caused by another callback (for example CONmtModeChange() by CONmtSetMode()) run in either thread. All
/// other callbacks run in the mainline.
void CONodeRealTime(CO_NODE* node) CO_NEEDS(USE_REAL_TIME);

/// Returns the time in ticks until COTmrService() and COTmrProcess() have work to do: timers, frames that the driver
/// has refused (offered again after 1 ms), paused block transfers. 0: now; UINT32_MAX: nothing is planned. A received
/// frame has to be processed earlier.
uint32_t CONodeNextDeadline(CO_NODE* node);

/// Reports a change of the CAN controller's state: counts it and calls CONodeCanChange(). To be called by a CAN driver
/// or the loop. Context: the loop; with several threads the mainline.
void CONodeCanEvent(CO_NODE* node, CO_CAN_EVENT event);

/// Returns a copy of the counters; all are 0 if \a node is null.
CO_NODE_COUNTERS CONodeGetCounters(const CO_NODE* node);

/// Sets the manufacturer status register, 1002h (a CO_TUNSIGNED32, not flag D), to \a status. A change triggers the
/// event-driven TPDOs that map it, with or without flag A. [CiA 301, 7.5.2.3]
/// \retval CO_ERR_NONE           1002h has the value
/// \retval CO_ERR_BAD_ARG        \a node is null or was never initialised
/// \retval CO_ERR_OBJ_NOT_FOUND  there is no 1002h
/// \retval CO_ERR_OBJ_ACC        1002h holds its value in the table (flag D), or is in read-only memory
/// \retval CO_ERR_OBJ_SIZE       1002h is not a number of 32 bits
CO_ERR CONodeSetStatus(CO_NODE* node, uint32_t status);

/// Returns the manufacturer status register, 1002h; 0 if it cannot be read, or \a node is null.
uint32_t CONodeGetStatus(CO_NODE* node);

/// Returns CO_NODE_EXT.User; null if there is none, or \a node is null.
void* CONodeGetUser(const CO_NODE* node);

/// \name Callbacks of the application (see co_nmt.h on how to define them)
/// \{

/// Called for a received frame that no service of the node consumes; not called in CO_INIT and CO_INVALID. With a
/// real-time thread: see CO_NODE_EXT.Foreign.
void COIfCanReceive(CO_IF_FRM* frm);

/// Called when the CAN controller has changed its state.
void CONodeCanChange(CO_NODE* node, CO_CAN_EVENT event);
/// \}

#ifdef __cplusplus
}
#endif

#endif
