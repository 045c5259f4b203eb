// SPDX-License-Identifier: Apache-2.0
#include "co_timer_template.h"

// Context of all functions but Update: the loop with COTmrLock() held, or COTmrService() in the interrupt. So they are
// never interrupted by each other.

// The longest wait that is given to the hardware at once: at most half a turn of the counter (7FFFh for 16 bits), so
// that a late interrupt does no harm. What is beyond is waited for in steps.
#define LONGEST_STEP 0x4000u

static bool Waits;         // for a match
static bool Matched;       // the whole time has elapsed, and Update has not told it yet
static bool FollowsMatch;  // the next Reload goes on from the match that Update has just told
static uint32_t Left;      // ticks beyond the match that is being waited for

// Called once. freq: ticks per second of CO_NODE_SPEC.TmrFreq.
static void Init(uint32_t freq) {
  CO_UNUSED(freq);  // Here: set the prescaler so that the counter runs at freq; let it run, the compare interrupt off.
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

// The next match, from the last one on.
static void Step(void) {
  const uint32_t step = Left < LONGEST_STEP ? Left : LONGEST_STEP;
  Left -= step;
  // Here: compare += step. If compare has been passed by the time it is written, raise the interrupt by software: else
  // the match would come one turn of the counter late.
}

// Elapse ticks (> 0) from now; a match that is pending is discarded. Directly after an Update that has returned 1,
// count from the match instead of from now: so the time that interrupt and stack have taken does not add up, and cyclic
// timers do not drift.
static void Reload(uint32_t ticks) {
  // Here: compare flag cleared; if not FollowsMatch, compare = counter.
  FollowsMatch = false;
  Matched = false;
  Waits = true;
  Left = ticks;
  Step();
  // Here: compare interrupt on.
}

// Ticks left until the end, 0: elapsed.
static uint32_t Delay(void) {
  const int32_t until_match = 0;  // Here: compare - counter, negative if it is over, in the width of the counter.
  const int32_t ticks = (int32_t)Left + until_match;
  return Waits && ticks > 0 ? (uint32_t)ticks : 0;
}

// Nothing to wait for: no interrupt until the next Reload, and none that is pending.
static void Stop(void) {
  // Here: compare interrupt off, compare flag cleared.
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

// Called directly after the Reload that follows a Stop.
static void Start(void) {}

// Context: COTmrService(). Returns 1 once for each expiry, 0 for any other interrupt.
// (Cyclic mode: decrement a count-down here, and return 1 when it reaches 0.)
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
