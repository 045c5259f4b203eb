// SPDX-License-Identifier: Apache-2.0
#include "example_board.h"

#define LONGEST_STEP 0x4000u  // ticks: far below a turn of the counter, so that a late interrupt does no harm

// What interrupt and loop share; the loop touches it with the interrupt kept away (COTmrLock()).
static bool Waits;         // for a match
static bool Matched;       // the whole time has elapsed, and Update has not told it yet
static bool FollowsMatch;  // the next Reload goes on from the match that Update has just told
static uint32_t Left;      // ticks beyond the match that is being waited for

static void Init(uint32_t freq) {
  ExampleTimer.Enable = 0;
  ExampleTimer.Prescaler = EXAMPLE_CLOCK / freq;
  Waits = false;
  Matched = false;
  FollowsMatch = false;
}

// Ticks until the match; negative: it is over.
static int16_t UntilMatch(void) { return (int16_t)(ExampleTimer.Compare - ExampleTimer.Counter); }

// From the last match on. If the next one is over by the time it is written, it would come a turn of the counter late:
// it is raised by software.
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

static void Start(void) {}  // Reload has done it

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
