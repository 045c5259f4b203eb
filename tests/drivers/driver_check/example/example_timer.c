// SPDX-License-Identifier: Apache-2.0
#include "example_board.h"

#define LONGEST_STEP 0x4000u  // ticks: much less than the counter's range, so that a late interrupt does no harm

// Data shared by interrupt and loop. The loop accesses them with the interrupt disabled (COTmrLock()).
static bool Waits;         // a match is pending
static bool Matched;       // the whole time has elapsed, and Update has not reported it yet
static bool FollowsMatch;  // the next Reload counts from the match that Update has just reported
static uint32_t Left;      // ticks to count after the next match

static void Init(uint32_t freq) {
  ExampleTimer.Enable = 0;
  ExampleTimer.Prescaler = EXAMPLE_CLOCK / freq;
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

// Returns the ticks until the match; negative: it has passed.
static int16_t UntilMatch(void) { return (int16_t)(ExampleTimer.Compare - ExampleTimer.Counter); }

// Sets the next match, counted from the previous one. If it has passed by the time it is written, it would come one
// wrap of the counter late: the interrupt is raised by software.
static void Step(void) {
  const uint32_t step = Left < LONGEST_STEP ? Left : LONGEST_STEP;
  Left -= step;
  ExampleTimer.Compare = (ExampleTimer.Compare + step) & 0xFFFF;
  if (UntilMatch() <= 0) {
    ExampleTimer.Match = 1;
  }
}

static void Reload(uint32_t ticks) {
  ExampleTimer.Match = 0;
  Matched = false;
  if (!FollowsMatch) {
    ExampleTimer.Compare = ExampleTimer.Counter;
  }
  FollowsMatch = false;
  Waits = true;
  Left = ticks;
  Step();
  ExampleTimer.Enable = 1;
}

static uint32_t Delay(void) {
  const int32_t ticks = (int32_t)Left + UntilMatch();
  return Waits && ticks > 0 ? (uint32_t)ticks : 0;
}

static void Stop(void) {
  ExampleTimer.Enable = 0;
  ExampleTimer.Match = 0;
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

static void Start(void) {}  // Reload has started it

static uint8_t Update(void) {
  if (!Matched) {
    return 0;
  }
  Matched = false;
  Waits = false;
  FollowsMatch = true;
  return 1;
}

const CO_IF_TIMER_DRV ExampleTimerDriver = {Init, Reload, Delay, Stop, Start, Update};

void ExampleTimerInterrupt(void) {
  if (ExampleTimer.Match == 0) {
    return;
  }
  ExampleTimer.Match = 0;
  if (Left != 0) {
    Step();
  } else {
    Matched = Waits;
  }
}
