// SPDX-License-Identifier: Apache-2.0
#include "co_virtual_clock.h"

#include "virtual_clock.hpp"

namespace {

co::VirtualClock* of(CO_VIRTUAL_CLOCK* clock) { return reinterpret_cast<co::VirtualClock*>(clock); }
const co::VirtualClock* of(const CO_VIRTUAL_CLOCK* clock) { return reinterpret_cast<const co::VirtualClock*>(clock); }

}  // namespace

extern "C" {

CO_VIRTUAL_CLOCK* COVirtualClockNew(void) { return reinterpret_cast<CO_VIRTUAL_CLOCK*>(new co::VirtualClock); }

void COVirtualClockFree(CO_VIRTUAL_CLOCK* clock) { delete of(clock); }

void COVirtualClockAdvance(CO_VIRTUAL_CLOCK* clock, uint32_t ticks) { of(clock)->advance(ticks); }

bool COVirtualClockAdvanceToAlarm(CO_VIRTUAL_CLOCK* clock) { return of(clock)->advance_to_alarm(); }

uint32_t COVirtualClockNow(const CO_VIRTUAL_CLOCK* clock) { return of(clock)->now(); }

CO_VIRTUAL_TIMER* COVirtualTimerNew(CO_VIRTUAL_CLOCK* clock) {
  return reinterpret_cast<CO_VIRTUAL_TIMER*>(new co::VirtualTimer(*of(clock)));
}

void COVirtualTimerFree(CO_VIRTUAL_TIMER* timer) { delete reinterpret_cast<co::VirtualTimer*>(timer); }

}  // extern "C"
