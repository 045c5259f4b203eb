// SPDX-License-Identifier: Apache-2.0
// Blue Pill: STM32F103C8, crystal of 8 MHz, LED at PC13 (on: low). CAN: PB8 (RX), PB9 (TX), to a transceiver for 3.3 V.
// Register addresses: RM0008, chapters 3, 7 (RCC), 9 (GPIO, AFIO).
#include "board.h"

#include "co_can_bxcan.h"

#define RCC_CR 0x40021000u
#define RCC_CFGR 0x40021004u
#define RCC_APB2ENR 0x40021018u
#define RCC_APB1ENR 0x4002101Cu
#define FLASH_ACR 0x40022000u
#define AFIO_MAPR 0x40010004u
#define GPIOB_CRH 0x40010C04u
#define GPIOB_BSRR 0x40010C10u
#define GPIOC_CRH 0x40011004u
#define GPIOC_BSRR 0x40011010u

#define APB1_HZ 36000000u
static const CO_CAN_BXCAN_RATE Rates[] = {
    CO_CAN_BXCAN_RATE_OF(APB1_HZ, 125000, 18), CO_CAN_BXCAN_RATE_OF(APB1_HZ, 250000, 18),
    CO_CAN_BXCAN_RATE_OF(APB1_HZ, 500000, 18), CO_CAN_BXCAN_RATE_OF(APB1_HZ, 1000000, 18)};

static CO_IF_FRM Frames[32];
static CO_CAN_BXCAN Can = {
    .Registers = CO_CAN_BXCAN_1, .BankNum = 14, .Rates = Rates, .RateNum = 4, .Frames = Frames, .FrameNum = 32};

const uint32_t BoardHz = 72000000;
const CO_IF_CAN_DRV_EX* const BoardCan = &BxcanCanDriver;
void* const BoardCanContext = &Can;
const CO_IF_NVM_DRV_EX* const BoardMemory = NULL;
void* const BoardMemoryContext = NULL;

// 72 MHz from the crystal; APB1, and with it the CAN controller, has 36 MHz.
static void StartClocks(void) {
  BoardChange(RCC_CR, 0, 1u << 16);
  BoardAwait(RCC_CR, 1u << 17);
  BoardChange(FLASH_ACR, 7u, 2u);                                         // two wait states
  BoardChange(RCC_CFGR, 0x3D0700u, (7u << 18) | (1u << 16) | (4u << 8));  // PLL: HSE x 9; APB1: / 2
  BoardChange(RCC_CR, 0, 1u << 24);
  BoardAwait(RCC_CR, 1u << 25);
  BoardChange(RCC_CFGR, 3u, 2u);
  BoardAwait(RCC_CFGR, 2u << 2);
}

static void StartPins(void) {
  BoardChange(RCC_APB2ENR, 0, (1u << 0) | (1u << 3) | (1u << 4));  // AFIO, GPIOB, GPIOC
  BoardChange(AFIO_MAPR, 3u << 13, 2u << 13);                      // CAN at PB8 and PB9
  BOARD_REGISTER(GPIOB_BSRR) = 1u << 8;                            // pull-up, not pull-down
  BoardChange(GPIOB_CRH, 0xFFu, 0xB8u);                            // PB8: input, PB9: alternate function
  BoardChange(GPIOC_CRH, 0xF00000u, 0x200000u);
}

void BoardStart(void) {
  StartPins();  // BoardBlink() needs the LED
  StartClocks();
  BoardChange(RCC_APB1ENR, 0, 1u << 25);
  BoardEnableInterrupt(19);  // CAN1_TX
  BoardEnableInterrupt(20);  // CAN1_RX0
  BoardEnableInterrupt(22);  // CAN1_SCE
}

void BoardLed(bool on) { BOARD_REGISTER(GPIOC_BSRR) = on ? 1u << 29 : 1u << 13; }

void BoardCanInterrupt(void) { COCanBxcanInterrupt(&Can); }

bool BoardCanHasFrames(void) { return COCanBxcanHasFrames(&Can); }
