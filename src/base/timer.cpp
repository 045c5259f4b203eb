// SPDX-License-Identifier: Apache-2.0
#include "base/timer.hpp"

#include <stddef.h>

#include "base/error.hpp"
#include "base/events.hpp"
#include "co_assert.h"
#include "hal/port.hpp"

namespace co::tmr {
namespace {

// Scope in which the timer interrupt is locked out.
class Lock {
 public:
  explicit Lock(const CO_TMR& timers) : node_(*timers.Node) { port::lock(node_); }
  [[gnu::always_inline]] ~Lock() { port::unlock(node_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  CO_NODE& node_;
};

// Returns the timer that contains the link.
CO_TMR_MEM& owner_of(CO_TMR_MEM** link) { return *reinterpret_cast<CO_TMR_MEM*>(link); }
static_assert(offsetof(CO_TMR_MEM, Next) == 0);

// Returns whether frames or segments are queued that COTmrProcess() can send. Called in the timer interrupt, without
// the lock.
bool has_to_send(const CO_NODE& node) {
  return (__atomic_load_n(&node.TxQueue.Num, __ATOMIC_RELAXED) |
          __atomic_load_n(&node.Transmit.Paused, __ATOMIC_RELAXED)) != 0;
}

// Sets the clock to now; timers that have elapsed by then become due.
void advance(CO_TMR& t, uint32_t now) {
  const uint32_t passed = now - t.Clock;
  t.Clock = now;
  CO_TMR_MEM** armed = t.Armed;
  while (*armed != nullptr && now - (*armed)->At <= passed) {
    armed = &(*armed)->Next;
  }
  __atomic_store_n(&t.Armed, armed, __ATOMIC_RELAXED);
}

// Reads the clock; timers that have elapsed become due. Returns the clock.
uint32_t synchronise(CO_TMR& t) {
  const uint32_t now = port::now(*t.Node);
  advance(t, now);
  return now;
}

// Programs the driver for the first armed timer. now: the present clock
void program(const CO_TMR& t, uint32_t now) {
  const CO_TMR_MEM* const first = *t.Armed;
  port::set_alarm(*t.Node, first != nullptr ? first->At - now : 0);
}

bool is_of(const CO_TMR_MEM& timer, Owner owner) { return timer.Owner == static_cast<uint8_t>(owner); }

// Makes timers due that have elapsed, and programs the driver. Loops that poll a driver call it many times in each
// tick, without an effect. A driver with alarms may have called it before its alarm, and needs a new one.
void process_clock(CO_TMR& t) {
  if (USE_FAST_PATHS == 0) {
    program(t, synchronise(t));
    return;
  }
  const uint32_t now = port::now(*t.Node);
  if (now != t.Clock || port::has_alarm(*t.Node)) {
    advance(t, now);
    program(t, now);
  }
}

// Returns whether the invariants of the armed timers hold. from: clock that no armed timer precedes. For assertions.
[[maybe_unused]] bool is_consistent(const CO_TMR& t, uint32_t from) {
  uint32_t ticks = 0;
  CO_TMR_MEM* const* link = t.Armed;
  for (; *link != nullptr; link = &(*link)->Next) {
    if ((*link)->At - from < ticks) {
      return false;
    }
    ticks = (*link)->At - from;
  }
  return link == t.Armed || link == t.End;
}

// Links a timer that elapses some ticks after a clock value behind all timers that elapse before it or at the same
// tick: usually at the end, which is compared first. Returns whether it is the first armed timer. from: the present
// clock, which no armed timer precedes.
bool link_by_expiry(CO_TMR& t, CO_TMR_MEM& timer, uint32_t from, uint32_t ticks) {
  CO_TMR_MEM** link = t.Armed;
  CO_TMR_MEM* next = *link;
  if (next != nullptr && owner_of(t.End).At - from <= ticks) {
    link = t.End;
    next = nullptr;
  } else if (next != nullptr) {
    while (next->At - from <= ticks) {
      link = &next->Next;
      next = *link;
    }
  }
  if (next == nullptr) {
    t.End = &timer.Next;
  }
  timer.Next = next;
  timer.At = from + ticks;
  *link = &timer;
  CO_ASSERT(is_consistent(t, from));
  return link == t.Armed;
}

// Arms a timer. The driver is programmed only if its next expiry changes.
void insert(CO_TMR& t, CO_TMR_MEM& timer, uint32_t now, uint32_t ticks) {
  timer.Running = 1;
  if (link_by_expiry(t, timer, now, ticks)) {
    program(t, now);
  }
}

void remove(CO_TMR& t, CO_TMR_MEM& timer) {
  if (timer.Running == 0) {
    return;
  }
  timer.Running = 0;
  CO_TMR_MEM** link = &t.First;
  while (*link != &timer) {
    link = &(*link)->Next;
  }
  *link = timer.Next;
  if (t.End == &timer.Next) {
    t.End = link;
  }
  if (t.Armed == link) {
    program(t, synchronise(t));
  } else if (t.Armed == &timer.Next) {
    t.Armed = link;
  }
}

// Returns a timer to the pool and advances its id to the next generation, so that the old id is invalid.
void release(CO_TMR& t, CO_TMR_MEM& timer) {
  timer.Id = (timer.Id + t.IdStep) & INT16_MAX;
  timer.Next = t.Free;
  t.Free = &timer;
}

// Divides bit by bit: returns the quotient in the low word and the remainder in the high word. The quotient must fit
// into 32 bits. The library's 64-bit division would add 270 bytes.
uint64_t divide(uint64_t dividend, uint32_t divisor) {
  auto remainder = static_cast<uint32_t>(dividend >> 32);
  auto low = static_cast<uint32_t>(dividend);
  for (unsigned bit = 32; bit != 0; --bit) {
    const bool carry = remainder > INT32_MAX;
    remainder = (remainder << 1) | (low >> 31);
    low <<= 1;
    if (carry || remainder >= divisor) {
      remainder -= divisor;
      ++low;
    }
  }
  return (uint64_t{remainder} << 32) | low;
}

uint32_t modulo(uint32_t ticks, uint32_t cycle) {
  return ticks < cycle ? ticks : static_cast<uint32_t>(divide(ticks, cycle) >> 32);
}

// Arms an elapsed timer for its next expiry after now; expiries that were missed are skipped.
void rearm(CO_TMR& t, CO_TMR_MEM& timer, uint32_t cycle) {
  const uint32_t now = synchronise(t);
  insert(t, timer, now, cycle - modulo(now - timer.At, cycle));
}

void arm(CO_TMR& t, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para) {
  timer.Func = func;
  timer.Para = para;
  timer.Cycle = cycle;
  insert(t, timer, synchronise(t), start == 0 ? cycle : start);
}

// Removes the elapsed timer at a link from the list; arms it again if it is cyclic, or releases it if it belongs to the
// pool. The caller then runs its action.
const CO_TMR_MEM& remove_elapsed(CO_TMR& t, CO_TMR_MEM*& link) {
  CO_TMR_MEM& timer = *link;
  link = timer.Next;
  if (t.Armed == &timer.Next) {
    t.Armed = &link;
  }
  if (timer.Cycle != 0) {
    rearm(t, timer, timer.Cycle);
    return timer;
  }
  timer.Running = 0;
  if (is_of(timer, Owner::pool)) {
    release(t, timer);
  }
  return timer;
}

// Calls remove_elapsed() for the timer that has elapsed first.
const CO_TMR_MEM& remove_first(CO_TMR& t) {
  const Lock lock(t);
  return remove_elapsed(t, t.First);
}

// Runs the action of an elapsed timer, and the work that it has deferred. The node works during the actions of the
// stack's timers, not during those of the application. kept: bit working if the caller keeps the node working
[[gnu::always_inline]] inline void run(CO_NODE& node, const CO_TMR_MEM& timer, unsigned kept) {
  if (!is_of(timer, Owner::pool)) {
    node.State |= event::working;
  }
  timer.Func(timer.Para);
  node.State = static_cast<uint8_t>((node.State & ~unsigned{event::working}) | kept);
  event::run_deferred(node);
}

#if USE_REAL_TIME

// Timers to be run: with a real-time thread, some belong to that thread, the others to the mainline.
enum class Share : uint8_t { all, mainline, real_time };

bool is_of(const CO_TMR_MEM& timer, Share share) {
  return share == Share::all || is_of(timer, Owner::real_time) == (share == Share::real_time);
}

Share share_of_mainline(const CO_TMR& t) { return t.Node->Ext->Mainline != nullptr ? Share::mainline : Share::all; }

// Returns the link to the first elapsed timer of a share, or to the first armed timer if there is none.
CO_TMR_MEM** first_due(CO_TMR& t, Share share) {
  CO_TMR_MEM** link = &t.First;
  while (link != t.Armed && !is_of(**link, share)) {
    link = &(*link)->Next;
  }
  return link;
}

// Expiries that a call runs: from the first elapsed timer of its share to the last elapsed timer of all. Timers that
// elapse meanwhile are behind them in the list and are left to the next call.
struct Span {
  uint32_t first;
  uint32_t ticks;
};

// Sets the span of the elapsed timers of a share. Returns false if none has elapsed.
bool find_span(CO_TMR& t, Share share, Span& span) {
  const Lock lock(t);
  CO_TMR_MEM** const link = first_due(t, share);
  if (link == t.Armed) {
    return false;
  }
  span.first = (*link)->At;
  span.ticks = owner_of(t.Armed).At - span.first;
  return true;
}

// Runs the first timer of a span. Returns false if none is left.
bool run_one(CO_TMR& t, Share share, const Span& span) {
  const CO_TMR_MEM* timer = nullptr;
  {
    const Lock lock(t);
    CO_TMR_MEM** const link = first_due(t, share);
    if (link == t.Armed || (*link)->At - span.first > span.ticks) {
      return false;
    }
    timer = &remove_elapsed(t, *link);
  }
  run(*t.Node, *timer, share == Share::real_time ? unsigned{event::working} : 0U);
  return true;
}

// Returns whether the node has a lock or a real-time thread.
bool has_node_lock(const CO_TMR& t) {
  const CO_NODE_EXT* const ext = t.Node == nullptr ? nullptr : t.Node->Ext;
  return ext != nullptr && (ext->Enter != nullptr || ext->Mainline != nullptr);
}

// Runs each action with the node lock taken anew, so that other threads wait for one action at most.
void run_with_node_lock(CO_TMR& t, void (*before)(CO_NODE& node)) {
  const Share share = share_of_mainline(t);
  Span span = {};
  bool more = false;
  {
    const port::NodeLock lock(*t.Node);
    before(*t.Node);
    more = find_span(t, share, span);
  }
  while (more) {
    const port::NodeLock lock(*t.Node);
    more = run_one(t, share, span);
  }
}

// Returns whether COTmrProcess() has actions to run.
bool has_work(CO_TMR& t) { return has_node_lock(t) ? first_due(t, share_of_mainline(t)) != t.Armed : has_due(t); }

}  // namespace

bool run_locked(CO_TMR& timers, void (*before)(CO_NODE& node)) {
  const bool is_locked = has_node_lock(timers);
  if (is_locked) {
    run_with_node_lock(timers, before);
  }
  return is_locked;
}

void run_real_time(CO_TMR& timers) {
  Span span = {};
  for (bool more = find_span(timers, Share::real_time, span); more;) {
    more = run_one(timers, Share::real_time, span);
    event::send_deferred(*timers.Node);
  }
}

namespace {

#else

bool has_work(const CO_TMR& t) { return has_due(t); }

#endif

CO_TMR_MEM* find(const CO_TMR& t, int16_t id) {
  const uint32_t number = static_cast<uint32_t>(id) & (t.IdStep - 1U);
  if (number >= t.Used) {
    return nullptr;
  }
  CO_TMR_MEM& timer = t.Pool[number];
  return timer.Running != 0 && timer.Id == id ? &timer : nullptr;
}

uint16_t power_of_two(unsigned num) {
  unsigned power = 1;
  while (power < num) {
    power *= 2;
  }
  return static_cast<uint16_t>(power);
}

// Returns a timer of the pool that is not in use, or null. Timers that were never used are initialised now, so that
// programs without timers of their own do not contain it.
CO_TMR_MEM* take_free(CO_TMR& t) {
  CO_TMR_MEM* timer = t.Free;
  if (timer != nullptr) {
    t.Free = timer->Next;
  } else if (t.Used < t.Max) {
    timer = &t.Pool[t.Used];
    *timer = {};
    timer->Id = t.Used;
    timer->Owner = static_cast<uint8_t>(Owner::pool);
    ++t.Used;
  }
  return timer;
}

// Multiplies bit by bit: on the smallest CPUs a 64-bit product would need a library function.
[[gnu::noinline]] uint32_t ticks_at(uint32_t frequency, uint32_t time, uint32_t unit) {
  uint64_t product = unit - 1U;
  for (uint64_t part = frequency; time != 0; time >>= 1, part *= 2) {
    if ((time & 1U) != 0) {
      product += part;
    }
  }
  return product >> 32 >= unit ? 0 : static_cast<uint32_t>(divide(product, unit));
}

}  // namespace

uint32_t ticks(const CO_NODE& node, uint32_t time, uint32_t unit) { return ticks_at(node.Tmr.Freq, time, unit); }

// Divides whole seconds first, so that each quotient fits into 32 bits, and multiplies the rest by 1000.
uint32_t milliseconds(const CO_NODE& node, uint32_t ticks, uint32_t& rest) {
  const CO_TMR& timers = node.Tmr;
  CO_ASSERT(timers.Freq != 0 && rest < timers.Freq);
  const uint64_t seconds = divide(ticks, timers.Freq);
  const uint64_t part = seconds >> 32;
  const uint64_t split = divide((part << 10) - (part << 4) - (part << 3) + rest, timers.Freq);
  rest = static_cast<uint32_t>(split >> 32);
  return static_cast<uint32_t>(seconds) * 1000U + static_cast<uint32_t>(split);
}

void start(CO_NODE& node, CO_TMR_MEM& timer, uint32_t start, uint32_t cycle, CO_TMR_FUNC func, void* para) {
  CO_TMR& timers = node.Tmr;
  const Lock lock(timers);
  remove(timers, timer);
  arm(timers, timer, start, cycle, func, para);
}

void restart(CO_NODE& node, CO_TMR_MEM& timer, uint32_t ticks) {
  CO_TMR& timers = node.Tmr;
  const Lock lock(timers);
  remove(timers, timer);
  rearm(timers, timer, ticks);
}

void stop(CO_NODE& node, CO_TMR_MEM& timer) {
  if (is_running(timer)) {
    const Lock lock(node.Tmr);
    remove(node.Tmr, timer);
  }
}

uint32_t now(CO_NODE& node) {
  const Lock lock(node.Tmr);
  return port::now(node);
}

Missing missing_call(CO_NODE& node) {
  const CO_TMR& t = node.Tmr;
  const Lock lock(t);
  const CO_TMR_MEM* const first = t.First;
  if (first == nullptr) {
    return Missing::nothing;
  }
  const uint32_t now = port::now(node);
  const bool is_due = t.Armed != &t.First;               // has_due() would no longer be inlined elsewhere
  if (!is_due && now - t.Clock < first->At - t.Clock) {  // armed, and not late
    return Missing::nothing;
  }
  // The clock of a classic driver does not advance beyond an alarm that was not processed.
  const uint32_t late = now - first->At;
  const bool is_stuck = node.If.HasElapsed != nullptr && late == 0 && !is_due;
  if (late <= t.Freq / 8 && !is_stuck) {
    return Missing::nothing;
  }
  return is_due ? Missing::process : Missing::service;
}

uint32_t next_deadline(CO_NODE& node) {
  CO_TMR& timers = node.Tmr;
  const Lock lock(timers);
  const uint32_t now = synchronise(timers);
  if (has_work(timers)) {
    return 0;
  }
  const CO_TMR_MEM* const next = USE_REAL_TIME != 0 ? *timers.Armed : timers.First;
  return next == nullptr ? UINT32_MAX : next->At - now;
}

void run_due(CO_TMR& timers) {
  CO_ASSERT(has_due(timers));
  const uint32_t first = timers.First->At;
  const uint32_t span = owner_of(first_armed(timers)).At - first;
  do {
    run(*timers.Node, remove_first(timers), 0);
  } while (has_due(timers) && timers.First->At - first <= span);
}

}  // namespace co::tmr

extern "C" {

void COTmrInit(CO_TMR* tmr, CO_NODE* node, CO_TMR_MEM* mem, uint16_t num, uint32_t freq) {
  ASSERT_PTR_FATAL(tmr);
  ASSERT_PTR_FATAL(node);
  *tmr = {};
  tmr->Armed = &tmr->First;
  tmr->Node = node;
  tmr->Pool = mem;
  tmr->Freq = freq;
  const unsigned max = mem == nullptr ? 0U : (num > INT16_MAX ? INT16_MAX : num);
  tmr->Max = static_cast<uint16_t>(max);
  tmr->IdStep = co::tmr::power_of_two(max);
  tmr->Clock = co::port::is_initialised(*node) ? co::port::now(*node) : 0;
}

uint32_t COTmrGetTicks(CO_TMR* tmr, uint16_t time, uint32_t unit) {
  ASSERT_PTR_ERR(tmr, 0);
  return co::tmr::ticks_at(tmr->Freq, time, unit);
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
    co::error::report(*tmr->Node, CO_ERR_BAD_ARG);
    return -1;
  }
  if ((startTicks == 0 && cycleTicks == 0) || !co::port::is_initialised(*tmr->Node)) {
    return -1;
  }
  const co::tmr::Lock lock(*tmr);
  CO_TMR_MEM* const timer = co::tmr::take_free(*tmr);
  if (timer == nullptr) {
    co::count(tmr->Node->Count.TimerExhausted);
    co::error::report(*tmr->Node, CO_ERR_TMR_NO_ACT);
    return -1;
  }
  co::tmr::arm(*tmr, *timer, startTicks, cycleTicks, func, para);
  return static_cast<int16_t>(timer->Id);
}

int16_t COTmrDelete(CO_TMR* tmr, int16_t actId) {
  ASSERT_PTR_FATAL_ERR(tmr, -1);
  ASSERT_PTR_FATAL_ERR(tmr->Node, -1);
  if (!co::port::is_initialised(*tmr->Node)) {
    return -1;
  }
  const co::tmr::Lock lock(*tmr);
  CO_TMR_MEM* const timer = co::tmr::find(*tmr, actId);
  if (timer == nullptr) {
    return -1;
  }
  co::tmr::remove(*tmr, *timer);
  co::tmr::release(*tmr, *timer);
  return 0;
}

int16_t COTmrService(CO_TMR* tmr) {
  ASSERT_PTR_ERR(tmr, -1);
  ASSERT_PTR_ERR(tmr->Node, -1);
  if (co::port::is_initialised(*tmr->Node) && co::port::has_elapsed(*tmr->Node)) {
    co::tmr::process_clock(*tmr);
  }
  return co::tmr::has_due(*tmr) || co::tmr::has_to_send(*tmr->Node) ? 1 : 0;
}

}  // extern "C"
