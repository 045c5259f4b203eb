// SPDX-License-Identifier: Apache-2.0
/// \file co_virtual_clock.h
/// A clock that only the program advances, for tests and simulations in C; C++ programs may use virtual_clock.hpp
/// instead.
///
///     CO_VIRTUAL_CLOCK *clock = COVirtualClockNew();
///     CO_VIRTUAL_TIMER *timer = COVirtualTimerNew(clock);
///     ext.Timer = &COVirtualTimerDriver;  ext.TimerCtx = timer;     /* CO_NODE_EXT, a timer for each node */
///     for (;;) {
///       CONodeProcess(&node);
///       COTmrService(&node.Tmr);
///       COTmrProcess(&node.Tmr);
///       COVirtualClockAdvance(clock, 1);                            /* ticks of CO_NODE_SPEC.TmrFreq */
///     }
///
/// All nodes of a clock must have the same CO_NODE_SPEC.TmrFreq. Context: one thread. Owner: the caller; the clock must
/// outlive its timers, and these their nodes.
#ifndef CO_VIRTUAL_CLOCK_H_
#define CO_VIRTUAL_CLOCK_H_

#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A clock; the members are private.
typedef struct CO_VIRTUAL_CLOCK_T CO_VIRTUAL_CLOCK;
/// The timer of one node; the members are private.
typedef struct CO_VIRTUAL_TIMER_T CO_VIRTUAL_TIMER;

/// Returns a clock at tick 0; COVirtualClockFree() releases it. Ends the program if there is no memory.
CO_VIRTUAL_CLOCK* COVirtualClockNew(void);
/// Releases \a clock, which may be null. Its timers must have been released.
void COVirtualClockFree(CO_VIRTUAL_CLOCK* clock);

/// Advances the clock by \a ticks, stopping at each alarm that is due meanwhile.
void COVirtualClockAdvance(CO_VIRTUAL_CLOCK* clock, uint32_t ticks);
/// Advances the clock to the earliest alarm of its timers.
/// \retval true   the clock was advanced
/// \retval false  no alarm is set; the clock has not moved
bool COVirtualClockAdvanceToAlarm(CO_VIRTUAL_CLOCK* clock);
/// Returns the ticks since COVirtualClockNew(); they wrap at 2^32.
uint32_t COVirtualClockNow(const CO_VIRTUAL_CLOCK* clock);

/// Creates a timer of \a clock; COVirtualTimerFree() releases it. Ends the program if there is no memory.
CO_VIRTUAL_TIMER* COVirtualTimerNew(CO_VIRTUAL_CLOCK* clock);
/// Releases \a timer, which may be null. The node must not use it any more.
void COVirtualTimerFree(CO_VIRTUAL_TIMER* timer);

/// The driver; its context is a CO_VIRTUAL_TIMER.
extern const CO_IF_TIMER_DRV_EX COVirtualTimerDriver;

#ifdef __cplusplus
}
#endif

#endif
