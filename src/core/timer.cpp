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
  explicit Lock(const CO_TMR& timers) : node_(*timers.Node) { port::lock(node_); }
  ~Lock() { port::unlock(node_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  CO_NODE& node_;
};

void append_due(CO_TMR& t, CO_TMR_MEM& timer) {
  timer.State = due;
  timer.Next = nullptr;
  if (t.Due == nullptr) {
    __atomic_store_n(&t.Due, &timer, __ATOMIC_RELAXED);
  } else {
    t.DueEnd->Next = &timer;
  }
  t.DueEnd = &timer;
}

// Lets the time of the list go on by some ticks; what has elapsed becomes due.
void advance(CO_TMR& t, uint32_t elapsed) {
  t.Clock += elapsed;
  while (t.Use != nullptr && t.Use->Delta <= elapsed) {
    CO_TMR_MEM& timer = *t.Use;
    t.Use = timer.Next;
    elapsed -= timer.Delta;
    timer.Delta = t.Clock - elapsed;
    append_due(t, timer);
  }
  if (t.Use != nullptr) {
    t.Use->Delta -= elapsed;
  }
}

uint32_t first_cycle(const CO_TMR_MEM* list) {
  while (list != nullptr && list->Cycle == 0) {
    list = list->Next;
  }
  return list == nullptr ? 0 : list->Cycle;
}

// What to wait for when nothing is armed: while elapsed cyclic timers are still to be run, a driver without a clock
// has to go on counting, so that they can keep their phase.
uint32_t idle_time(const CO_TMR& t) {
  if (port::has_clock(*t.Node)) {
    return 0;
  }
  const uint32_t cycle = first_cycle(t.Due);
  return cycle != 0 ? cycle : first_cycle(t.Run);
}

void program(CO_TMR& t) {
  const uint32_t before = t.Programmed;
  t.Programmed = t.Use != nullptr ? t.Use->Delta : idle_time(t);
  port::alarm(*t.Node, t.Programmed, before == 0);
}

// Brings Clock and the first delta up to now. Returns the ticks by which now is later than that: 1 while a driver
// without a clock has elapsed and COTmrService() has not come yet.
uint32_t synchronise(CO_TMR& t) {
  if (port::has_clock(*t.Node)) {
    advance(t, port::now(*t.Node) - t.Clock);
    return 0;
  }
  if (t.Programmed == 0) {
    return 0;
  }
  const uint32_t left = port::ticks_left(*t.Node);
  const uint32_t rest = left == 0 ? 1 : (left < t.Programmed ? left : t.Programmed);
  advance(t, t.Programmed - rest);
  t.Programmed = rest;
  return left == 0 ? 1 : 0;
}

// Behind all timers that elapse before or with it. A driver that has elapsed is programmed by COTmrService().
void insert(CO_TMR& t, CO_TMR_MEM& timer, uint32_t ticks, uint32_t late_by) {
  ticks = ticks == UINT32_MAX ? ticks : ticks + late_by;
  CO_TMR_MEM** place = &t.Use;
  while (*place != nullptr && (*place)->Delta <= ticks) {
    ticks -= (*place)->Delta;
    place = &(*place)->Next;
  }
  timer.State = armed;
  timer.Delta = ticks;
  timer.Next = *place;
  *place = &timer;
  if (timer.Next != nullptr) {
    timer.Next->Delta -= ticks;
  }
  if (place == &t.Use && late_by == 0) {
    program(t);
  }
}

bool unlink(CO_TMR_MEM** list, const CO_TMR_MEM& timer) {
  for (CO_TMR_MEM** place = list; *place != nullptr; place = &(*place)->Next) {
    if (*place == &timer) {
      *place = timer.Next;
      return true;
    }
  }
  return false;
}

void disarm(CO_TMR& t, CO_TMR_MEM& timer) {
  const bool first = t.Use == &timer;
  if (timer.Next != nullptr) {
    timer.Next->Delta += timer.Delta;
  }
  unlink(&t.Use, timer);
  if (first && synchronise(t) == 0) {
    program(t);
  }
}

void forget_due(CO_TMR& t, const CO_TMR_MEM& timer) {
  if (unlink(&t.Run, timer) || !unlink(&t.Due, timer) || t.DueEnd != &timer) {
    return;
  }
  t.DueEnd = t.Due;
  while (t.DueEnd != nullptr && t.DueEnd->Next != nullptr) {
    t.DueEnd = t.DueEnd->Next;
  }
}

void remove(CO_TMR& t, CO_TMR_MEM& timer) {
  if (timer.State == armed) {
    disarm(t, timer);
  } else if (timer.State == due) {
    forget_due(t, timer);
  }
  timer.State = idle;
}

void release(CO_TMR& t, CO_TMR_MEM& timer) {
  timer.State = idle;
  if (timer.Pooled != 0) {
    ++timer.Generation;
    timer.Next = t.Free;
    t.Free = &timer;
  }
}

// A timer that has elapsed is armed for its next expiry after now; those that were missed are skipped.
void rearm(CO_TMR& t, CO_TMR_MEM& timer, uint32_t cycle) {
  const uint32_t late_by = synchronise(t);
  const uint32_t passed = t.Clock + late_by - timer.Delta;
  const uint32_t since = passed < cycle ? passed : passed % cycle;
  insert(t, timer, cycle - since, late_by);
}

void arm(CO_TMR& t, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para) {
  timer.Func = func;
  timer.Para = para;
  timer.Cycle = cycle;
  const uint32_t late_by = synchronise(t);
  insert(t, timer, start == 0 ? cycle : start, late_by);
}

// The action of the timer that has elapsed first; false if none is left.
bool run_next(CO_TMR& t) {
  CO_TMR_FUNC func = nullptr;
  void* para = nullptr;
  {
    const Lock lock(t);
    if (t.Run == nullptr) {
      return false;
    }
    CO_TMR_MEM& timer = *t.Run;
    t.Run = timer.Next;
    func = timer.Func;
    para = timer.Para;
    if (timer.Cycle != 0) {
      rearm(t, timer, timer.Cycle);
    } else {
      release(t, timer);
    }
  }
  func(para);
  return true;
}

// An id holds the number of the timer in the pool in its low bits and the generation above.
int16_t id_of(const CO_TMR& t, const CO_TMR_MEM& timer) {
  const uint32_t number = static_cast<uint32_t>(&timer - t.Pool);
  return static_cast<int16_t>(((static_cast<uint32_t>(timer.Generation) << t.IdBits) | number) & INT16_MAX);
}

CO_TMR_MEM* find(const CO_TMR& t, int16_t id) {
  if (id < 0) {
    return nullptr;
  }
  const uint32_t number = static_cast<uint32_t>(id) & ((1U << t.IdBits) - 1U);
  if (number >= t.Max) {
    return nullptr;
  }
  CO_TMR_MEM& timer = t.Pool[number];
  return timer.State != idle && id_of(t, timer) == id ? &timer : nullptr;
}

CO_TMR_MEM* take(CO_TMR& t) {
  CO_TMR_MEM* const timer = t.Free;
  if (timer != nullptr) {
    t.Free = timer->Next;
  }
  return timer;
}

uint8_t bits_for(uint16_t num) {
  uint8_t bits = 0;
  while ((1U << bits) < num) {
    ++bits;
  }
  return bits;
}

}  // namespace

uint32_t ticks(const CO_TMR& timers, uint32_t time, uint32_t unit) {
  if (unit == 0) {
    return 0;
  }
  const uint64_t exact = static_cast<uint64_t>(time) * timers.Freq;
  const uint64_t rounded_up = (exact + unit - 1) / unit;
  return rounded_up > UINT32_MAX ? 0 : static_cast<uint32_t>(rounded_up);
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
  const uint32_t late_by = synchronise(timers);
  return timers.Clock + late_by;
}

uint32_t next_deadline(CO_TMR& timers) {
  const Lock lock(timers);
  const uint32_t late_by = synchronise(timers);
  if (late_by != 0 || timers.Due != nullptr || timers.Run != nullptr) {
    return 0;
  }
  return timers.Use == nullptr ? UINT32_MAX : timers.Use->Delta;
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
  tmr->IdBits = tmr::bits_for(tmr->Max);
  for (uint16_t n = tmr->Max; n > 0; --n) {
    CO_TMR_MEM& timer = mem[n - 1];
    timer = {};
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
  CO_TMR_MEM* const timer = tmr::take(*tmr);
  if (timer == nullptr) {
    count(tmr->Node->Count.TimerExhausted);
    tmr->Node->Error = CO_ERR_TMR_NO_ACT;
    return -1;
  }
  tmr::arm(*tmr, *timer, startTicks, cycleTicks, func, para);
  return tmr::id_of(*tmr, *timer);
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
  uint32_t elapsed = tmr->Programmed;
  if (port::has_clock(*tmr->Node)) {
    elapsed = port::now(*tmr->Node) - tmr->Clock;
  } else if (!port::has_elapsed(*tmr->Node)) {
    return 0;
  }
  tmr::advance(*tmr, elapsed);
  tmr::program(*tmr);
  return tmr->Due != nullptr ? 1 : 0;
}

void COTmrProcess(CO_TMR* tmr) {
  ASSERT_PTR_FATAL(tmr);
  ASSERT_PTR_FATAL(tmr->Node);
  if (__atomic_load_n(&tmr->Due, __ATOMIC_RELAXED) == nullptr && tmr->Run == nullptr) {
    return;
  }
  {
    const tmr::Lock lock(*tmr);
    if (tmr->Run == nullptr) {
      tmr->Run = tmr->Due;
      __atomic_store_n(&tmr->Due, nullptr, __ATOMIC_RELAXED);
    }
  }
  while (tmr::run_next(*tmr)) {
  }
}

}  // extern "C"
