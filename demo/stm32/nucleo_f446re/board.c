// SPDX-License-Identifier: Apache-2.0
// NUCLEO-F446RE: STM32F446RE, clock of 8 MHz from the ST-LINK, LED LD2 at PA5. CAN1: PB8 (RX, D15), PB9 (TX, D14), to a
// transceiver for 3.3 V. Register addresses: RM0390, chapters 3 (flash), 6 (RCC), 7 (GPIO).
#include "board.h"

#include "co_can_bxcan.h"
#include "flash_stm32.h"

#define RCC_CR 0x40023800u
#define RCC_PLLCFGR 0x40023804u
#define RCC_CFGR 0x40023808u
#define RCC_AHB1ENR 0x40023830u
#define RCC_APB1ENR 0x40023840u
#define FLASH_ACR 0x40023C00u
#define GPIOA_MODER 0x40020000u
#define GPIOA_BSRR 0x40020018u
#define GPIOB_MODER 0x40020400u
#define GPIOB_PUPDR 0x4002040Cu
#define GPIOB_AFRH 0x40020424u

#define APB1_HZ 42000000u
static const CO_CAN_BXCAN_RATE Rates[] = {
    CO_CAN_BXCAN_RATE_OF(APB1_HZ, 125000, 14), CO_CAN_BXCAN_RATE_OF(APB1_HZ, 250000, 14),
    CO_CAN_BXCAN_RATE_OF(APB1_HZ, 500000, 14), CO_CAN_BXCAN_RATE_OF(APB1_HZ, 1000000, 14)};

static CO_IF_FRM Frames[32];
static CO_CAN_BXCAN Can = {
    .Registers = CO_CAN_BXCAN_1, .BankNum = 14, .Rates = Rates, .RateNum = 4, .Frames = Frames, .FrameNum = 32};

const uint32_t BoardHz = 168000000;
const CO_IF_CAN_DRV_EX* const BoardCan = &BxcanCanDriver;
void* const BoardCanContext = &Can;
const CO_IF_NVM_DRV_EX* const BoardMemory = &FlashPagesNvmDriver;
void* const BoardMemoryContext = (void*)&FlashStm32f4;

// 168 MHz from 8 MHz; APB1, and with it the CAN controllers, has 42 MHz.
static void StartClocks(void) {
  BoardChange(RCC_CR, 0, (1u << 16) | (1u << 18));  // HSE, bypass
  BoardAwait(RCC_CR, 1u << 17);
  BOARD_REGISTER(FLASH_ACR) = (7u << 8) | 5u;  // caches, prefetch, five wait states
  BOARD_REGISTER(RCC_PLLCFGR) = (2u << 28) | (7u << 24) | (1u << 22) | (168u << 6) | 4u;  // HSE / 4 x 168 / 2
  BoardChange(RCC_CR, 0, 1u << 24);
  BoardAwait(RCC_CR, 1u << 25);
  BoardChange(RCC_CFGR, 0xFC00u, (4u << 13) | (5u << 10));  // APB2: / 2, APB1: / 4
  BoardChange(RCC_CFGR, 3u, 2u);
  BoardAwait(RCC_CFGR, 2u << 2);
}

static void StartPins(void) {
  BoardChange(RCC_AHB1ENR, 0, 3u);
  (void)BOARD_REGISTER(RCC_AHB1ENR);             // the clock needs two cycles
  BoardChange(GPIOA_MODER, 3u << 10, 1u << 10);  // PA5: output
  BoardChange(GPIOB_PUPDR, 3u << 16, 1u << 16);  // PB8: pull-up
  BoardChange(GPIOB_AFRH, 0xFFu, 0x99u);         // PB8, PB9: CAN1
  BoardChange(GPIOB_MODER, 0xFu << 16, (2u << 16) | (2u << 18));
}

void BoardStart(void) {
  StartPins();  // BoardBlink() needs the LED
  StartClocks();
  BoardChange(RCC_APB1ENR, 0, 1u << 25);
  (void)BOARD_REGISTER(RCC_APB1ENR);
  BoardEnableInterrupt(19);  // CAN1_TX
  BoardEnableInterrupt(20);  // CAN1_RX0
  BoardEnableInterrupt(22);  // CAN1_SCE
}

void BoardLed(bool on) { BOARD_REGISTER(GPIOA_BSRR) = on ? 1u << 5 : 1u << 21; }

void BoardCanInterrupt(void) { COCanBxcanInterrupt(&Can); }

bool BoardCanHasFrames(void) { return COCanBxcanHasFrames(&Can); }
