// SPDX-License-Identifier: Apache-2.0
// NUCLEO-G474RE: STM32G474RE, crystal of 24 MHz, LED LD2 at PA5. FDCAN1: PA11 (RX), PA12 (TX) at the connector CN10, to
// a transceiver for 3.3 V. Register addresses: RM0440, chapters 3 (flash), 6 (PWR), 7 (RCC), 9 (GPIO).
#include "board.h"

#include "co_can_fdcan.h"
#include "flash_stm32.h"

#define RCC_CR 0x40021000u
#define RCC_CFGR 0x40021008u
#define RCC_PLLCFGR 0x4002100Cu
#define RCC_AHB2ENR 0x4002104Cu
#define RCC_APB1ENR1 0x40021058u
#define RCC_CCIPR 0x40021088u
#define PWR_CR5 0x40007080u
#define FLASH_ACR 0x40022000u
#define GPIOA_MODER 0x48000000u
#define GPIOA_PUPDR 0x4800000Cu
#define GPIOA_BSRR 0x48000018u
#define GPIOA_AFRH 0x48000024u

#define CAN_HZ 24000000u
static const CO_CAN_FDCAN_RATE Rates[] = {
    CO_CAN_FDCAN_RATE_OF(CAN_HZ, 125000, 96), CO_CAN_FDCAN_RATE_OF(CAN_HZ, 250000, 96),
    CO_CAN_FDCAN_RATE_OF(CAN_HZ, 500000, 48), CO_CAN_FDCAN_RATE_OF(CAN_HZ, 1000000, 24)};

static CO_IF_FRM Frames[32];
static CO_CAN_FDCAN Can;

const uint32_t BoardHz = 170000000;
const CO_IF_CAN_DRV_EX* const BoardCan = &FdcanCanDriver;
void* const BoardCanContext = &Can;
const CO_IF_NVM_DRV_EX* const BoardMemory = &FlashPagesNvmDriver;
void* const BoardMemoryContext = (void*)&FlashStm32g4;

// 170 MHz from the crystal, in range 1 boost mode of the regulator [RM0440, 6.1.5]. The CAN controller has the clock of
// the crystal, 24 MHz, so that all its bit rates are exact.
static void StartClocks(void) {
  BoardChange(RCC_CR, 0, 1u << 16);
  BoardAwait(RCC_CR, 1u << 17);
  BoardChange(RCC_APB1ENR1, 0, 1u << 28);  // PWR
  (void)BOARD_REGISTER(RCC_APB1ENR1);      // the clock needs two cycles
  BoardChange(RCC_CFGR, 0xF0u, 8u << 4);   // AHB / 2 until 1 us after the switch of the clock
  BoardChange(PWR_CR5, 1u << 8, 0);        // R1MODE: boost mode, for more than 150 MHz
  BoardChange(FLASH_ACR, 0xFu, 4u);        // four wait states
  BoardAwait(FLASH_ACR, 4u);
  BOARD_REGISTER(RCC_PLLCFGR) = (1u << 24) | (85u << 8) | (5u << 4) | 3u;  // HSE / 6 x 85 / 2
  BoardChange(RCC_CR, 0, 1u << 24);
  BoardAwait(RCC_CR, 1u << 25);
  BoardChange(RCC_CFGR, 3u, 3u);
  BoardAwait(RCC_CFGR, 3u << 2);
  for (volatile unsigned n = 0; n < 100; n = n + 1) {
  }
  BoardChange(RCC_CFGR, 0xF0u, 0);
  BoardChange(RCC_CCIPR, 3u << 24, 0);  // FDCAN: HSE
}

static void StartPins(void) {
  BoardChange(RCC_AHB2ENR, 0, 1u);
  (void)BOARD_REGISTER(RCC_AHB2ENR);                  // the clock needs two cycles
  BoardChange(GPIOA_PUPDR, 3u << 22, 1u << 22);       // PA11: pull-up
  BoardChange(GPIOA_AFRH, 0xFFu << 12, 0x99u << 12);  // PA11, PA12: FDCAN1
  BoardChange(GPIOA_MODER, (3u << 10) | (0xFu << 22), (1u << 10) | (2u << 22) | (2u << 24));  // PA5: output
}

void BoardStart(void) {
  StartPins();  // BoardBlink() needs the LED
  StartClocks();
  BoardChange(RCC_APB1ENR1, 0, 1u << 25);
  (void)BOARD_REGISTER(RCC_APB1ENR1);
  Can.Registers = CO_CAN_FDCAN_1;
  Can.Ram = CO_CAN_FDCAN_RAM(0);
  Can.Rates = Rates;
  Can.RateNum = 4;
  Can.Frames = Frames;
  Can.FrameNum = 32;
  BoardEnableInterrupt(21);  // FDCAN1_IT0
}

void BoardLed(bool on) { BOARD_REGISTER(GPIOA_BSRR) = on ? 1u << 5 : 1u << 21; }

// A double word of the flash whose programming a loss of power has interrupted was read.
void NmiHandler(void) {
  if (!FlashStm32g4Nmi()) {
    Fault();
  }
}

void BoardCanInterrupt(void) { COCanFdcanInterrupt(&Can); }

bool BoardCanHasFrames(void) { return COCanFdcanHasFrames(&Can); }
