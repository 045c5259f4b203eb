// SPDX-License-Identifier: Apache-2.0
#include "co_timer_template.h"

// Context of all functions but Update: the loop with COTmrLock() held, or COTmrService() in the interrupt. So they
// never interrupt each other.

// Longest time to the next match, ticks: at most half the range of the counter (7FFFh for 16 bits), so that a late
// interrupt does no harm. Longer times are divided into such steps.
#define LONGEST_STEP 0x4000u

static bool Waits;         // a match is awaited
static bool Matched;       // the whole time has elapsed, and Update has not reported it yet
static bool FollowsMatch;  // the next Reload counts from the match that Update has just reported
static uint32_t Left;      // ticks to count after the next match

// Called once. freq: ticks per second of CO_NODE_SPEC.TmrFreq.
static void Init(uint32_t freq) {
  CO_UNUSED(freq);  // Here: set the prescaler so that the counter runs at freq; let it run, the compare interrupt off.
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

// Sets the next match, counted from the previous one.
static void Step(void) {
  const uint32_t step = Left < LONGEST_STEP ? Left : LONGEST_STEP;
  Left -= step;
  // Here: compare += step. If the counter has already passed compare when it is written, raise the interrupt by
  // software: otherwise the match would come one wrap of the counter late.
}

// Set the expiry to ticks (> 0) from now; discard a pending match. Directly after an Update that has returned 1, count
// from the match instead of from now: so the execution time of interrupt and stack does not add up, and cyclic timers
// do not drift.
static void Reload(uint32_t ticks) {
  // Here: clear the compare flag; if not FollowsMatch, compare = counter.
  FollowsMatch = false;
  Matched = false;
  Waits = true;
  Left = ticks;
  Step();
  // Here: enable the compare interrupt.
}

// Returns the ticks until the expiry; 0: the time has elapsed, or the timer is stopped.
static uint32_t Delay(void) {
  const int32_t until_match = 0;  // Here: compare - counter, negative if it is over, in the width of the counter.
  const int32_t ticks = (int32_t)Left + until_match;
  return Waits && ticks > 0 ? (uint32_t)ticks : 0;
}

// Stop the timer: no interrupt until the next Reload; discard a pending one.
static void Stop(void) {
  // Here: disable the compare interrupt, clear the compare flag.
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

// Called directly after the Reload that follows a Stop.
static void Start(void) {}

// Context: COTmrService(). Returns 1 once for each expiry, 0 for any other interrupt.
// (Cyclic mode: decrement a counter here, and return 1 when it reaches 0.)
static uint8_t Update(void) {
  if (!Matched) {
    return 0;
  }
  Matched = false;
  Waits = false;
  FollowsMatch = true;
  return 1;
}

const CO_IF_TIMER_DRV TemplateTimerDriver = {Init, Reload, Delay, Stop, Start, Update};

// Context: the compare interrupt.
void TemplateTimerInterrupt(void) {
  const bool match = false;  // Here: is the compare flag set? Clear it.
  if (!match) {
    return;
  }
  if (Left != 0) {
    Step();
  } else {
    Matched = Waits;
  }
}
