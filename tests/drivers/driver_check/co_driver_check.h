// SPDX-License-Identifier: Apache-2.0
/// \file co_driver_check.h
/// Checks the drivers of a port on the port itself: each requirement of co_if_can.h, co_if_timer.h and co_if_nvm.h that
/// can be observed from outside has a name; the check prints its verdict and the reason in one line. docs/porting.md
/// describes how to run it.
///
///     static CO_DRIVER_CHECK Check = { &MyDrivers, NULL, MyPrint };    // other members: see below
///     void TIMER_IRQHandler(void) { MyTimerInterrupt(); CODriverCheckService(&Check); }   // for COTmrService()
///     int main(void) { ... return CODriverCheck(&Check); }             // 0: no check has failed
///
/// Add the files driver_check*.c to the firmware, with the drivers and the library. They use only string.h of the C
/// library, and allocate no memory.
///
/// Only the nodes named by CO_DRIVER_CHECK.Bus may be on the bus: the check sends frames of any identifier. It
/// overwrites the content of the non-volatile memory.
///
/// Context: the loop, with interrupts allowed. No node may use the drivers at the same time.
#ifndef CO_DRIVER_CHECK_H_
#define CO_DRIVER_CHECK_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Source of the frames that the driver receives.
typedef enum CO_CHECK_BUS_T {
  CO_CHECK_NO_BUS = 0,  ///< none: only the checks for a single controller
  CO_CHECK_LOOPBACK,    ///< the controller receives its frames: Enable selects its (internal) loopback mode
  CO_CHECK_PEER,        ///< a second controller on the same bus: CO_DRIVER_CHECK.Peer
  CO_CHECK_FEED,        ///< a PC on the same bus, on which the script feed runs
} CO_CHECK_BUS;

/// \name Frames that a driver can send and receive besides data frames with 11-bit identifiers
/// \{
#define CO_CHECK_29_BIT 1u
#define CO_CHECK_REMOTE 2u
/// \}

/// Settings and results of the check. 0 and null are the defaults.
typedef struct CO_DRIVER_CHECK_T {
  const CO_IF_DRV* Drv;    ///< classic drivers, as in CO_NODE_SPEC; null: only those of Ext
  const CO_NODE_EXT* Ext;  ///< drivers with context argument, which replace those of Drv, and lock functions; null:
                           ///< none
  void (*Print)(void* user, const char* line);  ///< prints a line, without line end; must not be null
  void* User;                                   ///< argument of the functions
  void (*Idle)(void* user);                     ///< called in every iteration of a wait; null: none

  CO_CHECK_BUS Bus;
  const CO_NODE_EXT* Peer;  ///< Can and CanCtx of the second controller
  uint32_t Baudrate;        ///< bit/s; 0: 125000
  uint8_t Frames;           ///< CO_CHECK_29_BIT, CO_CHECK_REMOTE
  uint8_t Burst;            ///< frames that the driver queues until they are read; 0: 16; at most 64 with a PC

  uint32_t TmrFreq;               ///< ticks per second, as in CO_NODE_SPEC; 0: no timer is checked
  uint32_t (*Clock)(void* user);  ///< another clock with TmrFreq, wrapping at 2^32; null: each interrupt is a tick
  uint32_t Late;                  ///< permitted lateness of an expiry, ticks, for the latency of interrupts
  uint32_t Longest;               ///< ticks of the longest wait; 0: two seconds. See timer.long and timer.wrap

  uint32_t NvmSize;  ///< bytes of a memory without Shape, from address 0; 0: such a memory is not checked

  uint32_t Patience;  ///< iterations of a wait for an expected event; 0: ten million
  uint32_t Quiet;     ///< iterations of a wait without an event; 0: a 500th, with a PC a tenth, of Patience

  uint16_t Passed;   ///< result: number of passed checks
  uint16_t Failed;   ///< number of failed checks
  uint16_t Skipped;  ///< number of checks that do not apply

  /// \cond internal
  volatile uint32_t Interrupts;
  volatile uint32_t Elapsed;    // number of expiries
  volatile uint32_t ElapsedAt;  // time of the last expiry, by the clock
  volatile uint32_t Chain;      // number of expiries after which the timer is loaded again in the interrupt
  uint32_t ChainTicks;
  volatile uint32_t LongFrom;   // begin of the wait of a driver with a clock that may interrupt meanwhile
  volatile uint32_t LongTicks;  // ticks of that wait; 0: there is none
  uint32_t Refused;             // frames refused by Send in the current check
  bool Running;                 // the classic timer was loaded and not stopped
  bool OddResult;               // Read or Send has returned an invalid result
  /// \endcond
} CO_DRIVER_CHECK;

/// Runs all checks, prints a line for each and a summary. Returns the number of failed checks.
uint16_t CODriverCheck(CO_DRIVER_CHECK* check);

/// \name Checks of one driver
/// \{
void CODriverCheckCan(CO_DRIVER_CHECK* check);
void CODriverCheckTimer(CO_DRIVER_CHECK* check);
void CODriverCheckNvm(CO_DRIVER_CHECK* check);
/// \}

/// Processes an interrupt of the timer. To be called where the firmware calls COTmrService().
void CODriverCheckService(CO_DRIVER_CHECK* check);

#ifdef __cplusplus
}
#endif

#endif
