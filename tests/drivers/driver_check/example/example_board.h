// SPDX-License-Identifier: Apache-2.0
/// \file example_board.h
/// An imaginary microcontroller with typical peripherals. The drivers in this directory are the templates of
/// drivers/template, filled in for it; docs/porting.md explains them.
#ifndef EXAMPLE_BOARD_H_
#define EXAMPLE_BOARD_H_

#include "co_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A CAN controller with a receive FIFO of 3 frames and one transmit mailbox.
typedef struct EXAMPLE_CAN_T {
  volatile uint32_t Control;  ///< EXAMPLE_CAN_…
  volatile uint32_t BitTiming;
  volatile uint32_t Status;   ///< EXAMPLE_CAN_RECEIVED …
  volatile uint32_t Release;  ///< write 1: the frame was read, show the next one
  volatile uint32_t Clear;    ///< write bits of Status to clear them
  struct {
    volatile uint32_t Id;       ///< bit 31: 29-bit identifier, bit 30: remote frame
    volatile uint32_t Length;   ///< bytes, 0…15
    volatile uint32_t Data[2];  ///< first byte in bits 7…0
  } Receive;
  struct {
    volatile uint32_t Id;
    volatile uint32_t Length;
    volatile uint32_t Data[2];
    volatile uint32_t Request;  ///< write 1: send; reads 1 until the frame was sent, write 0: do not send it
  } Transmit;
} EXAMPLE_CAN;

#define EXAMPLE_CAN_ON 1u          ///< on the bus
#define EXAMPLE_CAN_INTERRUPTS 2u  ///< an interrupt while Status is not 0
#define EXAMPLE_CAN_RECEIVED 1u    ///< a frame is in the FIFO; the other bits are cleared by Clear
#define EXAMPLE_CAN_SENT 2u        ///< the mailbox has become free
#define EXAMPLE_CAN_LOST 4u        ///< a received frame was lost because the FIFO was full
#define EXAMPLE_CAN_BUS_OFF 8u     ///< the controller has gone into bus-off

/// A free running counter of 16 bits with a compare match.
typedef struct EXAMPLE_TIMER_T {
  volatile uint32_t Prescaler;  ///< CPU clock / ticks per second
  volatile uint32_t Counter;    ///< 0…FFFFh
  volatile uint32_t Compare;    ///< 0…FFFFh
  volatile uint32_t Enable;     ///< 1: interrupt while Match is 1
  volatile uint32_t Match;      ///< 1: Counter has been Compare; write 0: cleared, 1: raised by software
} EXAMPLE_TIMER;

/// A free running counter of 32 bits with a compare match; its registers are those of EXAMPLE_TIMER.
typedef struct EXAMPLE_COUNTER_T {
  volatile uint32_t Prescaler;
  volatile uint32_t Counter;
  volatile uint32_t Compare;
  volatile uint32_t Enable;
  volatile uint32_t Match;
} EXAMPLE_COUNTER;

#define EXAMPLE_CLOCK 48000000u  ///< Hz

/// Register blocks, at their addresses.
extern EXAMPLE_CAN ExampleCan;
extern EXAMPLE_TIMER ExampleTimer;

/// An EEPROM on a bus, with pages of 32 bytes: a write beyond the end of a page continues at its beginning.
#define EXAMPLE_EEPROM_SIZE 2048u
#define EXAMPLE_EEPROM_PAGE 32u
bool ExampleEepromRead(uint32_t address, uint8_t* to, uint32_t size);
bool ExampleEepromWrite(uint32_t address, const uint8_t* from, uint32_t size);  ///< returns when the data are stored

/// The drivers.
extern const CO_IF_CAN_DRV ExampleCanDriver;
extern const CO_IF_TIMER_DRV ExampleTimerDriver;
extern const CO_IF_NVM_DRV ExampleNvmDriver;

extern const CO_IF_TIMER_DRV_EX ExampleClockDriver;  ///< its context is an EXAMPLE_COUNTER

/// Interrupt functions of the drivers. The timers' functions must be called before COTmrService().
void ExampleCanInterrupt(void);
void ExampleTimerInterrupt(void);
void ExampleClockInterrupt(EXAMPLE_COUNTER* counter);

/// Reports the events that the interrupt has stored to the node. To be called in the loop.
void ExampleCanReport(CO_NODE* node);
/// Returns true if there is a frame to read or an event to report. To be called in the loop.
bool ExampleCanHasWork(void);

#ifdef __cplusplus
}
#endif

#endif
