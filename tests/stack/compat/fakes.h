// SPDX-License-Identifier: Apache-2.0
/// \file fakes.h
/// Simulated environment of a node: classic drivers, a bus, and a clock. Frames are written as by candump:
/// "601#4000100000000000".
#ifndef COMPAT_FAKES_H_
#define COMPAT_FAKES_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_IF_CAN_DRV FakeCanDriver;
extern const CO_IF_TIMER_DRV FakeCyclicTimerDriver;  ///< a periodic interrupt and a down counter
extern const CO_IF_TIMER_DRV FakeDeltaTimerDriver;   ///< a compare match
extern const CO_IF_NVM_DRV FakeNvmDriver;

/// Number of calls of the drivers, and their last arguments.
typedef struct FAKES {
  unsigned CanInits;
  unsigned CanEnables;
  unsigned CanResets;
  unsigned CanCloses;
  unsigned NvmInits;
  uint32_t Baudrate;
  uint32_t TimerFreq;
  int CanBroken;  ///< 1: Read and Send report an error
} FAKES;

extern FAKES Fakes;

/// Restores the state before power-on.
void FakesReset(void);

/// Puts a frame on the bus and lets \a node process it.
void BusReceive(CO_NODE* node, const char* frame);
/// Returns the next frame that the node has sent, "" if there is none.
const char* BusSent(void);

/// Advances the time by \a ticks: calls the timer interrupt and the main loop for each.
void TimePasses(CO_NODE* node, uint32_t ticks);

/// Initialises and starts a node (node-ID 1) without application timers; removes its boot-up message from the bus.
void NodeUp(CO_NODE* node, const CO_OBJ* dict, uint16_t len);

/// Like NodeUp(), with the extension for CONodeInitEx().
void NodeUpEx(CO_NODE* node, const CO_OBJ* dict, uint16_t len, const CO_NODE_EXT* ext);

#ifdef __cplusplus
}
#endif

#define TEST_ASSERT_SENT(frame) TEST_ASSERT_EQUAL_STRING(frame, BusSent())

#endif
