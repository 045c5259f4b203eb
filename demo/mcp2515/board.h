// SPDX-License-Identifier: Apache-2.0
/// \file board.h
/// Functions of a board with an MCP2515, which its firmware defines, and those that its interrupts call.
#ifndef BOARD_H_
#define BOARD_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Sets up clocks, SPI (mode 0,0, at most 10 MHz), pins, a periodic interrupt of 1 ms and an interrupt at the falling
/// edge of INT. Called first in main().
void BoardStart(void);

/// \name Access to the controller, see CO_CAN_SPI
/// \{
void BoardSelect(void* ctx, bool selected);
void BoardTransfer(void* ctx, uint8_t* bytes, uint8_t num);
bool BoardHasInterrupt(void* ctx);
/// \}

/// \name Disable and enable the interrupts of the CPU; the calls do not nest
/// \{
void BoardDisableInterrupts(void* user);
void BoardEnableInterrupts(void* user);
/// \}

/// Waits until an interrupt has occurred, at most a millisecond. Returns false to end the program.
bool BoardWait(void);

/// Switches the LED of the board.
void BoardLed(bool on);

/// \name Interrupts, defined by main.c
/// \{
void TickInterrupt(void);  ///< each millisecond
void CanInterrupt(void);   ///< falling edge of INT
/// \}

#ifdef __cplusplus
}
#endif

#endif
