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
static CO_CAN_FDCAN Can = {.Registers = CO_CAN_FDCAN_1,
                           .Ram = CO_CAN_FDCAN_RAM(0),
                           .Rates = Rates,
                           .RateNum = 4,
                           .Frames = Frames,
                           .FrameNum = 32};

static const BOARD_STEP Steps[] = {
    {RCC_AHB2ENR, 0, 1u, 0},
    {GPIOA_PUPDR, 3u << 22, 1u << 22, 0},                                               // PA11: pull-up
    {GPIOA_AFRH, 0xFFu << 12, 0x99u << 12, 0},                                          // PA11, PA12: FDCAN1
    {GPIOA_MODER, (3u << 10) | (0xFu << 22), (1u << 10) | (2u << 22) | (2u << 24), 0},  // PA5: output
    // 170 MHz from the crystal, in range 1 boost mode of the regulator [RM0440, 6.1.5]. The CAN controller has the
    // clock of the crystal, 24 MHz, so that all its bit rates are exact.
    {RCC_CR, 0, 1u << 16, 1u << 17},
    {RCC_APB1ENR1, 0, 1u << 28, 0},  // PWR
    {RCC_CFGR, 0xF0u, 8u << 4, 0},   // AHB / 2 until 1 us after the switch of the clock
    {PWR_CR5, 1u << 8, 0, 0},        // R1MODE: boost mode, for more than 150 MHz
    {FLASH_ACR, 0xFu, 4u, 4u},       // four wait states
    {RCC_PLLCFGR, ~0u, (1u << 24) | (85u << 8) | (5u << 4) | 3u, 0},  // HSE / 6 x 85 / 2
    {RCC_CR, 0, 1u << 24, 1u << 25},
    {RCC_CFGR, 3u, 3u, 3u << 2},
    {RCC_CFGR, 0xF0u, 0, 0},
    {RCC_CCIPR, 3u << 24, 0, 0},  // FDCAN: HSE
    {RCC_APB1ENR1, 0, 1u << 25, 0}};

const BOARD Board = {.Hz = 170000000,
                     .Steps = Steps,
                     .StepNum = sizeof(Steps) / sizeof(Steps[0]),
                     .LedAddress = GPIOA_BSRR,
                     .LedOn = 1u << 5,
                     .LedOff = 1u << 21,
                     .Interrupts = 1u << 21,  // FDCAN1_IT0
                     .Can = &FdcanCanDriver,
                     .CanContext = &Can,
                     .Memory = &FlashPagesNvmDriver,
                     .MemoryContext = (void*)&FlashStm32g4};

// A double word of the flash whose programming a loss of power has interrupted was read.
void NmiHandler(void) {
  if (!FlashStm32g4Nmi()) {
    Fault();
  }
}

void BoardCanInterrupt(void) { COCanFdcanInterrupt(&Can); }

bool BoardCanHasFrames(void) { return COCanFdcanHasFrames(&Can); }
