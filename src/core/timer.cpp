// SPDX-License-Identifier: Apache-2.0
#include "core/timer.hpp"

#include "core/count.hpp"
#include "core/port.hpp"

namespace co::tmr {
namespace {

enum State : uint8_t { idle = 0, armed, due };

// Keeps the timer interrupt away while it lives.
class Lock {
 public:
  explicit Lock(const CO_TMR& timers) : timers_(timers) { port::lock(*timers.Node); }
  [[gnu::always_inline]] ~Lock() { port::unlock(*timers_.Node); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  const CO_TMR& timers_;
};

// Returns the one before it.
CO_TMR_MEM* unlink(CO_TMR_LIST& list, const CO_TMR_MEM& timer) {
  CO_TMR_MEM* before = nullptr;
  for (CO_TMR_MEM* each = list.First; each != &timer; each = each->Next) {
    before = each;
  }
  (before == nullptr ? list.First : before->Next) = timer.Next;
  list.Last = list.Last == &timer ? before : list.Last;
  return before;
}

// COTmrProcess() looks at the elapsed ones without the lock.
void append_due(CO_TMR& t, CO_TMR_MEM& timer) {
  timer.State = due;
  timer.Next = nullptr;
  __atomic_store_n(t.Due.First == nullptr ? &t.Due.First : &t.Due.Last->Next, &timer, __ATOMIC_RELAXED);
  t.Due.Last = &timer;
}

// Lets the time go on; what has elapsed becomes due.
void advance(CO_TMR& t, uint32_t now) {
  const uint32_t passed = now - t.Clock;
  t.Clock = now;
  while (t.Use.First != nullptr && now - t.Use.First->At <= passed) {
    CO_TMR_MEM& timer = *t.Use.First;
    t.Use.First = timer.Next;
    append_due(t, timer);
  }
}

uint32_t first_cycle(const CO_TMR_MEM* list) {
  while (list != nullptr && list->Cycle == 0) {
    list = list->Next;
  }
  return list == nullptr ? 0 : list->Cycle;
}

// While nothing is armed, but elapsed cyclic timers are still to be run, a driver without a clock has to go on
// counting, so that they can keep their phase.
void program(CO_TMR& t, uint32_t now) {
  const uint32_t next = t.Use.First != nullptr ? t.Use.First->At - now : 0;
  if (port::has_clock(*t.Node)) {
    port::set_alarm(*t.Node, next);
    return;
  }
  const uint32_t wait = next != 0 ? next : first_cycle(t.Due.First);
  port::count_down(*t.Node, wait, t.Programmed == 0);
  t.Clock = now + wait;
  t.Programmed = wait;
}

// Has a driver without a clock elapsed, and COTmrService() not come yet, which will program it?
bool is_pending(const CO_TMR& t, uint32_t now) { return t.Programmed != 0 && now == t.Clock; }

void reprogram(CO_TMR& t, uint32_t now) {
  if (!is_pending(t, now)) {
    program(t, now);
  }
}

// Now. What has elapsed by a clock becomes due.
uint32_t synchronise(CO_TMR& t) {
  if (port::has_clock(*t.Node)) {
    advance(t, port::now(*t.Node));
    return t.Clock;
  }
  if (t.Programmed == 0) {
    return t.Clock;
  }
  const uint32_t left = port::ticks_left(*t.Node);
  return t.Clock - (left < t.Programmed ? left : t.Programmed);
}

// Behind all timers that elapse before or with it; mostly that is the end. A driver that waits for the right time
// already is left alone.
void insert(CO_TMR& t, CO_TMR_MEM& timer, uint32_t now, uint32_t ticks) {
  CO_TMR_MEM** place = &t.Use.First;
  if (t.Use.First != nullptr && t.Use.Last->At - now <= ticks) {
    place = &t.Use.Last->Next;
  } else if (t.Use.First != nullptr) {
    while ((*place)->At - now <= ticks) {
      place = &(*place)->Next;
    }
  }
  timer.State = armed;
  timer.At = now + ticks;
  timer.Next = *place;
  *place = &timer;
  t.Use.Last = timer.Next == nullptr ? &timer : t.Use.Last;
  if (place == &t.Use.First && timer.At != t.Clock) {
    reprogram(t, now);
  }
}

void remove(CO_TMR& t, CO_TMR_MEM& timer) {
  const uint8_t state = timer.State;
  if (state == idle) {
    return;
  }
  timer.State = idle;
  CO_TMR_MEM* const before = unlink(state == armed ? t.Use : t.Due, timer);
  if (state == due) {
    t.RunEnd = t.RunEnd == &timer ? before : t.RunEnd;
  } else if (before == nullptr) {
    reprogram(t, synchronise(t));
  }
}

// Back to the pool; its id is used up.
void release(CO_TMR& t, CO_TMR_MEM& timer) {
  timer.Id = (timer.Id + t.IdStep) & INT16_MAX;
  timer.Next = t.Free;
  t.Free = &timer;
}

// A timer that has elapsed is armed for its next expiry after now; those that were missed are skipped.
void rearm(CO_TMR& t, CO_TMR_MEM& timer, uint32_t cycle) {
  const uint32_t now = synchronise(t);
  const uint32_t passed = now - timer.At;
  insert(t, timer, now, cycle - (passed < cycle ? passed : passed % cycle));
}

void arm(CO_TMR& t, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para) {
  timer.Func = func;
  timer.Para = para;
  timer.Cycle = cycle;
  insert(t, timer, synchronise(t), start == 0 ? cycle : start);
}

// The timer that has elapsed first, armed again or released, its action still to be run.
const CO_TMR_MEM& take_due(CO_TMR& t) {
  const Lock lock(t);
  CO_TMR_MEM& timer = *t.Due.First;
  CO_TMR_MEM* const end = t.RunEnd == nullptr ? t.Due.Last : t.RunEnd;
  t.RunEnd = end == &timer ? nullptr : end;
  t.Due.First = timer.Next;
  if (timer.Cycle != 0) {
    rearm(t, timer, timer.Cycle);
    return timer;
  }
  timer.State = idle;
  if (timer.Pooled != 0) {
    release(t, timer);
  }
  return timer;
}

CO_TMR_MEM* find(const CO_TMR& t, int16_t id) {
  const uint32_t number = static_cast<uint32_t>(id) & (t.IdStep - 1U);
  if (number >= t.Max) {
    return nullptr;
  }
  CO_TMR_MEM& timer = t.Pool[number];
  return timer.State != idle && timer.Id == id ? &timer : nullptr;
}

CO_TMR_MEM* take_free(CO_TMR& t) {
  CO_TMR_MEM* const timer = t.Free;
  if (timer != nullptr) {
    t.Free = timer->Next;
  }
  return timer;
}

uint16_t power_of_two(uint16_t num) {
  unsigned power = 1;
  while (power < num) {
    power *= 2;
  }
  return static_cast<uint16_t>(power);
}

}  // namespace

// time * Freq / unit, rounded up, binary digit by digit: a division of 64 bits would bring half a kilobyte of library.
uint32_t ticks(const CO_TMR& timers, uint32_t time, uint32_t unit) {
  if (unit == 0) {
    return 0;
  }
  uint64_t whole = 0;
  uint64_t rest = 0;
  for (uint32_t bit = 1U << 31; bit != 0; bit >>= 1) {
    whole *= 2;
    rest *= 2;
    if ((time & bit) != 0) {
      whole += timers.Freq / unit;
      rest += timers.Freq % unit;
    }
    for (; rest >= unit; rest -= unit) {
      ++whole;
    }
  }
  whole += rest != 0 ? 1 : 0;
  return whole > UINT32_MAX ? 0 : static_cast<uint32_t>(whole);
}

void start(CO_TMR& timers, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para) {
  const Lock lock(timers);
  remove(timers, timer);
  arm(timers, timer, start, cycle, func, para);
}

void again(CO_TMR& timers, CO_TMR_MEM& timer, uint32_t ticks) {
  const Lock lock(timers);
  remove(timers, timer);
  rearm(timers, timer, ticks);
}

void stop(CO_TMR& timers, CO_TMR_MEM& timer) {
  const Lock lock(timers);
  remove(timers, timer);
}

bool is_running(const CO_TMR_MEM& timer) { return timer.State != idle; }

uint32_t now(CO_TMR& timers) {
  if (port::has_clock(*timers.Node)) {
    return port::now(*timers.Node);
  }
  const Lock lock(timers);
  return synchronise(timers);
}

uint32_t next_deadline(CO_TMR& timers) {
  const Lock lock(timers);
  const uint32_t now = synchronise(timers);
  if (timers.Due.First != nullptr || is_pending(timers, now)) {
    return 0;
  }
  return timers.Use.First == nullptr ? UINT32_MAX : timers.Use.First->At - now;
}

}  // namespace co::tmr

using namespace co;

extern "C" {

void COTmrInit(CO_TMR* tmr, CO_NODE* node, CO_TMR_MEM* mem, uint16_t num, uint32_t freq) {
  ASSERT_PTR_FATAL(tmr);
  ASSERT_PTR_FATAL(node);
  *tmr = {};
  tmr->Node = node;
  tmr->Pool = mem;
  tmr->Freq = freq;
  tmr->Max = static_cast<uint16_t>(mem == nullptr ? 0 : (num > INT16_MAX ? INT16_MAX : num));
  tmr->IdStep = tmr::power_of_two(tmr->Max);
  for (uint16_t n = tmr->Max; n > 0; --n) {
    CO_TMR_MEM& timer = mem[n - 1];
    timer = {};
    timer.Id = static_cast<uint16_t>(n - 1U);
    timer.Pooled = 1;
    timer.Next = tmr->Free;
    tmr->Free = &timer;
  }
  tmr->Clock = port::has_clock(*node) ? port::now(*node) : 0;
}

uint32_t COTmrGetTicks(CO_TMR* tmr, uint16_t time, uint32_t unit) {
  ASSERT_PTR_ERR(tmr, 0);
  return tmr::ticks(*tmr, time, unit);
}

uint16_t COTmrGetMinTime(CO_TMR* tmr, uint32_t unit) {
  ASSERT_PTR_ERR(tmr, 0);
  if (tmr->Freq == 0) {
    return 0;
  }
  const uint32_t time = unit / tmr->Freq + (unit % tmr->Freq != 0 ? 1 : 0);
  return static_cast<uint16_t>(time > UINT16_MAX ? 0 : time);
}

int16_t COTmrCreate(CO_TMR* tmr, uint32_t startTicks, uint32_t cycleTicks, CO_TMR_FUNC func, void* para) {
  ASSERT_PTR_FATAL_ERR(tmr, -1);
  ASSERT_PTR_FATAL_ERR(tmr->Node, -1);
  if (func == nullptr) {
    tmr->Node->Error = CO_ERR_BAD_ARG;
    return -1;
  }
  if (startTicks == 0 && cycleTicks == 0) {
    return -1;
  }
  const tmr::Lock lock(*tmr);
  CO_TMR_MEM* const timer = tmr::take_free(*tmr);
  if (timer == nullptr) {
    count(tmr->Node->Count.TimerExhausted);
    tmr->Node->Error = CO_ERR_TMR_NO_ACT;
    return -1;
  }
  tmr::arm(*tmr, *timer, startTicks, cycleTicks, func, para);
  return static_cast<int16_t>(timer->Id);
}

int16_t COTmrDelete(CO_TMR* tmr, int16_t actId) {
  ASSERT_PTR_FATAL_ERR(tmr, -1);
  ASSERT_PTR_FATAL_ERR(tmr->Node, -1);
  const tmr::Lock lock(*tmr);
  CO_TMR_MEM* const timer = tmr::find(*tmr, actId);
  if (timer == nullptr) {
    return -1;
  }
  tmr::remove(*tmr, *timer);
  tmr::release(*tmr, *timer);
  return 0;
}

int16_t COTmrService(CO_TMR* tmr) {
  ASSERT_PTR_ERR(tmr, -1);
  ASSERT_PTR_ERR(tmr->Node, -1);
  uint32_t now = tmr->Clock;
  if (port::has_clock(*tmr->Node)) {
    now = port::now(*tmr->Node);
  } else if (!port::has_elapsed(*tmr->Node)) {
    return 0;
  }
  tmr::advance(*tmr, now);
  tmr::program(*tmr, now);
  return tmr->Due.First != nullptr ? 1 : 0;
}

void COTmrProcess(CO_TMR* tmr) {
  ASSERT_PTR_FATAL(tmr);
  ASSERT_PTR_FATAL(tmr->Node);
  if (__atomic_load_n(&tmr->Due.First, __ATOMIC_RELAXED) == nullptr) {
    return;
  }
  do {
    const CO_TMR_MEM& timer = tmr::take_due(*tmr);
    timer.Func(timer.Para);
  } while (tmr->RunEnd != nullptr);
}

}  // extern "C"
