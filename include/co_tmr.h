// SPDX-License-Identifier: Apache-2.0
/// \file co_tmr.h
/// Timers: actions that run once after a time, or cyclically without drift, in the context of COTmrProcess().
///
/// Units: ticks of the timer driver's clock (CO_NODE_SPEC.TmrFreq per second).
///
/// Contexts: COTmrService() in the timer interrupt, all other functions in the loop. COTmrProcess() and CONodeProcess()
/// are called from one context, because both run services and callbacks and may send (with two threads:
/// CONodeRealTime()). COTmrLock() and COTmrUnlock(), which the application defines, keep the timer interrupt from
/// accessing the timers while they are changed (default: empty, for programs that call COTmrService() from the loop).
///
/// Timers that are due at the same tick run in the order in which they were started; a cyclic timer counts as started
/// anew at each expiry. A late call of COTmrProcess() runs every expired timer once; a cyclic timer then skips the
/// missed expiries and keeps its phase.
#ifndef CO_TMR_H_
#define CO_TMR_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

#define CO_TMR_UNIT_1MS 1000u     ///< times given in milliseconds
#define CO_TMR_UNIT_100US 10000u  ///< times given in units of 100 microseconds (inhibit times)

/// Action of a timer; receives the parameter given at creation. It may create and delete any timer, including its own.
typedef void (*CO_TMR_FUNC)(void*);

/// A timer. Applications declare arrays of it for CO_NODE_SPEC.TmrMem and must not access the members.
typedef struct CO_TMR_MEM_T {
  struct CO_TMR_MEM_T* Next;  ///< link of the list of running timers, or of unused timers of the pool
  CO_TMR_FUNC Func;           ///< action
  void* Para;                 ///< argument of Func
  uint32_t At;                ///< clock at expiry
  uint32_t Cycle;             ///< period in ticks; 0: runs once
  uint16_t Id;                ///< timer of the pool: its number in the low bits, generation above
  uint8_t Running;            ///< armed, or elapsed and still to be run
  uint8_t Owner;              ///< 0: a module of the stack; 1: the pool; 2: SYNC or a PDO (CONodeRealTime())
} CO_TMR_MEM;

/// The timers of a node: &node.Tmr. The application must not access the members. Invariants (timer.cpp,
/// is_consistent()):
/// - each running timer is in the list First once: elapsed ones, then from *Armed on armed ones, by time of expiry;
/// - End is the link behind the last armed timer, if there is one;
/// - each timer of the pool is running, in the list Free, or was never used (behind Used).
typedef struct CO_TMR_T {
  CO_TMR_MEM* First;       ///< running timers: elapsed ones, oldest first, then armed ones, by time
  struct CO_NODE_T* Node;  ///< owner
  CO_TMR_MEM* Pool;        ///< timers of the application: CO_NODE_SPEC.TmrMem, Max elements
  CO_TMR_MEM* Free;        ///< timers of the pool that were used before and are not now
  /// Link to the first armed timer: advanced by COTmrService(), while COTmrProcess() removes elapsed ones.
  CO_TMR_MEM** Armed;
  CO_TMR_MEM** End;  ///< link behind the last armed timer, if there is one
  uint32_t Freq;     ///< ticks per second
  uint32_t Clock;    ///< clock of the driver when it was read last
  uint16_t Max;      ///< timers in the pool
  uint16_t IdStep;   ///< step between two generations of an id, a power of two
  uint16_t Used;     ///< timers of the pool that have been used at least once
} CO_TMR;

/// Converts \a time, in units of 1/\a unit seconds (CO_TMR_UNIT_…), to ticks, rounded up, so that no timer expires
/// early.
/// \retval 0  \a time, \a unit or the timer frequency is 0, or the result does not fit in 32 bits
uint32_t COTmrGetTicks(CO_TMR* tmr, uint16_t time, uint32_t unit);

/// Returns the shortest time that the timer can resolve, in units of 1/\a unit seconds, rounded up: at least 1.
/// \retval 0  \a unit or the timer frequency is 0, or the result does not fit in 16 bits
uint16_t COTmrGetMinTime(CO_TMR* tmr, uint32_t unit);

/// Starts a timer that calls \a func(\a para) after \a startTicks (0: after \a cycleTicks) and then every \a cycleTicks
/// (0: once). Returns an id for COTmrDelete(). The id becomes invalid when the timer has run for the last time or was
/// deleted; an invalid id matches no later timer until its place in the pool was used 32768 / (pool size, rounded up to
/// a power of two) more times. A null \a tmr, or a CO_TMR without node, calls CONodeFatalError().
/// \retval >=0  id of the timer
/// \retval -1   both times are 0 or \a func is null (node error CO_ERR_BAD_ARG); or no timer is free (node error
///              CO_ERR_TMR_NO_ACT, counted in CO_NODE_COUNTERS.TimerExhausted)
int16_t COTmrCreate(CO_TMR* tmr, uint32_t startTicks, uint32_t cycleTicks, CO_TMR_FUNC func, void* para);

/// Deletes a timer at any moment: running, elapsed but not yet run, or from its own action.
/// \retval 0   the timer is deleted
/// \retval -1  no such timer exists
int16_t COTmrDelete(CO_TMR* tmr, int16_t actId);

/// Updates the timers; to be called from the timer interrupt, or from the loop where the driver is polled. Takes no
/// lock and runs no action.
/// \retval 1   COTmrProcess() has work to do: elapsed timers, frames that the driver has refused, a paused block
///             transfer
/// \retval 0   COTmrProcess() has no work to do
/// \retval -1  \a tmr is null
int16_t COTmrService(CO_TMR* tmr);

/// Runs the actions of all timers that COTmrService() has found elapsed, without holding the timer lock. Before that,
/// it offers frames that the driver has refused again, and continues block transfers by up to CO_SDO_BLOCK_PACE
/// segments, like CONodeProcess(). Therefore CONodeProcess() need be called only when a frame has arrived, provided
/// that COTmrProcess() is called cyclically, or whenever a cyclic COTmrService() returns 1. A firmware whose timer
/// interrupt occurs only at the next expiry has to use CONodeNextDeadline(), because queued frames and segments do not
/// start a timer.
/// A call in a callback or type function has no effect, because the stack's timers do not run while the node works; a
/// call in an action of the application's timers has. With CO_NODE_EXT.Mainline or Enter such calls are not permitted.
void COTmrProcess(CO_TMR* tmr);

/// Initialises the timers of a node; called by CONodeInit(). \a mem: \a num timers, owned by the caller, which must
/// live as long as the node; may be null if \a num is 0. \a freq: ticks per second.
void COTmrInit(CO_TMR* tmr, struct CO_NODE_T* node, CO_TMR_MEM* mem, uint16_t num, uint32_t freq);

/// Disables the timer interrupt. To be defined by the application where COTmrService() runs in an interrupt. Calls do
/// not nest. The default is empty.
void COTmrLock(void);
/// Enables the timer interrupt again. Defined together with COTmrLock().
void COTmrUnlock(void);

#ifdef __cplusplus
}
#endif

#endif
