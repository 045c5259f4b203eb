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

static const BOARD_STEP Steps[] = {
    {RCC_APB2ENR, 0, (1u << 0) | (1u << 3) | (1u << 4), 0},  // AFIO, GPIOB, GPIOC
    {AFIO_MAPR, 3u << 13, 2u << 13, 0},                      // CAN at PB8 and PB9
    {GPIOB_BSRR, 0, 1u << 8, 0},                             // pull-up, not pull-down
    {GPIOB_CRH, 0xFFu, 0xB8u, 0},                            // PB8: input, PB9: alternate function
    {GPIOC_CRH, 0xF00000u, 0x200000u, 0},
    // 72 MHz from the crystal; APB1, and with it the CAN controller, has 36 MHz.
    {RCC_CR, 0, 1u << 16, 1u << 17},
    {FLASH_ACR, 7u, 2u, 0},                                         // two wait states
    {RCC_CFGR, 0x3D0700u, (7u << 18) | (1u << 16) | (4u << 8), 0},  // PLL: HSE x 9; APB1: / 2
    {RCC_CR, 0, 1u << 24, 1u << 25},
    {RCC_CFGR, 3u, 2u, 2u << 2},
    {RCC_APB1ENR, 0, 1u << 25, 0}};

const BOARD Board = {.Hz = 72000000,
                     .Steps = Steps,
                     .StepNum = sizeof(Steps) / sizeof(Steps[0]),
                     .LedAddress = GPIOC_BSRR,
                     .LedOn = 1u << 29,
                     .LedOff = 1u << 13,
                     .Interrupts = (1u << 19) | (1u << 20) | (1u << 22),  // CAN1: TX, RX0, SCE
                     .Can = &BxcanCanDriver,
                     .CanContext = &Can};

void BoardCanInterrupt(void) { COCanBxcanInterrupt(&Can); }

bool BoardCanHasFrames(void) { return COCanBxcanHasFrames(&Can); }
