// SPDX-License-Identifier: Apache-2.0
/// \file board.h
/// Description of a board, which its folder defines, and its use.
#ifndef BOARD_H_
#define BOARD_H_

#include "co_if_can.h"
#include "co_if_nvm.h"

/// Number of entries of the vector table behind the 16 of the CPU.
#define BOARD_INTERRUPTS 32

/// Returns the register at an address.
#define BOARD_REGISTER(address) (*(volatile uint32_t*)(address))

/// Write access to a register: clears bits and sets bits, then waits until the bits Await of it are set (0: none).
typedef struct BOARD_STEP {
  uint32_t Address, Clear, Set, Await;
} BOARD_STEP;

typedef struct BOARD {
  uint32_t Hz;              ///< clock of the CPU
  const BOARD_STEP* Steps;  ///< sets up pins, LED first, then clocks, then the clock of the CAN controller
  uint32_t StepNum;
  uint32_t LedAddress, LedOn, LedOff;  ///< values of this register switch the LED
  uint32_t Interrupts;                 ///< those of the CAN controller; bit n: interrupt n
  const CO_IF_CAN_DRV_EX* Can;
  void* CanContext;
  const CO_IF_NVM_DRV_EX* Memory;  ///< null: the board stores no parameters
  void* MemoryContext;
} BOARD;

extern const BOARD Board;

/// Calls the interrupt function of the CAN driver. Defined by the board.
void BoardCanInterrupt(void);

/// Returns true if received frames wait until they are read. Defined by the board.
bool BoardCanHasFrames(void);

/// Handles the NMI. A board defines it if its memory needs it; the one of start.c stops the program.
void NmiHandler(void);

/// Executes the steps of the board and enables the interrupts of its CAN controller. Called first in main(). If a bit
/// is not set within about 0.2 s, a clock does not start: the LED blinks five to ten times a second, and the function
/// does not return. A product lets its watchdog reset the board.
void BoardStart(void);

/// Switches the LED of the board.
void BoardLed(bool on);

/// Stops the firmware.
void Fault(void);

/// \name Interrupts, defined by main.c
/// \{
void CanHandler(void);
void SysTickHandler(void);
/// \}

#endif
