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

static const BOARD_STEP Steps[] = {
    {RCC_AHB1ENR, 0, 3u, 0},
    {GPIOA_MODER, 3u << 10, 1u << 10, 0},  // PA5: output
    {GPIOB_PUPDR, 3u << 16, 1u << 16, 0},  // PB8: pull-up
    {GPIOB_AFRH, 0xFFu, 0x99u, 0},         // PB8, PB9: CAN1
    {GPIOB_MODER, 0xFu << 16, (2u << 16) | (2u << 18), 0},
    // 168 MHz from 8 MHz; APB1, and with it the CAN controllers, has 42 MHz.
    {RCC_CR, 0, (1u << 16) | (1u << 18), 1u << 17},  // HSE, bypass
    {FLASH_ACR, ~0u, (7u << 8) | 5u, 0},             // caches, prefetch, five wait states
    {RCC_PLLCFGR, ~0u, (2u << 28) | (7u << 24) | (1u << 22) | (168u << 6) | 4u, 0},  // HSE / 4 x 168 / 2
    {RCC_CR, 0, 1u << 24, 1u << 25},
    {RCC_CFGR, 0xFC00u, (4u << 13) | (5u << 10), 0},  // APB2: / 2, APB1: / 4
    {RCC_CFGR, 3u, 2u, 2u << 2},
    {RCC_APB1ENR, 0, 1u << 25, 0}};

const BOARD Board = {.Hz = 168000000,
                     .Steps = Steps,
                     .StepNum = sizeof(Steps) / sizeof(Steps[0]),
                     .LedAddress = GPIOA_BSRR,
                     .LedOn = 1u << 5,
                     .LedOff = 1u << 21,
                     .Interrupts = (1u << 19) | (1u << 20) | (1u << 22),  // CAN1: TX, RX0, SCE
                     .Can = &BxcanCanDriver,
                     .CanContext = &Can,
                     .Memory = &FlashPagesNvmDriver,
                     .MemoryContext = (void*)&FlashStm32f4};

void BoardCanInterrupt(void) { COCanBxcanInterrupt(&Can); }

bool BoardCanHasFrames(void) { return COCanBxcanHasFrames(&Can); }
