// SPDX-License-Identifier: Apache-2.0
/// \file co_core.h
/// A CANopen node. This is the only header that an application has to include, except for co_ver.h. A whole device,
/// where the program also has the dictionary Od of OD_LENGTH entries (docs/cookbook.md), the drivers BoardCan and
/// BoardTimer (docs/porting.md), and functions that disable and enable the interrupt of the timer:
///
///     #include "co_core.h"
///     static CO_NODE Node;
///     void TimerInterrupt(void) { COTmrService(&Node.Tmr); }
///     void COTmrLock(void) { BoardTimerInterruptDisable(); }
///     void COTmrUnlock(void) { BoardTimerInterruptEnable(); }
///     int main(void) {
///       static const CO_NODE_EXT drivers = {.Size = sizeof(CO_NODE_EXT), .Can = &BoardCan, .Timer = &BoardTimer};
///       CO_NODE_SPEC spec = {.NodeId = 5, .Baudrate = 250000, .Dict = Od, .DictLen = OD_LENGTH, .TmrFreq = 1000};
///       CONodeInitCtx(&Node, &spec, &drivers);
///       CONodeStart(&Node);
///       for (;;) { CONodeProcess(&Node); COTmrProcess(&Node.Tmr); }
///     }
///
/// Contexts: all functions of the stack are called from one context, the loop (or one task), with two exceptions:
/// COTmrService() (timer interrupt) and CORingPut() (producer end of a driver's queue). With USE_REAL_TIME several
/// threads may use a node under the node lock (co_real_time.h).
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
#include "co_real_time.h"
#include "co_ring.h"
#include "co_sdo.h"
#include "co_string.h"
#include "co_time_of_day.h"
#include "lexican/detail/configuration.h"
#include "lexican/detail/node.h"

#if USE_OD
#include "co_od.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Initialisation data of a node, filled by position or member by member. Read during CONodeInitCtx() only.
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
  void (*Enter)(void* user);  ///< node lock (co_real_time.h): locks it; both functions or none
  void (*Leave)(void* user);  ///< releases the lock of Enter
  CO_RING* Mainline;          ///< frames for CONodeProcess() (co_real_time.h); null: no real-time thread
  bool Foreign;               ///< whether Mainline receives unrelated frames, too (co_real_time.h)
#endif
#if USE_OD
  struct OD_T_* Od;  ///< index of the dictionary (co_od.h), or null: no object can be extended
#endif
  const CO_CALLBACKS* Callbacks;  ///< functions that receive the node and User (co_callbacks.h), or null
  uint32_t SdoBufLen;             ///< bytes at CO_NODE_SPEC.SdoBuf (CO_SDO_BUFFER()); 0: unknown, not checked
#if USE_TIME_HIGH_RES
  /// Returns a counter of microseconds that wraps at 2^32, for the high-resolution time stamp (co_time.h); null: the
  /// timer. Called where SYNC is processed, and by the functions of that clock.
  uint32_t (*Microseconds)(void* user);
#endif
} CO_NODE_EXT;

/// \name Functions of a device, in the order of use
/// 1. CONodeInitCtx()
/// 2. CONodeGetErr(), CONodeGetErrText() (co_err.h): return the error of the initialisation, later the last error
/// 3. CONodeStart()
/// 4. COTmrService() (co_tmr.h): called by the timer interrupt
/// 5. CONodeProcess()
/// 6. COTmrProcess() (co_tmr.h): runs elapsed timers in the loop
/// 7. CONodeNextDeadline()
/// 8. CONodeCanEvent()
/// 9. COTPdoRequest() (co_pdo.h): sends a TPDO
/// 10. COEmcySet(), COEmcyClr() (co_emcy.h): set and clear an error
/// 11. CODictRdByte(), CODictWrByte() and similar (co_dict.h): read and write an object
/// 12. CONodeStop()
/// \{

/// Initialises a node and its drivers, those of \a ext, and puts the controller on the bus; no frame is sent.
/// CO_NODE_SPEC.Drv is not used. The node is then in CO_INIT, and CONodeGetErr() returns the last error. Only these
/// errors leave the node in CO_INVALID:
/// - CO_ERR_NODE_EXT, CO_ERR_NODE_CAN, CO_ERR_NODE_TIMER, CO_ERR_NODE_TMR_FREQ: the node calls no driver, now or later;
/// - CO_ERR_NODE_ID, CO_ERR_NODE_DICT, CO_ERR_NODE_SDO_BUF: the drivers are initialised, the controller is off the bus;
/// - CO_ERR_DICT_INIT: the drivers are initialised, the controller stays off the bus; CODictGetFault() returns the
///   faulty entry.
///
/// The caller owns \a node and all memory that \a spec refers to; they must live as long as the node. \a spec itself
/// may be destroyed after the call. A memory driver needs its Shape function: without, no parameter group is stored. A
/// null \a node or \a spec calls CONodeFatalError(); with a null \a ext the error is CO_ERR_NODE_CAN.
///
/// Linker error "undefined reference to CONodeInitCtx_SSDO1_RPDO16…": the library has another configuration than the
/// program, whose settings and values the symbol contains; "nm liblexican.a | grep CONodeInit_" prints those of the
/// library. Compile both with the same definitions, preset and co_cfg.h (lexican/detail/configuration.h).
void CONodeInitCtx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) CO_CONFIGURED("CONodeInitCtx");

/// Sends the boot-up message and enters Pre-operational, if the node is in CO_INIT; otherwise has no effect.
/// [CiA 301, 7.3.2.2.1]
void CONodeStart(CO_NODE* node);

/// Reads and processes at most one frame. Before that, it offers the frames in the transmit queue to the driver and
/// continues paused block transfers by up to CO_SDO_BLOCK_PACE segments; COTmrProcess() does both, too. Blocks only if
/// the driver's Read function does. In CO_INVALID it reads one frame and discards it, counted as received and
/// unclaimed, unless the node has no drivers.
void CONodeProcess(CO_NODE* node);

/// Returns the time in ticks until COTmrService() and COTmrProcess() have work to do: timers, frames that the driver
/// has refused (offered again after 1 ms), paused block transfers. 0: now; UINT32_MAX: nothing is planned. A received
/// frame has to be processed earlier.
uint32_t CONodeNextDeadline(CO_NODE* node);

/// Reports a change of the CAN controller's state: counts it and calls CO_CALLBACKS.CanChange. To be called by a CAN
/// driver or the loop. Context: the loop; with several threads the mainline.
void CONodeCanEvent(CO_NODE* node, CO_CAN_EVENT event);

/// Stops the timers of the stack and takes the controller off the bus; the node is in CO_INVALID until CONodeInitCtx().
/// In a callback or type function this happens where the outermost call ends: the node's memory must be valid, and
/// CONodeInitCtx() must not be called, until then. No further frame is transmitted.
void CONodeStop(CO_NODE* node);
/// \}

/// \name As in CANopen-Stack
/// Classic drivers (CO_NODE_SPEC.Drv, co_if.h), for which programs with these functions contain adapters (about 530
/// bytes), and callbacks that are functions with fixed names (CONmtModeChange() and others; co_nmt.h).
/// \{

/// Like CONodeInitCtx(), with classic drivers and without CO_NODE_EXT. The linker error names CONodeInit_SSDO1….
void CONodeInit(CO_NODE* node, const CO_NODE_SPEC* spec) CO_CONFIGURED("CONodeInit");

/// Like CONodeInitCtx(); CO_NODE_SPEC.Drv has the drivers that \a ext does not name. A null \a ext: CONodeInit().
void CONodeInitEx(CO_NODE* node, const CO_NODE_SPEC* spec, const CO_NODE_EXT* ext) CO_CONFIGURED("CONodeInitEx");
/// \}

#ifdef __cplusplus
}
#endif

#endif
