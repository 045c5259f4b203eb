// SPDX-License-Identifier: Apache-2.0
// Timers. Armed ones wait in a list ordered by the clock of their expiry, elapsed ones in another in the order in which
// they have elapsed. A cyclic timer is armed again from its expiry: its phase does not depend on when it is run.
#pragma once

#include "co_cfg.h"
#include "co_tmr.h"

namespace co::tmr {

// ms as ticks, rounded up; 0 if 0 or beyond 32 bits.
[[nodiscard]] uint32_t ticks(const CO_TMR& timers, uint32_t time, uint32_t unit);

// Starts a timer that is part of its owner; one that runs is started anew. start and cycle as in COTmrCreate(), not
// both 0.
void start(CO_TMR& timers, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para);

// For the action of a timer that runs once: once more, some ticks after it has elapsed; where that is over, at the next
// multiple of them.
void again(CO_TMR& timers, CO_TMR_MEM& timer, uint32_t ticks);

// Stops a timer that is part of its owner; a stopped one stays stopped.
void stop(CO_TMR& timers, CO_TMR_MEM& timer);

// Calls a function, then runs the actions of all timers that have elapsed: where there is a real-time thread, of those
// of the mainline. Where threads take turns, the function and the search for timers share one.
void run(CO_TMR& timers, void (*before)(CO_NODE_T& node));

// A timer of SYNC or of a PDO: run_real_time() runs it where there is a real-time thread. For a timer that is part of
// its owner, once.
#if USE_REAL_TIME
inline void give_to_real_time(CO_TMR_MEM& timer) { timer.Id = 1; }
void run_real_time(CO_TMR& timers);
#else
inline void give_to_real_time(CO_TMR_MEM&) {}
#endif

[[nodiscard]] inline bool is_running(const CO_TMR_MEM& timer) { return timer.Running != 0; }

// A clock of ticks, starting anywhere, wrapping at 2^32. With a driver that has none, it goes while a timer runs.
[[nodiscard]] uint32_t now(CO_TMR& timers);

// Ticks until COTmrService() or COTmrProcess() has work; UINT32_MAX: none.
[[nodiscard]] uint32_t next_deadline(CO_TMR& timers);

}  // namespace co::tmr
