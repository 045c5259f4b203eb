// SPDX-License-Identifier: Apache-2.0
#include "co_timer_template.h"

// Context of all functions but Update: the loop with COTmrLock() held, or COTmrService() in the interrupt. So they are
// never interrupted by each other.

static bool Elapsed = true;            // the compare match has come, or nothing is to be waited for
static bool FollowsMatch = false;      // the next Reload continues from the match that Update has just told
static volatile bool Matched = false;  // written by the interrupt

// Called once. freq: ticks per second of CO_NODE_SPEC.TmrFreq.
static void Init(uint32_t freq) {
  CO_UNUSED(freq);  // Here: set the prescaler so that the counter runs at freq; let it run, the compare interrupt off.
  Elapsed = true;
  FollowsMatch = false;
  Matched = false;
}

// Elapse ticks (> 0) from now. Directly after an Update that has returned 1, count from the match instead of from now:
// so the time that interrupt and stack have taken does not add up, and cyclic timers do not drift.
static void Reload(uint32_t ticks) {
  CO_UNUSED(ticks);
  CO_UNUSED(FollowsMatch);
  // Here: compare = (FollowsMatch ? compare : counter) + ticks. If ticks exceed the counter's range, wait in steps and
  // count the remaining ones in TemplateTimerInterrupt(). If compare has been passed by the time it is written, raise
  // the interrupt by software: else the match would come one turn of the counter late.
  Elapsed = false;
  FollowsMatch = false;
  Matched = false;
}

// Ticks left until the match, 0: elapsed.
static uint32_t Delay(void) {
  // Here: if not Elapsed, return compare - counter (0 if that is passed), plus the steps that are still to come.
  return 0;
}

// Nothing to wait for: no interrupt until the next Reload.
static void Stop(void) {
  // Here: compare interrupt off.
  Elapsed = true;
  FollowsMatch = false;
}

// Called directly after the Reload that follows a Stop.
static void Start(void) {
  // Here: compare interrupt on.
}

// Context: COTmrService(). Returns 1 once for each match, 0 for any other interrupt.
// (Cyclic mode: decrement a count-down here, and return 1 when it reaches 0.)
static uint8_t Update(void) {
  if (!Matched) {
    return 0;
  }
  Matched = false;
  Elapsed = true;
  FollowsMatch = true;
  return 1;
}

const CO_IF_TIMER_DRV TemplateTimerDriver = {Init, Reload, Delay, Stop, Start, Update};

// Context: the compare interrupt.
void TemplateTimerInterrupt(void) {
  const bool match = false;  // Here: is the compare flag set? Clear it.
  if (match && !Elapsed) {
    Matched = true;
  }
}
