// SPDX-License-Identifier: Apache-2.0
#include "co_timer_linux.h"

#include "linux_timer.hpp"

namespace {

co::LinuxTimer* of(CO_LINUX_TIMER* timer) { return reinterpret_cast<co::LinuxTimer*>(timer); }
const co::LinuxTimer* of(const CO_LINUX_TIMER* timer) { return reinterpret_cast<const co::LinuxTimer*>(timer); }

}  // namespace

extern "C" {

CO_LINUX_TIMER* COLinuxTimerNew(void) { return reinterpret_cast<CO_LINUX_TIMER*>(new co::LinuxTimer); }

void COLinuxTimerFree(CO_LINUX_TIMER* timer) { delete of(timer); }

int COLinuxTimerPollTimeout(const CO_LINUX_TIMER* timer, uint32_t ticks) { return of(timer)->poll_timeout(ticks); }

int COLinuxTimerFd(CO_LINUX_TIMER* timer) { return of(timer)->fd(); }

}  // extern "C"
