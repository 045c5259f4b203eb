// SPDX-License-Identifier: Apache-2.0
/// \file co_tmr.h
/// Timers: actions that run once after a time, or cyclically without drift, in the context of COTmrProcess().
///
/// Units: ticks of the timer driver's clock (CO_NODE_SPEC.TmrFreq per second).
/// Contexts: COTmrService() in the timer interrupt, everything else in the loop. COTmrProcess() and CONodeProcess()
/// belong to one context: both run services and callbacks and may send (two threads: CONodeRealTime()). COTmrLock() and
/// COTmrUnlock(), to be supplied by the application, keep the timer interrupt away from changes of the timers (default:
/// empty, right where COTmrService() is called from the loop, too).
/// Timers that are due at the same tick run in the order in which they were started; a cyclic timer starts anew with
/// each expiry. A late call of COTmrProcess() runs every expired timer once; a cyclic timer then skips the expiries
/// that were missed and keeps its phase.
#ifndef CO_TMR_H_
#define CO_TMR_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

#define CO_TMR_UNIT_1MS 1000u     ///< times given in milliseconds
#define CO_TMR_UNIT_100US 10000u  ///< times given in units of 100 microseconds (inhibit times)

/// The action of a timer; receives the parameter given at creation. May create and delete any timer, itself included.
typedef void (*CO_TMR_FUNC)(void*);

/// One timer. Applications declare arrays of it for CO_NODE_SPEC.TmrMem and do not touch the members.
typedef struct CO_TMR_MEM_T {
  struct CO_TMR_MEM_T* Next;
  CO_TMR_FUNC Func;
  void* Para;
  uint32_t At;      ///< clock at expiry
  uint32_t Cycle;   ///< ticks, 0: runs once
  uint16_t Id;      ///< of those of the pool: number in it in the low bits, generation above; of others: 1: it belongs
                    ///< to SYNC or a PDO (CONodeRealTime())
  uint8_t Running;  ///< armed, or elapsed and still to be run
  uint8_t Pooled;   ///< 1: belongs to the pool and has an id; 0: part of its owner
} CO_TMR_MEM;

typedef struct CO_TMR_T {
  CO_TMR_MEM* First;  ///< all that run: elapsed ones, oldest first, then armed ones, by time
  struct CO_NODE_T* Node;
  CO_TMR_MEM* Pool;
  CO_TMR_MEM* Free;    ///< unused timers of the pool
  CO_TMR_MEM** Armed;  ///< link to the first armed one: moved by COTmrService(), while COTmrProcess() takes the elapsed
  CO_TMR_MEM** End;    ///< link behind the last one that is armed, if there is one
  uint32_t Freq;       ///< ticks per second
  uint32_t Clock;      ///< driver with a clock: when that was read last; without: when it elapses, or was stopped
  uint32_t Programmed;  ///< ticks that a driver without a clock was told to wait, 0: stopped
  uint16_t Max;         ///< timers in the pool
  uint16_t IdStep;      ///< power of two: from one generation of an id to the next
} CO_TMR;

/// \a time in units of 1/\a unit seconds (CO_TMR_UNIT_…) in ticks, rounded up: never early.
/// Returns 0 if \a time, \a unit or the timer frequency is 0, or the result does not fit in 32 bits.
uint32_t COTmrGetTicks(CO_TMR* tmr, uint16_t time, uint32_t unit);

/// The shortest time that can be told apart, in units of 1/\a unit seconds: at least 1, rounded up.
/// Returns 0 if \a unit or the timer frequency is 0, or the result does not fit in 16 bits.
uint16_t COTmrGetMinTime(CO_TMR* tmr, uint32_t unit);

/// Starts a timer: \a func(\a para) runs \a startTicks from now (0: after \a cycleTicks) and then every \a cycleTicks
/// (0: once). Returns an id (>= 0), opaque: it is used up when the timer has run for the last time or was deleted. A
/// used-up id matches no younger timer until its place in the pool was used 32768 / (pool size, rounded up to a power
/// of two) times more.
/// Returns -1: both times 0, \a func null (CO_ERR_BAD_ARG), no free timer (CO_ERR_TMR_NO_ACT; also counted). A null
/// \a tmr or a timer management without node ends in CONodeFatalError().
int16_t COTmrCreate(CO_TMR* tmr, uint32_t startTicks, uint32_t cycleTicks, CO_TMR_FUNC func, void* para);

/// Deletes a timer at any moment: running, elapsed but not yet run, or from its own action.
/// Returns 0; -1 if there is no such timer (any more).
int16_t COTmrDelete(CO_TMR* tmr, int16_t actId);

/// To be called from the timer interrupt (or the loop, where the driver is polled). Takes no lock and runs no action.
/// \retval 1 COTmrProcess() has work: elapsed timers, frames that the driver has refused, a paused block transfer
/// \retval 0 it has none
/// \retval -1 \a tmr is null
int16_t COTmrService(CO_TMR* tmr);

/// Runs the actions of all timers that COTmrService() has found elapsed, without the lock held. Before that, it offers
/// frames that the driver has refused again, and continues block transfers by up to CO_SDO_BLOCK_PACE segments, as
/// CONodeProcess() does. So a firmware may call CONodeProcess() only when a frame has arrived, if it calls
/// COTmrProcess() cyclically, or whenever a cyclic COTmrService() returns 1. A firmware whose timer interrupt comes
/// only for the next timer has to ask CONodeNextDeadline(): frames and segments that wait do not start a timer.
void COTmrProcess(CO_TMR* tmr);

/// Prepares the timer management of a node; CONodeInit() does it. \a mem: \a num timers, the caller's for as long as
/// the node lives, may be null if \a num is 0; \a freq: ticks per second.
void COTmrInit(CO_TMR* tmr, struct CO_NODE_T* node, CO_TMR_MEM* mem, uint16_t num, uint32_t freq);

/// To be supplied by the application where COTmrService() runs in an interrupt: keep it away, let it in again.
/// Calls do not nest. Defaults: empty.
void COTmrLock(void);
void COTmrUnlock(void);

#ifdef __cplusplus
}
#endif

#endif
