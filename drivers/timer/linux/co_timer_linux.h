// SPDX-License-Identifier: Apache-2.0
/// \file co_timer_linux.h
/// Timer driver for Linux (CLOCK_MONOTONIC), for C programs; C++ programs may use linux_timer.hpp instead.
///
///     CO_LINUX_TIMER *timer = COLinuxTimerNew();
///     ext.Timer = &COLinuxTimerDriver;  ext.TimerCtx = timer;       /* CO_NODE_EXT */
///     for (;;) {
///       CONodeProcess(&node);
///       COTmrService(&node.Tmr);
///       COTmrProcess(&node.Tmr);
///       struct pollfd wait = {COSocketCanFd(can), POLLIN, 0};
///       poll(&wait, 1, COLinuxTimerPollTimeout(timer, CONodeNextDeadline(&node)));
///     }
///
/// Units: ticks of CO_NODE_SPEC.TmrFreq. Context: one thread. Owner: the caller; it must outlive the node.
#ifndef CO_TIMER_LINUX_H_
#define CO_TIMER_LINUX_H_

#include "co_if_timer.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A timer; the members are private.
typedef struct CO_LINUX_TIMER_T CO_LINUX_TIMER;

/// Creates a timer; COLinuxTimerFree() releases it. Ends the program if there is no memory.
CO_LINUX_TIMER* COLinuxTimerNew(void);
/// Releases \a timer, which may be null. The node must not use it any more.
void COLinuxTimerFree(CO_LINUX_TIMER* timer);

/// Returns the time-out for poll() and epoll_wait() in ms, rounded up. \a ticks: time from now, as returned by
/// CONodeNextDeadline(); -1 (no time-out) for UINT32_MAX.
int COLinuxTimerPollTimeout(const CO_LINUX_TIMER* timer, uint32_t ticks);

/// Returns a timerfd that becomes readable at the node's next alarm and stays readable until the node sets another one;
/// -1 and errno if the kernel has none. The timer owns the descriptor.
int COLinuxTimerFd(CO_LINUX_TIMER* timer);

/// The driver; its context is a CO_LINUX_TIMER.
extern const CO_IF_TIMER_DRV_EX COLinuxTimerDriver;

#ifdef __cplusplus
}
#endif

#endif
