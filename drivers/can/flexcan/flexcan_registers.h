// SPDX-License-Identifier: Apache-2.0
/// \file flexcan_registers.h
/// Registers and message buffers of FlexCAN, the CAN controller of NXP's i.MX 6, 8 and RT, S32K and Kinetis.
///
/// Sources: K20 sub-family reference manual (MK20DX256), chapter 45, "CAN (FlexCAN)"; MWCT101xS (S32K1) and KE1xF
/// reference manuals, chapter "FlexCAN"; the register header of the i.MX 8M Plus (NXP; names, offsets, bits and their
/// one-line descriptions). The layout is the same in all of them; devices differ in the number of message buffers and
/// in the registers from CBT and RXIMR on that are named "only" below.
#ifndef FLEXCAN_REGISTERS_H_
#define FLEXCAN_REGISTERS_H_

#include <assert.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal

/// Message buffer of 8 data bytes. [K20, 45.3: Message buffer structure]
typedef struct CO_FLEXCAN_MAILBOX_T {
  volatile uint32_t Control;     ///< code, SRR, IDE, RTR, DLC, time stamp
  volatile uint32_t Identifier;  ///< 29-bit identifier in bits 0…28, 11-bit one in bits 18…28
  volatile uint32_t Data[2];     ///< bytes 0…3 and 4…7; the first byte is in the highest bits
} CO_FLEXCAN_MAILBOX;

/// A controller.
typedef struct CO_FLEXCAN_REGISTERS_T {
  volatile uint32_t Mcr;    ///< module configuration
  volatile uint32_t Ctrl1;  ///< control 1
  volatile uint32_t Timer;  ///< free running timer, bit times; a read unlocks the locked message buffer
  uint32_t Reserved0;
  volatile uint32_t Rxmgmask;
  volatile uint32_t Rx14mask;
  volatile uint32_t Rx15mask;
  volatile uint32_t Ecr;   ///< error counters
  volatile uint32_t Esr1;  ///< error and status 1
  volatile uint32_t Imask2;
  volatile uint32_t Imask1;  ///< interrupt masks of message buffers 0…31
  volatile uint32_t Iflag2;
  volatile uint32_t Iflag1;  ///< interrupt flags of message buffers 0…31; cleared by writing 1
  volatile uint32_t Ctrl2;   ///< control 2
  volatile uint32_t Esr2;
  uint32_t Reserved1[2];
  volatile uint32_t Crcr;
  volatile uint32_t Rxfgmask;  ///< mask of the FIFO filters that have no RXIMR
  volatile uint32_t Rxfir;
  volatile uint32_t Cbt;  ///< bit timing; controllers for CAN FD only
  uint32_t Reserved2[11];
  CO_FLEXCAN_MAILBOX Mailbox[128];  ///< 16…128, by device
  volatile uint32_t Rximr[128];     ///< individual masks; written in freeze mode
  uint32_t Reserved3[24];
  volatile uint32_t Mecr;  ///< memory error control; controllers with ECC only
  uint32_t Reserved4[6];
  volatile uint32_t Errsr;  ///< memory errors; cleared by writing 1
} CO_FLEXCAN_REGISTERS;

static_assert(offsetof(CO_FLEXCAN_REGISTERS, Mcr) == 0x00, "MCR");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Ctrl1) == 0x04, "CTRL1");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Timer) == 0x08, "TIMER");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Rxmgmask) == 0x10, "RXMGMASK");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Ecr) == 0x1C, "ECR");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Esr1) == 0x20, "ESR1");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Imask1) == 0x28, "IMASK1");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Iflag1) == 0x30, "IFLAG1");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Ctrl2) == 0x34, "CTRL2");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Crcr) == 0x44, "CRCR");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Rxfgmask) == 0x48, "RXFGMASK");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Rxfir) == 0x4C, "RXFIR");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Cbt) == 0x50, "CBT");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Mailbox) == 0x80, "MB0");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Rximr) == 0x880, "RXIMR0");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Mecr) == 0xAE0, "MECR");
static_assert(offsetof(CO_FLEXCAN_REGISTERS, Errsr) == 0xAFC, "ERRSR");

/// \name MCR [header of i.MX 8M Plus; K20, 45.4.10.1: Freeze mode]
/// Bits other than MDIS, FRZ, HALT and SOFTRST are written in freeze mode.
/// \{
#define CO_FLEXCAN_MCR_MDIS (1u << 31)     ///< module disable
#define CO_FLEXCAN_MCR_FRZ (1u << 30)      ///< enables freeze mode, by HALT and by a debugger
#define CO_FLEXCAN_MCR_RFEN (1u << 29)     ///< receive FIFO
#define CO_FLEXCAN_MCR_HALT (1u << 28)     ///< requests freeze mode
#define CO_FLEXCAN_MCR_SOFTRST (1u << 25)  ///< soft reset, to freeze mode; cleared by the controller
#define CO_FLEXCAN_MCR_FRZACK (1u << 24)   ///< in freeze mode
#define CO_FLEXCAN_MCR_LPMACK (1u << 20)   ///< in a low-power mode: disabled
#define CO_FLEXCAN_MCR_SRXDIS (1u << 17)   ///< no reception of own frames
#define CO_FLEXCAN_MCR_IRMQ (1u << 16)     ///< individual masks, queue of message buffers
#define CO_FLEXCAN_MCR_AEN (1u << 12)      ///< transmissions can be aborted
#define CO_FLEXCAN_MCR_REJECT (3u << 8)    ///< IDAM: format D, the FIFO receives no frame; 0: format A
/// \}

/// \name CTRL1 [header of i.MX 8M Plus]
/// Bits 24…31 prescaler - 1, 22…23 jump width - 1, 19…21 phase segment 1 - 1, 16…18 phase segment 2 - 1, 0…2
/// propagation segment - 1. The bit timing is written in freeze mode.
/// \{
#define CO_FLEXCAN_CTRL1_BOFFMSK (1u << 15)  ///< interrupt at bus-off
#define CO_FLEXCAN_CTRL1_CLKSRC (1u << 13)   ///< clock: 0: oscillator, 1: bus; written while disabled
#define CO_FLEXCAN_CTRL1_LPB (1u << 12)      ///< loopback
#define CO_FLEXCAN_CTRL1_BOFFREC (1u << 6)   ///< no recovery from bus-off while set
/// \}

/// \name ECR [header of i.MX 8M Plus]
/// \{
#define CO_FLEXCAN_ECR_TEC(ecr) ((uint8_t)(ecr))
#define CO_FLEXCAN_ECR_REC(ecr) ((uint8_t)((ecr) >> 8))
/// \}

/// \name ESR1 [header of i.MX 8M Plus]
/// \{
#define CO_FLEXCAN_ESR1_IDLE (1u << 7)     ///< the bus is idle
#define CO_FLEXCAN_ESR1_PASSIVE (1u << 4)  ///< FLTCONF: error passive
#define CO_FLEXCAN_ESR1_BUS_OFF (1u << 5)  ///< FLTCONF: bus-off, with either value of the lower bit
#define CO_FLEXCAN_ESR1_RX (1u << 3)       ///< receives a frame
#define CO_FLEXCAN_ESR1_BOFFINT (1u << 2)  ///< has entered bus-off; cleared by writing 1
/// \}

/// \name IFLAG1 with the receive FIFO [K20, 45.4.7: Rx FIFO]
/// \{
#define CO_FLEXCAN_IFLAG_FRAME (1u << 5)     ///< BUF5I: a frame is in the FIFO; writing 1 releases it
#define CO_FLEXCAN_IFLAG_OVERFLOW (1u << 7)  ///< BUF7I: a frame was lost
/// \}

/// \name CTRL2 [header of i.MX 8M Plus]
/// \{
#define CO_FLEXCAN_CTRL2_ECRWRE (1u << 29)   ///< enables writes of MECR.ECRWRDIS; controllers with ECC only
#define CO_FLEXCAN_CTRL2_WRMFRZ (1u << 28)   ///< enables writes of all memory in freeze mode; with ECC only
#define CO_FLEXCAN_CTRL2_RFFN_SHIFT 24       ///< 8 * (RFFN + 1) FIFO filters
#define CO_FLEXCAN_CTRL2_TASD (0x16u << 19)  ///< start of the transmit arbitration: the value after a reset
#define CO_FLEXCAN_CTRL2_RRS (1u << 17)      ///< remote frames are received, not answered
#define CO_FLEXCAN_CTRL2_EACEN (1u << 16)    ///< masks of message buffers apply to IDE and RTR, too
#define CO_FLEXCAN_CTRL2_PREXCEN (1u << 14)  ///< protocol exception: ignores CAN FD frames; for CAN FD only
/// \}

/// \name CBT [header of i.MX 8M Plus]
/// Bits 21…30 prescaler - 1, 16…19 jump width - 1, 10…15 propagation segment - 1, 5…9 phase segment 1 - 1, 0…4 phase
/// segment 2 - 1.
/// \{
#define CO_FLEXCAN_CBT_BTF (1u << 31)  ///< 1: the bit timing is that of CBT, 0: of CTRL1
/// \}

/// \name MECR, ERRSR [header of i.MX 8M Plus]
/// \{
#define CO_FLEXCAN_MECR_ECRWRDIS (1u << 31)  ///< write protection of MECR
#define CO_FLEXCAN_MECR_NCEFAFRZ (1u << 7)   ///< freeze mode after an error that cannot be corrected
#define CO_FLEXCAN_ERRSR_ALL 0x000D000Du     ///< all flags
/// \}

/// \name Message buffers [K20, 45.3, tables 45-70 and 45-71; Control and Identifier words]
/// \{
#define CO_FLEXCAN_CODE_SHIFT 24
#define CO_FLEXCAN_CODE (0xFu << CO_FLEXCAN_CODE_SHIFT)
#define CO_FLEXCAN_RX_INACTIVE (0x0u << CO_FLEXCAN_CODE_SHIFT)
#define CO_FLEXCAN_RX_EMPTY (0x4u << CO_FLEXCAN_CODE_SHIFT)
#define CO_FLEXCAN_RX_OVERRUN (0x6u << CO_FLEXCAN_CODE_SHIFT)
#define CO_FLEXCAN_RX_BUSY (0x1u << CO_FLEXCAN_CODE_SHIFT)  ///< the controller is writing the buffer
#define CO_FLEXCAN_TX_INACTIVE (0x8u << CO_FLEXCAN_CODE_SHIFT)
#define CO_FLEXCAN_TX_ABORT (0x9u << CO_FLEXCAN_CODE_SHIFT)
#define CO_FLEXCAN_TX_DATA (0xCu << CO_FLEXCAN_CODE_SHIFT)  ///< transmission requested
#define CO_FLEXCAN_SRR (1u << 22)
#define CO_FLEXCAN_IDE (1u << 21)
#define CO_FLEXCAN_RTR (1u << 20)
#define CO_FLEXCAN_DLC_SHIFT 16
#define CO_FLEXCAN_DLC 0xFu
#define CO_FLEXCAN_STID_SHIFT 18
/// \}

/// \name Receive FIFO [K20, 45.3: Rx FIFO structure; table of CTRL2.RFFN]
/// Message buffer 0 is the output of the FIFO. Filters begin in message buffer 6, in words of format A: RTR, IDE, and
/// a 29-bit identifier in bits 1…29 or an 11-bit one in bits 19…29. With 8 * (RFFN + 1) filters, message buffers
/// 0…(7 + 2 * RFFN) belong to the FIFO, and as many filters have an RXIMR (32 at most).
/// \{
#define CO_FLEXCAN_FIFO_FILTERS 6u  ///< first message buffer of the filters
#define CO_FLEXCAN_FIFO_IDE (1u << 30)
#define CO_FLEXCAN_FIFO_EXID_SHIFT 1
#define CO_FLEXCAN_FIFO_STID_SHIFT 19
/// \}

/// \name Memory with ECC, byte offsets [features of the i.MX 8M Plus and S32K in NXP's SDK: INIT_MEMORY_BASE]
/// \{
#define CO_FLEXCAN_MEMORY_FIRST 0x80u  ///< message buffers, RXIMR and internal buffers
#define CO_FLEXCAN_MEMORY_END 0xAE0u
/// \}
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
