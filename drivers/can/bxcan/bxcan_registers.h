// SPDX-License-Identifier: Apache-2.0
/// \file bxcan_registers.h
/// Registers of bxCAN, the CAN controller of STM32 F0, F1, F2, F3, F4, F7 and L4.
///
/// Sources: reference manuals RM0008 (STM32F10x), chapter 24, and RM0090 (STM32F4), chapter 32, "CAN registers"; the
/// register order was compared with the register header of the STM32F446 (CMSIS device header). The layout is the same
/// in all these families.
#ifndef BXCAN_REGISTERS_H_
#define BXCAN_REGISTERS_H_

#include <assert.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal

/// Transmit mailbox (TIxR, TDTxR, TDLxR, TDHxR) or output mailbox of a receive FIFO (RIxR, RDTxR, RDLxR, RDHxR).
typedef struct CO_BXCAN_MAILBOX_T {
  volatile uint32_t Identifier;
  volatile uint32_t Length;
  volatile uint32_t DataLow;   ///< bytes 0…3; byte 0 is in the lowest bits
  volatile uint32_t DataHigh;  ///< bytes 4…7
} CO_BXCAN_MAILBOX;

/// Filter bank (FiR1, FiR2). In mask mode of 16 bits each word is a filter: identifier in the lower half, mask in the
/// upper half.
typedef struct CO_BXCAN_BANK_T {
  volatile uint32_t First;
  volatile uint32_t Second;
} CO_BXCAN_BANK;

/// A controller. The filter registers, from Fmr on, exist in CAN1 (CAN3, CAN) only; CAN2 uses those of CAN1.
typedef struct CO_BXCAN_REGISTERS_T {
  volatile uint32_t Mcr;   ///< master control
  volatile uint32_t Msr;   ///< master status
  volatile uint32_t Tsr;   ///< transmit status
  volatile uint32_t Rf0r;  ///< receive FIFO 0
  volatile uint32_t Rf1r;  ///< receive FIFO 1
  volatile uint32_t Ier;   ///< interrupt enable
  volatile uint32_t Esr;   ///< error status
  volatile uint32_t Btr;   ///< bit timing
  uint32_t Reserved0[88];
  CO_BXCAN_MAILBOX Transmit[3];
  CO_BXCAN_MAILBOX Receive[2];
  uint32_t Reserved1[12];
  volatile uint32_t Fmr;   ///< filter master
  volatile uint32_t Fm1r;  ///< filter mode: 0: mask
  uint32_t Reserved2;
  volatile uint32_t Fs1r;  ///< filter scale: 0: two filters of 16 bits
  uint32_t Reserved3;
  volatile uint32_t Ffa1r;  ///< filter FIFO assignment
  uint32_t Reserved4;
  volatile uint32_t Fa1r;  ///< filter activation
  uint32_t Reserved5[8];
  CO_BXCAN_BANK Bank[28];  ///< 14 in devices with one controller, and in CAN3
} CO_BXCAN_REGISTERS;

static_assert(offsetof(CO_BXCAN_REGISTERS, Mcr) == 0x000, "MCR");
static_assert(offsetof(CO_BXCAN_REGISTERS, Msr) == 0x004, "MSR");
static_assert(offsetof(CO_BXCAN_REGISTERS, Tsr) == 0x008, "TSR");
static_assert(offsetof(CO_BXCAN_REGISTERS, Rf0r) == 0x00C, "RF0R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Rf1r) == 0x010, "RF1R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Ier) == 0x014, "IER");
static_assert(offsetof(CO_BXCAN_REGISTERS, Esr) == 0x018, "ESR");
static_assert(offsetof(CO_BXCAN_REGISTERS, Btr) == 0x01C, "BTR");
static_assert(offsetof(CO_BXCAN_REGISTERS, Transmit) == 0x180, "TI0R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Receive) == 0x1B0, "RI0R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Fmr) == 0x200, "FMR");
static_assert(offsetof(CO_BXCAN_REGISTERS, Fm1r) == 0x204, "FM1R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Fs1r) == 0x20C, "FS1R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Ffa1r) == 0x214, "FFA1R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Fa1r) == 0x21C, "FA1R");
static_assert(offsetof(CO_BXCAN_REGISTERS, Bank) == 0x240, "F0R1");
static_assert(sizeof(CO_BXCAN_REGISTERS) == 0x320, "F27R2");

/// \name MCR [RM0090, 32.9.2: CAN master control register]
/// \{
#define CO_BXCAN_MCR_INRQ (1u << 0)     ///< request of the initialisation mode
#define CO_BXCAN_MCR_SLEEP (1u << 1)    ///< request of the sleep mode; set after a reset
#define CO_BXCAN_MCR_TXFP (1u << 2)     ///< 0: the lowest identifier is sent first; 1: the oldest request
#define CO_BXCAN_MCR_RFLM (1u << 3)     ///< a full receive FIFO discards new frames, 0: overwrites the last one
#define CO_BXCAN_MCR_NART (1u << 4)     ///< no automatic retransmission
#define CO_BXCAN_MCR_AWUM (1u << 5)     ///< automatic wake-up
#define CO_BXCAN_MCR_ABOM (1u << 6)     ///< automatic bus-off management
#define CO_BXCAN_MCR_TTCM (1u << 7)     ///< time triggered communication
#define CO_BXCAN_MCR_RESET (1u << 15)   ///< master reset, to sleep mode
#define CO_BXCAN_MCR_FREEZE (1u << 16)  ///< DBF: stops while a debugger stops the CPU; set after a reset
/// \}

/// \name MSR [RM0090, 32.9.2: CAN master status register]
/// \{
#define CO_BXCAN_MSR_INAK (1u << 0)  ///< in initialisation mode
#define CO_BXCAN_MSR_SLAK (1u << 1)  ///< in sleep mode
#define CO_BXCAN_MSR_ERRI (1u << 2)  ///< error interrupt; cleared by writing 1
#define CO_BXCAN_MSR_TXM (1u << 8)   ///< transmitter now
#define CO_BXCAN_MSR_RXM (1u << 9)   ///< receiver now
/// \}

/// \name TSR [RM0090, 32.9.2: CAN transmit status register]; \a n: mailbox 0…2
/// \{
#define CO_BXCAN_TSR_RQCP(n) (1u << (8u * (n)))       ///< request completed; cleared with the next three by writing 1
#define CO_BXCAN_TSR_TXOK(n) (1u << (8u * (n) + 1u))  ///< sent
#define CO_BXCAN_TSR_ALST(n) (1u << (8u * (n) + 2u))  ///< the last attempt lost the arbitration
#define CO_BXCAN_TSR_TERR(n) (1u << (8u * (n) + 3u))  ///< the last attempt failed
#define CO_BXCAN_TSR_ABRQ(n) (1u << (8u * (n) + 7u))  ///< abort request
#define CO_BXCAN_TSR_TME(n) (1u << (26u + (n)))       ///< mailbox empty
/// \}

/// \name RF0R [RM0090, 32.9.2: CAN receive FIFO 0 register]
/// \{
#define CO_BXCAN_RFR_FMP (3u << 0)   ///< number of frames in the FIFO
#define CO_BXCAN_RFR_FULL (1u << 3)  ///< three frames; cleared by writing 1
#define CO_BXCAN_RFR_FOVR (1u << 4)  ///< a frame was lost; cleared by writing 1
#define CO_BXCAN_RFR_RFOM (1u << 5)  ///< releases the oldest frame; cleared by the controller when that is done
/// \}

/// \name IER [RM0090, 32.9.2: CAN interrupt enable register]
/// \{
#define CO_BXCAN_IER_TMEIE (1u << 0)   ///< RQCP of a mailbox
#define CO_BXCAN_IER_FMPIE0 (1u << 1)  ///< a frame in FIFO 0
#define CO_BXCAN_IER_FOVIE0 (1u << 3)  ///< overrun of FIFO 0
#define CO_BXCAN_IER_EPVIE (1u << 9)   ///< error passive
#define CO_BXCAN_IER_BOFIE (1u << 10)  ///< bus-off
#define CO_BXCAN_IER_ERRIE (1u << 15)  ///< all error interrupts
/// \}

/// \name ESR [RM0090, 32.9.2: CAN error status register]
/// \{
#define CO_BXCAN_ESR_EPVF (1u << 1)                     ///< error passive
#define CO_BXCAN_ESR_BOFF (1u << 2)                     ///< bus-off
#define CO_BXCAN_ESR_TEC(esr) ((uint8_t)((esr) >> 16))  ///< transmit error counter, least significant byte
#define CO_BXCAN_ESR_REC(esr) ((uint8_t)((esr) >> 24))  ///< receive error counter
/// \}

/// \name BTR [RM0090, 32.9.2: CAN bit timing register]; writable in initialisation mode
/// Bits 0…9 prescaler - 1, 16…19 segment 1 - 1, 20…22 segment 2 - 1, 24…25 synchronisation jump width - 1.
/// \{
#define CO_BXCAN_BTR_LBKM (1u << 30)  ///< loopback
#define CO_BXCAN_BTR_SILM (1u << 31)  ///< silent; with LBKM: disconnected from the bus
/// \}

/// \name Mailboxes [RM0090, 32.9.3: CAN mailbox registers]
/// Bits 21…31: base identifier, or the upper 11 bits of a 29-bit one; bits 3…20: the lower 18 bits.
/// \{
#define CO_BXCAN_IR_TXRQ (1u << 0)  ///< transmit request
#define CO_BXCAN_IR_RTR (1u << 1)
#define CO_BXCAN_IR_IDE (1u << 2)
#define CO_BXCAN_IR_EXID_SHIFT 3
#define CO_BXCAN_IR_STID_SHIFT 21
#define CO_BXCAN_DTR_DLC 0xFu
/// \}

/// \name FMR [RM0090, 32.9.4: CAN filter registers]
/// \{
#define CO_BXCAN_FMR_FINIT \
  (1u << 0)  ///< initialisation of filters: stops reception of both controllers; set after a reset
#define CO_BXCAN_FMR_CAN2SB_SHIFT 8  ///< first bank of CAN2, 0…28; reserved in devices with one controller
#define CO_BXCAN_FMR_CAN2SB (0x3Fu << 8)
/// \}

/// \name Filters of 16 bits [RM0090, 32.7.4: Filter bank scale configuration]
/// \{
#define CO_BXCAN_FILTER_STID_SHIFT 5
#define CO_BXCAN_FILTER_RTR (1u << 4)
#define CO_BXCAN_FILTER_IDE (1u << 3)
#define CO_BXCAN_FILTER_EXID 7u  ///< bits 15…17 of the lower 18 bits of a 29-bit identifier
/// \}
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
