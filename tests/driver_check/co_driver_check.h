// SPDX-License-Identifier: Apache-2.0
/// \file co_driver_check.h
/// Checks the drivers of a port on the port itself: each promise of co_if_can.h, co_if_timer.h and co_if_nvm.h that can
/// be seen from outside has a name, and gets a verdict and a reason in one line. docs/porting.md tells how to run it.
///
///     static CO_DRIVER_CHECK Check = { &MyDrivers, NULL, MyPrint };    // the rest: see the members
///     void TIMER_IRQHandler(void) { MyTimerInterrupt(); CODriverCheckService(&Check); }   // for COTmrService()
///     int main(void) { ... return CODriverCheck(&Check); }             // 0: no promise was found broken
///
/// Add the files driver_check*.c to the firmware, beside the drivers and the library. Nothing of the C library is used
/// but string.h; no memory is allocated.
///
/// Nothing else may be on the bus but what CO_DRIVER_CHECK.Bus says: frames of any identifier are sent. The content of
/// the non-volatile memory is lost.
///
/// Context: the loop, with interrupts allowed. No node may use the drivers at the same time.
#ifndef CO_DRIVER_CHECK_H_
#define CO_DRIVER_CHECK_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Where the frames come from that the driver is to receive.
typedef enum CO_CHECK_BUS_T {
  CO_CHECK_NO_BUS = 0,  ///< from nowhere: only what a lone controller can show
  CO_CHECK_LOOPBACK,    ///< the controller receives what it sends: Enable goes into its (internal) loopback mode
  CO_CHECK_PEER,        ///< a second controller on the same bus: CO_DRIVER_CHECK.Peer
  CO_CHECK_FEED,        ///< a PC on the same bus, on which the script feed runs
} CO_CHECK_BUS;

/// \name Frames that a driver can send and receive besides data frames with 11-bit identifiers
/// \{
#define CO_CHECK_29_BIT 1u
#define CO_CHECK_REMOTE 2u
/// \}

/// What is to be checked, and how. 0 and null are the defaults.
typedef struct CO_DRIVER_CHECK_T {
  const CO_IF_DRV* Drv;    ///< drivers without context, as in CO_NODE_SPEC; null: Ext names those that there are
  const CO_NODE_EXT* Ext;  ///< drivers with context, which come before those of Drv, and lock functions; null: none
  void (*Print)(void* user, const char* line);  ///< a line without its end; must not be null
  void* User;                                   ///< for the functions here
  void (*Idle)(void* user);                     ///< called in every turn of waiting; null: nothing is to be done

  CO_CHECK_BUS Bus;
  const CO_NODE_EXT* Peer;  ///< Can and CanCtx of the second controller
  uint32_t Baudrate;        ///< bit/s; 0: 125000
  uint8_t Frames;           ///< CO_CHECK_29_BIT, CO_CHECK_REMOTE
  uint8_t Burst;            ///< frames that the driver keeps until they are read; 0: 16; at most 64 with a PC

  uint32_t TmrFreq;               ///< ticks per second, as in CO_NODE_SPEC; 0: no timer is checked
  uint32_t (*Clock)(void* user);  ///< another clock with TmrFreq, wrapping at 2^32; null: each interrupt is a tick
  uint32_t Late;                  ///< ticks by which an expiry may be late, as interrupts take their time
  uint32_t Longest;               ///< ticks of the longest wait; 0: two seconds. See timer.long and timer.wrap

  uint32_t NvmSize;  ///< bytes of a memory without Shape, from address 0; 0: such a memory is not checked

  uint32_t Patience;  ///< turns of waiting for something that has to come; 0: ten million
  uint32_t Quiet;     ///< turns of waiting that nothing comes; 0: a 500th, with a PC a tenth, of Patience

  uint16_t Passed;   ///< the result: checks that have passed,
  uint16_t Failed;   ///< that have failed,
  uint16_t Skipped;  ///< and that do not apply

  /// \cond internal
  volatile uint32_t Interrupts;
  volatile uint32_t Elapsed;    // expiries
  volatile uint32_t ElapsedAt;  // the last one, by the clock
  volatile uint32_t Chain;      // expiries after which the timer is loaded again in the interrupt
  uint32_t ChainTicks;
  volatile uint32_t LongFrom;   // the wait of a driver with a clock that may interrupt on its way
  volatile uint32_t LongTicks;  // 0: none
  uint32_t Refused;             // frames, by Send, in the present check
  bool Running;                 // the plain timer was loaded and not stopped
  bool OddResult;               // of Read or Send
  /// \endcond
} CO_DRIVER_CHECK;

/// Runs all checks, and prints a line for each and one at the end. Returns the number of promises that were broken.
uint16_t CODriverCheck(CO_DRIVER_CHECK* check);

/// \name One driver alone
/// \{
void CODriverCheckCan(CO_DRIVER_CHECK* check);
void CODriverCheckTimer(CO_DRIVER_CHECK* check);
void CODriverCheckNvm(CO_DRIVER_CHECK* check);
/// \}

/// To be called where the firmware calls COTmrService().
void CODriverCheckService(CO_DRIVER_CHECK* check);

#ifdef __cplusplus
}
#endif

#endif
