// SPDX-License-Identifier: Apache-2.0
// Vector table and start-up code of a Cortex-M. The linker script (sections.ld) defines the symbols.
#include "board.h"

extern uint32_t StackTop[], DataBegin[], DataEnd[], DataSource[], BssBegin[], BssEnd[];

int main(void);
void Start(void);

void Start(void) {
  const uint32_t* source = DataSource;
  for (uint32_t* word = DataBegin; word != DataEnd; ++word) {
    *word = *source++;
  }
  for (uint32_t* word = BssBegin; word != BssEnd; ++word) {
    *word = 0;
  }
  (void)main();
}

void BoardLed(bool on) { BOARD_REGISTER(Board.LedAddress) = on ? Board.LedOn : Board.LedOff; }

static void Pause(uint32_t number) {
  for (volatile uint32_t n = 0; n < number; n = n + 1) {
  }
}

// Does not return. The CPU runs with its internal oscillator of 8 or 16 MHz.
static void Blink(void) {
  for (bool on = true;; on = !on) {
    BoardLed(on);
    Pause(100000u);
  }
}

static void Await(uint32_t address, uint32_t bits) {
  for (uint32_t n = 0; n < 200000u; ++n) {
    if ((BOARD_REGISTER(address) & bits) == bits) {
      return;
    }
  }
  Blink();
}

// A step takes more than 1 us: a clock that was enabled needs two cycles, the AHB of an STM32G4 needs 1 us.
void BoardStart(void) {
  for (uint32_t n = 0; n < Board.StepNum; ++n) {
    const BOARD_STEP step = Board.Steps[n];
    BOARD_REGISTER(step.Address) = (BOARD_REGISTER(step.Address) & ~step.Clear) | step.Set;
    Await(step.Address, step.Await);
    Pause(100u);
  }
  BOARD_REGISTER(0xE000E100u) = Board.Interrupts;
}

void Fault(void) {
  for (;;) {
  }
}

__attribute__((weak)) void NmiHandler(void) { Fault(); }

typedef void (*VECTOR)(void);

// Numbers of the interrupts in all three controllers: 19 CAN TX, 20 CAN RX0, 21 FDCAN1 line 0, 22 CAN SCE.
__attribute__((section(".vectors"), used)) static const VECTOR Vectors[16 + BOARD_INTERRUPTS] = {
    (VECTOR)(uintptr_t)StackTop,
    Start,
    NmiHandler,
    Fault,
    Fault,
    Fault,
    Fault,
    [11] = Fault,
    [14] = Fault,
    [15] = SysTickHandler,
    [16 + 19] = CanHandler,
    [16 + 20] = CanHandler,
    [16 + 21] = CanHandler,
    [16 + 22] = CanHandler,
};
