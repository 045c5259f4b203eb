// SPDX-License-Identifier: Apache-2.0
/// \file board.h
/// Functions and constants of a board, which its folder defines.
#ifndef BOARD_H_
#define BOARD_H_

#include "co_if_can.h"
#include "co_if_nvm.h"

/// Number of entries of the vector table behind the 16 of the CPU.
#define BOARD_INTERRUPTS 32

/// Returns the register at an address.
#define BOARD_REGISTER(address) (*(volatile uint32_t*)(address))

extern const uint32_t BoardHz;  ///< clock of the CPU
extern const CO_IF_CAN_DRV_EX* const BoardCan;
extern void* const BoardCanContext;
extern const CO_IF_NVM_DRV_EX* const BoardMemory;  ///< null: the board stores no parameters
extern void* const BoardMemoryContext;

/// Sets up clocks, pins and the interrupts of the CAN controller. Called first in main().
void BoardStart(void);

/// Switches the LED of the board.
void BoardLed(bool on);

/// Blinks the LED five to ten times a second and does not return. A product lets its watchdog reset the board.
void BoardBlink(void);

/// Calls the interrupt function of the CAN driver.
void BoardCanInterrupt(void);

/// Returns true if received frames wait until they are read.
bool BoardCanHasFrames(void);

/// Handles the NMI. A board defines it if its memory needs it; the one of start.c stops the program.
void NmiHandler(void);

/* Stops the firmware. */
void Fault(void);

/// \name Interrupts, defined by main.c
/// \{
void CanHandler(void);
void SysTickHandler(void);
/// \}

/// Enables an interrupt of the CPU.
static inline void BoardEnableInterrupt(unsigned number) {
  BOARD_REGISTER(0xE000E100u + 4u * (number / 32u)) = 1u << number % 32u;
}

/// Waits until bits of a register are set, and calls BoardBlink() after about 0.2 s without them: a clock does not
/// start.
static inline void BoardAwait(uint32_t address, uint32_t bits) {
  for (uint32_t n = 0; n < 200000u; ++n) {
    if ((BOARD_REGISTER(address) & bits) == bits) {
      return;
    }
  }
  BoardBlink();
}

/// Changes bits of a register.
static inline void BoardChange(uint32_t address, uint32_t clear, uint32_t set) {
  BOARD_REGISTER(address) = (BOARD_REGISTER(address) & ~clear) | set;
}

#endif
