// SPDX-License-Identifier: Apache-2.0
// Registers: i.MX 6Dual/6Quad reference manual (memory map, interrupts); Cortex-A9 MPCore technical reference manual
// (global timer, interrupt controller).
#include "board.h"

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define BYTE(address) (*(volatile uint8_t*)(address))

#define CPU_INTERFACE 0x00A00100u
#define GLOBAL_TIMER 0x00A00200u
#define DISTRIBUTOR 0x00A01000u

#define CAN1_INTERRUPT 142u
#define CAN2_INTERRUPT 143u

// The clock of the global timer is half of the CPU's. QEMU's is fixed.
#define GLOBAL_TIMER_MHZ 100u

// Clock of the protocol engine of FlexCAN: PLL3 / 8 / 2, as after a reset
#define CAN_HZ 30000000u
static const CO_CAN_FLEXCAN_RATE Rates[] = {
    CO_CAN_FLEXCAN_RATE_OF(CAN_HZ, 125000, 16), CO_CAN_FLEXCAN_RATE_OF(CAN_HZ, 250000, 15),
    CO_CAN_FLEXCAN_RATE_OF(CAN_HZ, 500000, 15), CO_CAN_FLEXCAN_RATE_OF(CAN_HZ, 1000000, 15)};

static CO_IF_FRM Frames[2][256];
CO_CAN_FLEXCAN BoardCan[2] = {{.Registers = CO_CAN_FLEXCAN_IMX6_1,
                               .MailboxNum = 64,
                               .Rates = Rates,
                               .RateNum = 4,
                               .Frames = Frames[0],
                               .FrameNum = 256},
                              {.Registers = CO_CAN_FLEXCAN_IMX6_2,
                               .MailboxNum = 64,
                               .Rates = Rates,
                               .RateNum = 4,
                               .Frames = Frames[1],
                               .FrameNum = 256,
                               .Receive = CO_CAN_FLEXCAN_MAILBOXES}};

uint32_t AskHost(uint32_t operation, const void* argument);
void BoardInterrupt(void);

// Translation table with sections of 1 MB: each address is mapped to itself. Without it all memory is of the type
// Device, where accesses must be aligned, which memcpy() of the C library does not respect.
static uint32_t Sections[4096] __attribute__((aligned(16384)));

static void EnableMmu(void) {
  const uint32_t device = 0xC06;   // section, read and write, shareable device
  const uint32_t memory = 0x1C02;  // section, read and write, normal memory without cache
  for (uint32_t n = 0; n < 4096; ++n) {
    const bool is_ram = n >= 0x100 && n < 0x500;
    Sections[n] = (n << 20) | (is_ram ? memory : device);
  }
  uint32_t control;
  __asm volatile("mcr p15, 0, %0, c2, c0, 0" : : "r"(Sections));     // TTBR0
  __asm volatile("mcr p15, 0, %0, c3, c0, 0" : : "r"(0xFFFFFFFFu));  // all domains are managers
  __asm volatile("mcr p15, 0, %0, c8, c7, 0" : : "r"(0));            // invalidates the TLB
  __asm volatile("dsb\n\tisb\n\tmrc p15, 0, %0, c1, c0, 0" : "=r"(control));
  __asm volatile("mcr p15, 0, %0, c1, c0, 0\n\tisb" : : "r"(control | 1u) : "memory");
}

static void EnableInterrupt(uint32_t number) {
  BYTE(DISTRIBUTOR + 0x400u + number) = 0x80;  // priority
  BYTE(DISTRIBUTOR + 0x800u + number) = 1;     // CPU 0
  REGISTER(DISTRIBUTOR + 0x100u + 4u * (number / 32u)) = 1u << number % 32u;
}

void BoardStart(void) {
  EnableMmu();
  REGISTER(GLOBAL_TIMER + 8u) = 1;
  REGISTER(DISTRIBUTOR) = 3;
  REGISTER(CPU_INTERFACE + 4u) = 0xF8;
  REGISTER(CPU_INTERFACE) = 3;
  EnableInterrupt(CAN1_INTERRUPT);
  EnableInterrupt(CAN2_INTERRUPT);
  __asm volatile("cpsie i" ::: "memory");
}

void BoardInterrupt(void) {
  const uint32_t acknowledged = REGISTER(CPU_INTERFACE + 0x0Cu);
  const uint32_t number = acknowledged & 0x3FFu;
  if (number == CAN1_INTERRUPT || number == CAN2_INTERRUPT) {
    COCanFlexcanInterrupt(&BoardCan[number - CAN1_INTERRUPT]);
  }
  REGISTER(CPU_INTERFACE + 0x10u) = acknowledged;
}

uint32_t BoardMicroseconds(void) {
  uint32_t low;
  uint32_t high;
  do {
    high = REGISTER(GLOBAL_TIMER + 4u);
    low = REGISTER(GLOBAL_TIMER);
  } while (high != REGISTER(GLOBAL_TIMER + 4u));
  return (uint32_t)((((uint64_t)high << 32) | low) / GLOBAL_TIMER_MHZ);
}

static void TimerInit(void* ctx, uint32_t freq) {
  CO_UNUSED(ctx);
  CO_UNUSED(freq);
}
static uint32_t TimerNow(void* ctx) {
  CO_UNUSED(ctx);
  return BoardMicroseconds();
}
const CO_IF_TIMER_DRV_EX BoardTimer = {TimerInit, TimerNow, NULL};

void BoardPrint(const char* text) { (void)AskHost(0x04, text); }

void BoardPrintNumber(uint32_t number) {
  char digits[11] = {0};
  char* first = digits + 10;
  do {
    *--first = (char)('0' + number % 10u);
    number /= 10u;
  } while (number != 0);
  BoardPrint(first);
}
