// SPDX-License-Identifier: Apache-2.0
/// \file fdcan_registers.h
/// Registers and message memory of M_CAN by Bosch, in its two variants in STM32 controllers.
///
/// Sources: Bosch M_CAN user's manual, revision 3.3, chapter 2 (registers, message RAM elements), for the configurable
/// variant, which RM0433 (STM32H7), chapter "FD controller area network (FDCAN)", repeats; RM0440 (STM32G4), chapter
/// 44, for the fixed variant. The order of registers and the bits of IR of the fixed variant were compared with the
/// register header of the STM32G474 (CMSIS device header).
#ifndef FDCAN_REGISTERS_H_
#define FDCAN_REGISTERS_H_

#include <assert.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal

/// Controller with fixed message memory: STM32 G0, G4, H5, L5, U5.
typedef struct CO_FDCAN_REGISTERS_T {
  volatile uint32_t Crel;  ///< core release
  volatile uint32_t Endn;  ///< 8765 4321h
  uint32_t Reserved0;
  volatile uint32_t Dbtp;  ///< data bit timing
  volatile uint32_t Test;
  volatile uint32_t Rwd;
  volatile uint32_t Cccr;  ///< control
  volatile uint32_t Nbtp;  ///< nominal bit timing
  volatile uint32_t Tscc;
  volatile uint32_t Tscv;
  volatile uint32_t Tocc;
  volatile uint32_t Tocv;
  uint32_t Reserved1[4];
  volatile uint32_t Ecr;  ///< error counters
  volatile uint32_t Psr;  ///< protocol status
  volatile uint32_t Tdcr;
  uint32_t Reserved2;
  volatile uint32_t Ir;   ///< interrupts; cleared by writing 1
  volatile uint32_t Ie;   ///< interrupt enable
  volatile uint32_t Ils;  ///< interrupt line select
  volatile uint32_t Ile;  ///< interrupt line enable
  uint32_t Reserved3[8];
  volatile uint32_t Rxgfc;  ///< global filter configuration
  volatile uint32_t Xidam;
  volatile uint32_t Hpms;
  uint32_t Reserved4;
  volatile uint32_t Rxf0s;  ///< receive FIFO 0 status
  volatile uint32_t Rxf0a;  ///< receive FIFO 0 acknowledge
  volatile uint32_t Rxf1s;
  volatile uint32_t Rxf1a;
  uint32_t Reserved5[8];
  volatile uint32_t Txbc;   ///< transmit buffer configuration
  volatile uint32_t Txfqs;  ///< transmit FIFO or queue status
  volatile uint32_t Txbrp;  ///< requests pending
  volatile uint32_t Txbar;  ///< add request
  volatile uint32_t Txbcr;  ///< cancellation request
  volatile uint32_t Txbto;  ///< transmission occurred
  volatile uint32_t Txbcf;  ///< cancellation finished
  volatile uint32_t Txbtie;
  volatile uint32_t Txbcie;
  volatile uint32_t Txefs;
  volatile uint32_t Txefa;
} CO_FDCAN_REGISTERS;

/// Controller with configurable message memory: STM32H7, and M_CAN of other makers.
typedef struct CO_MCAN_REGISTERS_T {
  volatile uint32_t Crel;
  volatile uint32_t Endn;
  uint32_t Reserved0;
  volatile uint32_t Dbtp;
  volatile uint32_t Test;
  volatile uint32_t Rwd;
  volatile uint32_t Cccr;
  volatile uint32_t Nbtp;
  volatile uint32_t Tscc;
  volatile uint32_t Tscv;
  volatile uint32_t Tocc;
  volatile uint32_t Tocv;
  uint32_t Reserved1[4];
  volatile uint32_t Ecr;
  volatile uint32_t Psr;
  volatile uint32_t Tdcr;
  uint32_t Reserved2;
  volatile uint32_t Ir;
  volatile uint32_t Ie;
  volatile uint32_t Ils;
  volatile uint32_t Ile;
  uint32_t Reserved3[8];
  volatile uint32_t Gfc;    ///< global filter configuration
  volatile uint32_t Sidfc;  ///< filters of 11-bit identifiers
  volatile uint32_t Xidfc;  ///< filters of 29-bit identifiers
  uint32_t Reserved4;
  volatile uint32_t Xidam;
  volatile uint32_t Hpms;
  volatile uint32_t Ndat1;
  volatile uint32_t Ndat2;
  volatile uint32_t Rxf0c;  ///< receive FIFO 0 configuration
  volatile uint32_t Rxf0s;
  volatile uint32_t Rxf0a;
  volatile uint32_t Rxbc;
  volatile uint32_t Rxf1c;
  volatile uint32_t Rxf1s;
  volatile uint32_t Rxf1a;
  volatile uint32_t Rxesc;  ///< size of receive elements
  volatile uint32_t Txbc;
  volatile uint32_t Txfqs;
  volatile uint32_t Txesc;  ///< size of transmit elements
  volatile uint32_t Txbrp;
  volatile uint32_t Txbar;
  volatile uint32_t Txbcr;
  volatile uint32_t Txbto;
  volatile uint32_t Txbcf;
  volatile uint32_t Txbtie;
  volatile uint32_t Txbcie;
  uint32_t Reserved5[2];
  volatile uint32_t Txefc;
  volatile uint32_t Txefs;
  volatile uint32_t Txefa;
} CO_MCAN_REGISTERS;

#define CO_FDCAN_COMMON(type)                          \
  static_assert(offsetof(type, Crel) == 0x00, "CREL"); \
  static_assert(offsetof(type, Dbtp) == 0x0C, "DBTP"); \
  static_assert(offsetof(type, Test) == 0x10, "TEST"); \
  static_assert(offsetof(type, Cccr) == 0x18, "CCCR"); \
  static_assert(offsetof(type, Nbtp) == 0x1C, "NBTP"); \
  static_assert(offsetof(type, Ecr) == 0x40, "ECR");   \
  static_assert(offsetof(type, Psr) == 0x44, "PSR");   \
  static_assert(offsetof(type, Ir) == 0x50, "IR");     \
  static_assert(offsetof(type, Ie) == 0x54, "IE");     \
  static_assert(offsetof(type, Ils) == 0x58, "ILS");   \
  static_assert(offsetof(type, Ile) == 0x5C, "ILE");   \
  static_assert(offsetof(type, Txbc) == 0xC0, "TXBC"); \
  static_assert(offsetof(type, Txfqs) == 0xC4, "TXFQS")
CO_FDCAN_COMMON(CO_FDCAN_REGISTERS);
static_assert(offsetof(CO_FDCAN_REGISTERS, Rxgfc) == 0x80, "RXGFC");
static_assert(offsetof(CO_FDCAN_REGISTERS, Xidam) == 0x84, "XIDAM");
static_assert(offsetof(CO_FDCAN_REGISTERS, Rxf0s) == 0x90, "RXF0S");
static_assert(offsetof(CO_FDCAN_REGISTERS, Rxf0a) == 0x94, "RXF0A");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbrp) == 0xC8, "TXBRP");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbar) == 0xCC, "TXBAR");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbcr) == 0xD0, "TXBCR");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbto) == 0xD4, "TXBTO");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbcf) == 0xD8, "TXBCF");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbtie) == 0xDC, "TXBTIE");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txbcie) == 0xE0, "TXBCIE");
static_assert(offsetof(CO_FDCAN_REGISTERS, Txefa) == 0xE8, "TXEFA");

CO_FDCAN_COMMON(CO_MCAN_REGISTERS);
static_assert(offsetof(CO_MCAN_REGISTERS, Gfc) == 0x80, "GFC");
static_assert(offsetof(CO_MCAN_REGISTERS, Sidfc) == 0x84, "SIDFC");
static_assert(offsetof(CO_MCAN_REGISTERS, Xidfc) == 0x88, "XIDFC");
static_assert(offsetof(CO_MCAN_REGISTERS, Xidam) == 0x90, "XIDAM");
static_assert(offsetof(CO_MCAN_REGISTERS, Rxf0c) == 0xA0, "RXF0C");
static_assert(offsetof(CO_MCAN_REGISTERS, Rxf0s) == 0xA4, "RXF0S");
static_assert(offsetof(CO_MCAN_REGISTERS, Rxf0a) == 0xA8, "RXF0A");
static_assert(offsetof(CO_MCAN_REGISTERS, Rxesc) == 0xBC, "RXESC");
static_assert(offsetof(CO_MCAN_REGISTERS, Txesc) == 0xC8, "TXESC");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbrp) == 0xCC, "TXBRP");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbar) == 0xD0, "TXBAR");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbcr) == 0xD4, "TXBCR");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbto) == 0xD8, "TXBTO");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbcf) == 0xDC, "TXBCF");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbtie) == 0xE0, "TXBTIE");
static_assert(offsetof(CO_MCAN_REGISTERS, Txbcie) == 0xE4, "TXBCIE");
static_assert(offsetof(CO_MCAN_REGISTERS, Txefc) == 0xF0, "TXEFC");
static_assert(offsetof(CO_MCAN_REGISTERS, Txefa) == 0xF8, "TXEFA");
#undef CO_FDCAN_COMMON

/// \name CCCR [M_CAN, 2.3.7: CC control register]
/// Only INIT can be changed at any time; the other bits, and the configuration registers, while INIT and CCE are 1.
/// Setting CCE also clears RXF0S, TXFQS, TXBRP, TXBTO and TXBCF.
/// \{
#define CO_FDCAN_CCCR_INIT (1u << 0)   ///< off the bus; set by a reset and by bus-off
#define CO_FDCAN_CCCR_CCE (1u << 1)    ///< configuration change enable
#define CO_FDCAN_CCCR_MON (1u << 5)    ///< bus monitoring
#define CO_FDCAN_CCCR_TEST (1u << 7)   ///< write access to TEST
#define CO_FDCAN_CCCR_FDOE (1u << 8)   ///< 0: CAN FD frames are destroyed by error frames
#define CO_FDCAN_CCCR_PXHD (1u << 12)  ///< no protocol exception handling
/// \}

/// \name TEST [M_CAN, 2.3.5: test register]
/// \{
#define CO_FDCAN_TEST_LBCK (1u << 4)  ///< loopback; with MON: disconnected from the bus
/// \}

/// \name ECR [M_CAN, 2.3.12: error counter register]
/// \{
#define CO_FDCAN_ECR_TEC(ecr) ((uint8_t)(ecr))
#define CO_FDCAN_ECR_REC(ecr) ((uint8_t)(((ecr) >> 8) & 0x7Fu))
#define CO_FDCAN_ECR_RP (1u << 15)  ///< the receive error counter has reached 128
/// \}

/// \name PSR [M_CAN, 2.3.13: protocol status register]
/// \{
#define CO_FDCAN_PSR_ACT (3u << 3)       ///< activity
#define CO_FDCAN_PSR_RECEIVER (2u << 3)  ///< ACT: the node receives a frame
#define CO_FDCAN_PSR_EP (1u << 5)        ///< error passive
#define CO_FDCAN_PSR_BO (1u << 7)        ///< bus-off
/// \}

/// \name IR and IE, fixed message memory [RM0440, 44.4: FDCAN interrupt register]
/// \{
#define CO_FDCAN_IR_RF0N (1u << 0)  ///< new frame in receive FIFO 0
#define CO_FDCAN_IR_RF0L (1u << 2)  ///< a frame was lost
#define CO_FDCAN_IR_TC (1u << 7)    ///< a transmission was completed
#define CO_FDCAN_IR_TCF (1u << 8)   ///< a cancellation was finished
#define CO_FDCAN_IR_EP (1u << 17)   ///< error passive has changed
#define CO_FDCAN_IR_BO (1u << 19)   ///< bus-off has changed
/// \}

/// \name IR and IE, configurable message memory [M_CAN, 2.3.15: interrupt register]
/// \{
#define CO_MCAN_IR_RF0N (1u << 0)
#define CO_MCAN_IR_RF0L (1u << 3)
#define CO_MCAN_IR_TC (1u << 9)
#define CO_MCAN_IR_TCF (1u << 10)
#define CO_MCAN_IR_EP (1u << 23)
#define CO_MCAN_IR_BO (1u << 25)
/// \}

#define CO_FDCAN_ILE_LINE0 (1u << 0)  ///< ILE: interrupt line 0

/// \name RXGFC, GFC [RM0440, 44.4: global filter configuration; M_CAN, 2.3.19]
/// \{
#define CO_FDCAN_GFC_REJECT_EXTENDED (2u << 2)  ///< ANFE: 29-bit identifiers without a filter are rejected
#define CO_FDCAN_GFC_REJECT_STANDARD (2u << 4)  ///< ANFS: 11-bit identifiers without a filter are rejected
#define CO_FDCAN_RXGFC_LSS_SHIFT 16             ///< fixed memory: number of standard filters, 0…28
#define CO_FDCAN_RXGFC_LSE_SHIFT 24             ///< fixed memory: number of extended filters, 0…8
/// \}

/// \name SIDFC, XIDFC, RXF0C, TXBC [M_CAN, 2.3.20, 2.3.21, 2.3.26, 2.3.34]
/// Bits 2…15: start address in bytes, bits 16…: number of elements. TXBC has the number of queue elements in bits
/// 24…29.
/// \{
#define CO_MCAN_NUMBER_SHIFT 16
#define CO_MCAN_TXBC_TFQS_SHIFT 24
#define CO_MCAN_TXBC_TFQM (1u << 30)   ///< queue: the lowest identifier is sent first
#define CO_FDCAN_TXBC_TFQM (1u << 24)  ///< same bit of the fixed variant
/// \}

/// \name RXF0S, TXFQS [M_CAN, 2.3.27, 2.3.35]
/// \{
#define CO_FDCAN_RXF0S_LEVEL 0x7Fu   ///< number of frames in the FIFO; four bits in the fixed variant
#define CO_FDCAN_RXF0S_GET_SHIFT 8   ///< index of the oldest frame
#define CO_FDCAN_RXF0S_GET 0x3Fu     ///< two bits in the fixed variant
#define CO_FDCAN_TXFQS_PUT_SHIFT 16  ///< index of a free buffer
#define CO_FDCAN_TXFQS_PUT 0x1Fu     ///< two bits in the fixed variant
#define CO_FDCAN_TXFQS_FULL (1u << 21)
/// \}

/// \name Elements of the message memory [M_CAN, 2.4: Message RAM]
/// A receive or transmit element begins with two words, R0, R1 or T0, T1; the data follow, byte 0 in the lowest bits.
/// \{
#define CO_FDCAN_ELEMENT_XTD (1u << 30)  ///< R0, T0: 29-bit identifier in bits 0…28; 0: 11 bits in bits 18…28
#define CO_FDCAN_ELEMENT_RTR (1u << 29)  ///< R0, T0
#define CO_FDCAN_ELEMENT_STD_SHIFT 18
#define CO_FDCAN_ELEMENT_FDF (1u << 21)  ///< R1, T1: CAN FD frame
#define CO_FDCAN_ELEMENT_DLC_SHIFT 16    ///< R1, T1
#define CO_FDCAN_ELEMENT_DLC 0xFu
#define CO_FDCAN_STANDARD_FIFO0 (1u << 27)  ///< S0: range SFID1…SFID2, stored in receive FIFO 0
#define CO_FDCAN_STANDARD_FIRST_SHIFT 16    ///< S0: SFID1; SFID2 is in the lowest bits
#define CO_FDCAN_EXTENDED_FIFO0 (1u << 29)  ///< F0: stored in receive FIFO 0; EFID1 is in the lowest bits
#define CO_FDCAN_EXTENDED_RANGE (3u << 30)  ///< F1: range EFID1…EFID2 without the mask XIDAM
/// \}

/// \name Fixed message memory of a controller, words [RM0440, 44.3.3: message RAM]
/// \{
#define CO_FDCAN_RAM_WORDS 212u  ///< 350h bytes
#define CO_FDCAN_RAM_RECEIVE 44u
#define CO_FDCAN_RAM_TRANSMIT 158u
#define CO_FDCAN_ELEMENT_WORDS 18u
/// \}
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
