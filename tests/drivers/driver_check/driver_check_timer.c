// SPDX-License-Identifier: Apache-2.0
#include "driver_check.h"

static bool HasClock(const CO_DRIVER_CHECK* c) { return c->Ext != NULL && c->Ext->Timer != NULL; }

static const CO_IF_TIMER_DRV* Plain(const CO_DRIVER_CHECK* c) { return c->Drv->Timer; }

static uint32_t Now(const CO_DRIVER_CHECK* c) {
  if (HasClock(c)) {
    return c->Ext->Timer->Now(c->Ext->TimerCtx);
  }
  return c->Clock != NULL ? c->Clock(c->User) : c->Interrupts;
}

static void Lock(const CO_DRIVER_CHECK* c) {
  c->Ext != NULL && c->Ext->Lock != NULL ? c->Ext->Lock(c->Ext->User) : COTmrLock();
}

static void Unlock(const CO_DRIVER_CHECK* c) {
  c->Ext != NULL && c->Ext->Unlock != NULL ? c->Ext->Unlock(c->Ext->User) : COTmrUnlock();
}

// Returns the number of additional interrupts that a check permits where no alarm is set. The stack compares the clock,
// so that an interrupt before the alarm or without one does no harm; a driver may need such interrupts for long waits.
static uint32_t Spare(const CO_DRIVER_CHECK* c) { return HasClock(c) ? 1 : 0; }

// Starts or stops the timer in the order of the stack's calls: Start only after Init or Stop.
static void Load(CO_DRIVER_CHECK* c, uint32_t ticks) {
  if (HasClock(c)) {
    c->Ext->Timer->Alarm(c->Ext->TimerCtx, ticks);
    return;
  }
  if (ticks == 0) {
    Plain(c)->Stop();
  } else {
    Plain(c)->Reload(ticks);
    if (!c->Running) {
      Plain(c)->Start();
    }
  }
  c->Running = ticks != 0;
}

void CODriverCheckService(CO_DRIVER_CHECK* check) {
  check->Interrupts = check->Interrupts + 1;
  if (!HasClock(check) && Plain(check)->Update() == 0) {
    return;
  }
  const uint32_t passed = Now(check) - check->LongFrom;
  if (passed < check->LongTicks) {
    Load(check, check->LongTicks - passed);
    return;
  }
  check->ElapsedAt = Now(check);
  check->Elapsed = check->Elapsed + 1;
  const bool more = check->Chain != 0;
  check->Chain = check->Chain - (more ? 1 : 0);
  Load(check, more ? check->ChainTicks : 0);
}

// Returns the number of expiries so far, which the interrupt counts.
static uint32_t Count(const CO_DRIVER_CHECK* c) { return c->Elapsed; }

static uint32_t Arm(CO_DRIVER_CHECK* c, uint32_t ticks) {
  Lock(c);
  const uint32_t now = Now(c);
  c->LongFrom = now;
  Load(c, ticks);
  Unlock(c);
  return now;
}

// Waits until ticks have passed since from, or the clock does not advance.
static void WaitUntil(const CO_DRIVER_CHECK* c, uint32_t from, uint32_t ticks) {
  uint32_t last = Now(c);
  for (uint32_t turn = CheckPatience(c); turn != 0 && last - from < ticks; --turn) {
    CheckIdle(c);
    const uint32_t now = Now(c);
    turn = now == last ? turn : CheckPatience(c);
    last = now;
  }
}

static void WaitTicks(const CO_DRIVER_CHECK* c, uint32_t ticks) { WaitUntil(c, Now(c), ticks); }

// Waits for an expiry after the first before ones, at most a tick longer than it may be late.
static bool AwaitElapsed(const CO_DRIVER_CHECK* c, uint32_t before, uint32_t from, uint32_t ticks) {
  uint32_t last = Now(c);
  for (uint32_t turn = CheckPatience(c); turn != 0 && Count(c) == before && last - from <= ticks + c->Late + 1;
       --turn) {
    CheckIdle(c);
    const uint32_t now = Now(c);
    turn = now == last ? turn : CheckPatience(c);
    last = now;
  }
  return Count(c) != before;
}

static void CheckInit(CO_DRIVER_CHECK* c) {
  const uint32_t before = Count(c);
  WaitTicks(c, 20);
  const bool left = !HasClock(c) && Plain(c)->Delay() != 0;
  if (Count(c) - before > Spare(c) || left) {
    CheckFail(c, "timer.init", left ? "after Init, Delay is not 0" : "after Init, an expiry is reported");
    return;
  }
  CheckPass(c, "timer.init", "after Init, no expiry is reported");
}

static void CheckClock(CO_DRIVER_CHECK* c) {
  const uint32_t start = Now(c);
  uint32_t last = start;
  for (uint32_t turn = CheckPatience(c); turn != 0 && last - start < 1000; --turn) {
    CheckIdle(c);
    const uint32_t now = Now(c);
    if (now - last > INT32_MAX) {
      CheckSay(c, CHECK_FAILED, "timer.clock", "the clock goes back from # to #", last, now);
      return;
    }
    turn = now == last ? turn : CheckPatience(c);
    last = now;
  }
  if (last - start < 1000) {
    CheckFail(c, "timer.clock", "the clock does not advance");
    return;
  }
  CheckPass(c, "timer.clock", "the clock advances and never goes back");
}

// Compares the driver's clock with the other clock of the same frequency. Tolerance: 2 %, more than any crystal
// deviates.
static void CheckRate(CO_DRIVER_CHECK* c) {
  if (c->Clock == NULL) {
    CheckSkip(c, "timer.rate", "no reference clock is set");
    return;
  }
  const uint32_t other = c->Clock(c->User);
  const uint32_t start = Now(c);
  WaitUntil(c, start, 1000);
  const uint32_t passed = Now(c) - start;
  const uint32_t expected = c->Clock(c->User) - other;
  const uint32_t wrong = passed > expected ? passed - expected : expected - passed;
  CheckSay(c, wrong > expected / 50 + 1 ? CHECK_FAILED : CHECK_OK, "timer.rate",
           "# ticks in # ticks of the reference clock", passed, expected);
}

// Waits for an expiry after ticks. Returns 0: in time, 1: early, 2: late, 3: not at all; the time of it in after.
static uint8_t Elapses(CO_DRIVER_CHECK* c, uint32_t ticks, uint32_t* after) {
  const uint32_t before = Count(c);
  const uint32_t start = Arm(c, ticks);
  if (!AwaitElapsed(c, before, start, ticks)) {
    *after = Now(c) - start;
    return *after > ticks ? 2 : 3;
  }
  *after = c->ElapsedAt - start;
  return *after < ticks ? 1 : (*after - ticks > c->Late ? 2 : 0);
}

static void CheckElapses(CO_DRIVER_CHECK* c) {
  static const uint16_t delays[] = {1, 2, 3, 7, 10, 64, 100, 255, 256, 257, 1000};
  static const char* const wrong[] = {"", "# ticks elapse early, after #", "# ticks elapse late or not at all: after #",
                                      "# ticks do not elapse"};
  for (size_t n = 0; n < sizeof(delays) / sizeof(delays[0]); ++n) {
    uint32_t after = 0;
    const uint8_t result = Elapses(c, delays[n], &after);
    if (result != 0) {
      CheckSay(c, CHECK_FAILED, "timer.elapse", wrong[result], delays[n], after);
      return;
    }
  }
  CheckPass(c, "timer.elapse", "1 to 1000 ticks elapse neither early nor late");
}

// Checks a long wait; a driver with a clock may interrupt before its end.
static void CheckLong(CO_DRIVER_CHECK* c) {
  const uint32_t ticks = c->Longest == 0 ? 2 * c->TmrFreq : c->Longest;
  uint32_t after = 0;
  c->LongTicks = HasClock(c) ? ticks : 0;
  const uint8_t result = Elapses(c, ticks, &after);
  c->LongTicks = 0;
  const uint32_t wrong = after > ticks ? after - ticks : ticks - after;
  CheckSay(c, result == 0 ? CHECK_OK : CHECK_FAILED, "timer.long",
           result == 1 ? "# ticks elapse # early" : "# ticks elapse # late", ticks, wrong);
}

static void CheckOnce(CO_DRIVER_CHECK* c) {
  uint32_t after = 0;
  const bool elapsed = Elapses(c, 20, &after) != 3;
  const uint32_t once = Count(c);
  WaitTicks(c, 60);
  if (!elapsed || Count(c) - once > Spare(c)) {
    CheckFail(c, "timer.once", "the timer does not elapse exactly once");
    return;
  }
  CheckPass(c, "timer.once", "the timer elapses once for each Reload");
}

static void CheckStop(CO_DRIVER_CHECK* c) {
  const uint32_t before = Count(c);
  const uint32_t start = Arm(c, 30);
  WaitTicks(c, 5);
  (void)Arm(c, 0);
  const bool left = !HasClock(c) && Plain(c)->Delay() != 0;
  WaitTicks(c, 90);
  const bool in_time = c->ElapsedAt - start <= 31 + c->Late;
  if ((Count(c) != before && (in_time || !HasClock(c))) || left) {
    CheckFail(c, "timer.stop", left ? "a stopped timer has a Delay" : "a stopped timer elapses");
    return;
  }
  CheckPass(c, "timer.stop", "a stopped timer does not elapse");
}

static void CheckReplace(CO_DRIVER_CHECK* c, uint32_t first, uint32_t wait, uint32_t second) {
  const uint32_t before = Count(c);
  (void)Arm(c, first);
  WaitTicks(c, wait);
  uint32_t after = 0;
  const uint8_t result = Count(c) != before ? 1 : Elapses(c, second, &after);
  WaitTicks(c, first + 10);
  if (result == 0 && Count(c) - before <= 1 + Spare(c)) {
    CheckSay(c, CHECK_OK, "timer.replace", "a Reload of # ticks replaces one of #", second, first);
  } else {
    CheckSay(c, CHECK_FAILED, "timer.replace", "a Reload of # ticks does not replace one of #", second, first);
  }
}

static void CheckChain(CO_DRIVER_CHECK* c) {
  const uint32_t num = 50;
  const uint32_t ticks = 10 + 2 * c->Late;
  const uint32_t before = Count(c);
  c->ChainTicks = ticks;
  c->Chain = num - 1;
  const uint32_t start = Arm(c, ticks);
  for (uint32_t n = 1; n <= num; ++n) {
    if (!AwaitElapsed(c, before + n - 1, start, n * (ticks + c->Late + 1))) {
      break;
    }
  }
  c->Chain = 0;
  (void)Arm(c, 0);
  const uint32_t came = Count(c) - before;
  CheckSay(c, came == num ? CHECK_OK : CHECK_FAILED, "timer.reload",
           "with a Reload in the interrupt, the timer elapses # times of #", came, num);
  if (HasClock(c)) {
    return;  // the stack computes each delay from the clock
  }
  const uint32_t took = c->ElapsedAt - start;
  const bool steady = came == num && took >= num * ticks && took <= num * ticks + c->Late;
  CheckSay(c, steady ? CHECK_OK : CHECK_FAILED, "timer.drift", "with a Reload in the interrupt, # ticks take #",
           num * ticks, took);
}

static void CheckDelay(CO_DRIVER_CHECK* c) {
  const uint32_t ticks = 50;
  const uint32_t before = Count(c);
  const uint32_t start = Arm(c, ticks);
  while (Count(c) == before && Now(c) - start < ticks) {
    Lock(c);
    const uint32_t passed = Now(c) - start;
    const uint32_t left = Plain(c)->Delay();
    Unlock(c);
    const uint32_t sum = passed + left;
    if (passed < ticks && (sum > ticks + 1 || sum + 1 < ticks)) {
      CheckSay(c, CHECK_FAILED, "timer.delay", "# ticks after a Reload of 50, Delay is #", passed, left);
      (void)Arm(c, 0);
      return;
    }
    WaitTicks(c, 1);
  }
  (void)AwaitElapsed(c, before, start, ticks);
  const uint32_t left = Plain(c)->Delay();
  CheckSay(c, left == 0 ? CHECK_OK : CHECK_FAILED, "timer.delay", "Delay decreases to #", left, 0);
}

// Lets the timer elapse while interrupts are disabled: the pending expiry must be discarded by Reload and Stop.
static void CheckPending(CO_DRIVER_CHECK* c) {
  if (c->Clock == NULL) {
    CheckSkip(c, "timer.pending", "no reference clock is set, which is needed while interrupts are disabled");
    return;
  }
  const uint32_t before = Count(c);
  Lock(c);
  Load(c, 10);
  WaitTicks(c, 15);
  const bool left = Plain(c)->Delay() != 0;
  const uint32_t start = Now(c);
  Load(c, 40);
  Unlock(c);
  const bool came = AwaitElapsed(c, before, start, 40);
  const bool early = came && c->ElapsedAt - start < 40;
  const uint32_t once = Count(c);
  Lock(c);
  Load(c, 10);
  WaitTicks(c, 15);
  Load(c, 0);
  Unlock(c);
  WaitTicks(c, 20);
  if (left || !came || early || Count(c) != once) {
    CheckFail(c, "timer.pending",
              left ? "Delay is not 0 when the timer has elapsed" : "Reload or Stop does not discard a pending expiry");
    return;
  }
  CheckPass(c, "timer.pending", "Reload and Stop discard a pending expiry");
}

static void CheckWrap(CO_DRIVER_CHECK* c) {
  const uint32_t longest = c->Longest == 0 ? 2 * c->TmrFreq : c->Longest;
  const uint32_t left = 0u - Now(c);
  if (left > longest || left < 50) {
    CheckSkip(c, "timer.wrap", "the wrap is too far away; start the clock shortly before 2^32 (FFFF0000h)");
    return;
  }
  uint32_t after = 0;
  WaitTicks(c, left - 40);
  const uint8_t result = Elapses(c, 100, &after);
  const uint32_t now = Now(c);
  CheckSay(c, result == 0 && now < INT32_MAX ? CHECK_OK : CHECK_FAILED, "timer.wrap",
           "across the wrap, 100 ticks take #; the clock is at #", after, now);
}

static void Start(CO_DRIVER_CHECK* c) {
  c->Chain = 0;
  c->LongTicks = 0;
  c->Running = false;
  if (HasClock(c)) {
    c->Ext->Timer->Init(c->Ext->TimerCtx, c->TmrFreq);
  } else {
    Plain(c)->Init(c->TmrFreq);
  }
}

static void CheckExpiries(CO_DRIVER_CHECK* c) {
  CheckInit(c);
  CheckElapses(c);
  CheckOnce(c);
  CheckStop(c);
  CheckReplace(c, 50, 20, 45);
  CheckReplace(c, 90, 20, 10);
  CheckChain(c);
  CheckLong(c);
}

void CODriverCheckTimer(CO_DRIVER_CHECK* check) {
  const bool plain = check->Drv != NULL && check->Drv->Timer != NULL;
  if (check->TmrFreq == 0 || (!HasClock(check) && !plain)) {
    CheckSkip(check, "timer", "no driver or no frequency is set");
    return;
  }
  Start(check);
  if (HasClock(check)) {
    const bool alarms = check->Ext->Timer->Alarm != NULL;
    CheckClock(check);
    CheckRate(check);
    if (!alarms) {
      CheckSkip(check, "timer.elapse", "the driver has no Alarm; the loop polls CONodeNextDeadline()");
      return;
    }
    CheckWrap(check);
  }
  CheckExpiries(check);
  if (!HasClock(check)) {
    CheckDelay(check);
    CheckPending(check);
  }
}
