// SPDX-License-Identifier: Apache-2.0
// Timers. All that run are in one list: elapsed timers in the order in which they have elapsed, then armed timers in
// the order of the clock of their expiry. A cyclic timer is armed again from its expiry: its phase does not depend on
// when its action runs.
#pragma once

#include "co_cfg.h"
#include "co_core.h"

namespace co::tmr {

// Converts a time in units of 1/unit seconds (CO_TMR_UNIT_…) to ticks, rounded up. Returns 0 if time, unit or the timer
// frequency is 0, or the result exceeds 32 bits.
[[nodiscard]] uint32_t ticks(const CO_NODE& node, uint32_t time, uint32_t unit);

// Starts a timer that is part of its owner; a running timer is restarted. start and cycle: ticks, as in COTmrCreate(),
// not both 0.
void start(CO_NODE& node, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para);

// Restarts a one-shot timer, from its own action: it elapses the given ticks after its last expiry or, if that time is
// over, at the next multiple of them.
void restart(CO_NODE& node, CO_TMR_MEM& timer, uint32_t ticks);

// Stops a timer that is part of its owner; no effect on a stopped timer.
void stop(CO_NODE& node, CO_TMR_MEM& timer);

// Returns the link to the first armed timer. Atomic: called without the timer lock, too.
[[nodiscard]] inline CO_TMR_MEM** first_armed(const CO_TMR& timers) {
  return __atomic_load_n(&timers.Armed, __ATOMIC_RELAXED);
}

// Returns whether timers have elapsed whose actions have not run yet.
[[nodiscard]] inline bool has_due(const CO_TMR& timers) { return first_armed(timers) != &timers.First; }

// Runs the actions of all elapsed timers: at least one has elapsed. Timers that elapse while actions run are left to
// the next call.
void run_due(CO_TMR& timers);

// Values of CO_TMR_MEM.Owner. Timers of the pool have ids, the others are members of their owner's structure.
enum class Owner : uint8_t { module, pool, real_time };

#if USE_REAL_TIME
// Calls before(), then runs the actions of all timers that have elapsed; where there is a real-time thread, only the
// actions of the mainline. before() and the search for timers hold the node lock together, and each action holds it
// anew. Returns false, without effect, if the node has neither a node lock nor a real-time thread.
[[nodiscard]] bool run_locked(CO_TMR& timers, void (*before)(CO_NODE& node));

// Marks a timer of SYNC or of a PDO: where there is a real-time thread, run_real_time() runs its action. To be called
// once for a timer that is part of its owner.
inline void assign_to_real_time(CO_TMR_MEM& timer) { timer.Owner = static_cast<uint8_t>(Owner::real_time); }
// Runs the actions of all elapsed timers that are marked.
void run_real_time(CO_TMR& timers);
#else
[[nodiscard]] inline bool run_locked(CO_TMR&, void (*)(CO_NODE& node)) { return false; }
inline void assign_to_real_time(CO_TMR_MEM&) {}
#endif

[[nodiscard]] inline bool is_running(const CO_TMR_MEM& timer) { return timer.Running != 0; }

// Returns the clock: ticks since any moment, modulo 2^32. With a classic driver the clock runs only while a timer is
// armed.
[[nodiscard]] uint32_t now(CO_NODE& node);

// Function that the application has not called for an eighth of a second although a timer has elapsed.
enum class Missing : uint8_t { nothing, service, process };
[[nodiscard]] Missing missing_call(CO_NODE& node);

// Converts ticks of the clock to milliseconds. rest: part of a millisecond that was left by the last call, in units of
// 1 ms / ticks per second; 0 at first. The timer frequency is not 0.
[[nodiscard]] uint32_t milliseconds(const CO_NODE& node, uint32_t ticks, uint32_t& rest);

// Returns the ticks until COTmrService() or COTmrProcess() has work; UINT32_MAX: no timer is armed.
[[nodiscard]] uint32_t next_deadline(CO_NODE& node);

}  // namespace co::tmr
