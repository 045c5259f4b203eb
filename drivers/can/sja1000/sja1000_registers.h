// SPDX-License-Identifier: Apache-2.0
/// \file sja1000_registers.h
/// Registers of the CAN controller SJA1000 in PeliCAN mode, and of TWAI, the controller of ESP32 that has most of them.
///
/// Sources: [SJA1000] data sheet "SJA1000, Stand-alone CAN controller", Philips Semiconductors, 2000 Jan 04,
/// section 6.4 and 6.5. [TWAI] "ESP32 Technical Reference Manual", version 5.2, chapter 21, and the register header
/// twai_struct.h of Espressif for ESP32 and ESP32-C3. [Errata] "ESP32 Series SoC Errata", version 2.8, sections 3.13.1
/// to 3.13.11.
///
/// The values are CAN addresses. A memory-mapped SJA1000 has them at any distance; TWAI has each in a word of 32 bits.
#ifndef SJA1000_REGISTERS_H_
#define SJA1000_REGISTERS_H_

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal

/// \name CAN addresses [SJA1000, 6.4.1: PeliCAN address layout] [TWAI, 21.6: register summary]
/// \{
#define CO_SJA1000_MOD 0u     ///< mode
#define CO_SJA1000_CMR 1u     ///< command
#define CO_SJA1000_SR 2u      ///< status
#define CO_SJA1000_IR 3u      ///< interrupt; reading clears all bits but RI
#define CO_SJA1000_IER 4u     ///< interrupt enable
#define CO_SJA1000_BTR0 6u    ///< bus timing 0; written in reset mode
#define CO_SJA1000_BTR1 7u    ///< bus timing 1; written in reset mode
#define CO_SJA1000_OCR 8u     ///< output control; written in reset mode; not in TWAI
#define CO_SJA1000_ECC 12u    ///< error code capture; reading enables the next bus error interrupt
#define CO_SJA1000_EWLR 13u   ///< error warning limit; written in reset mode
#define CO_SJA1000_RXERR 14u  ///< receive error counter; written in reset mode
#define CO_SJA1000_TXERR 15u  ///< transmit error counter; written in reset mode
#define CO_SJA1000_ACR 16u    ///< four bytes of acceptance code, in reset mode
#define CO_SJA1000_AMR 20u    ///< four bytes of acceptance mask, in reset mode; 1: the bit is not compared
#define CO_SJA1000_FRAME 16u  ///< in operating mode: transmit buffer (writing) and receive buffer (reading), 13 bytes
#define CO_SJA1000_RMC 29u    ///< number of frames in the receive FIFO
#define CO_SJA1000_CDR 31u    ///< clock divider
/// \}

/// \name MOD [SJA1000, 6.4.3] [TWAI, TWAI_MODE_REG]
/// The bits LOM, STM and AFM can be written in reset mode.
/// \{
#define CO_SJA1000_MOD_RM (1u << 0)   ///< reset mode; set by the controller at bus-off
#define CO_SJA1000_MOD_LOM (1u << 1)  ///< listen only
#define CO_SJA1000_MOD_STM (1u << 2)  ///< self test: a frame needs no acknowledgement
#define CO_SJA1000_MOD_AFM (1u << 3)  ///< acceptance filter: 1: a single one, 0: two
/// \}

/// \name CMR [SJA1000, 6.4.4] [TWAI, TWAI_CMD_REG]
/// At least one internal clock cycle (two clock periods) must be between two commands.
/// \{
#define CO_SJA1000_CMR_TR (1u << 0)   ///< transmission request
#define CO_SJA1000_CMR_AT (1u << 1)   ///< abort transmission; a transmission in progress is not stopped
#define CO_SJA1000_CMR_RRB (1u << 2)  ///< release receive buffer
#define CO_SJA1000_CMR_CDO (1u << 3)  ///< clear data overrun
#define CO_SJA1000_CMR_SRR (1u << 4)  ///< self reception request: like TR, and the frame is received
/// \}

/// \name SR [SJA1000, 6.4.5] [TWAI, TWAI_STATUS_REG]
/// RS and TS: neither: the bus is idle; both: the controller waits for an idle bus.
/// \{
#define CO_SJA1000_SR_RBS (1u << 0)  ///< a frame is in the receive buffer
#define CO_SJA1000_SR_DOS (1u << 1)  ///< a frame was lost
#define CO_SJA1000_SR_TBS (1u << 2)  ///< the transmit buffer can be written
#define CO_SJA1000_SR_TCS (1u << 3)  ///< the last requested frame was sent; 0 after a request
#define CO_SJA1000_SR_RS (1u << 4)   ///< receiving
#define CO_SJA1000_SR_TS (1u << 5)   ///< transmitting
#define CO_SJA1000_SR_ES (1u << 6)   ///< an error counter has reached the warning limit
#define CO_SJA1000_SR_BS (1u << 7)   ///< bus-off, also during the recovery
#define CO_SJA1000_SR_MS (1u << 8)   ///< the frame in the receive buffer is incomplete; TWAI, but not that of ESP32
/// \}

/// \name IR and IER [SJA1000, 6.4.6 and 6.4.7] [TWAI, TWAI_INT_RAW_REG and TWAI_INT_ENA_REG]
/// Bit 4 of IER divides the clock of ESP32 from revision 2 on by 2 (BRP_DIV); it stays 0.
/// \{
#define CO_SJA1000_IR_RI (1u << 0)   ///< receive: while RBS is set
#define CO_SJA1000_IR_TI (1u << 1)   ///< transmit: TBS was set
#define CO_SJA1000_IR_EI (1u << 2)   ///< error warning: ES or BS has changed
#define CO_SJA1000_IR_DOI (1u << 3)  ///< data overrun: DOS was set
#define CO_SJA1000_IR_EPI (1u << 5)  ///< error passive, or error active again
#define CO_SJA1000_IR_BEI (1u << 7)  ///< bus error: ECC has its cause
/// \}

/// \name ECC [SJA1000, 6.4.9] [TWAI, 21.5.8]
/// \{
#define CO_SJA1000_ECC_SEGMENT 0x1Fu
#define CO_SJA1000_ECC_CRC 0x08u            ///< segment: CRC sequence
#define CO_SJA1000_ECC_DATA 0x0Au           ///< segment: data field
#define CO_SJA1000_ECC_ACK_DELIMITER 0x1Bu  ///< segment: acknowledge delimiter
#define CO_SJA1000_ECC_RECEIVING (1u << 5)
#define CO_SJA1000_ECC_TYPE 0xC0u
#define CO_SJA1000_ECC_OTHER 0xC0u  ///< type: neither a bit, form nor stuff error
/// \}

/// \name Frames [SJA1000, 6.4.13 and 6.4.14] [TWAI, 21.5.4]
/// First byte: frame information. 11-bit identifier: two bytes, its highest bit in the highest bit of the first one.
/// 29-bit identifier: four bytes, likewise. Then the data.
/// \{
#define CO_SJA1000_FRAME_FF (1u << 7)   ///< 29-bit identifier
#define CO_SJA1000_FRAME_RTR (1u << 6)  ///< remote frame
#define CO_SJA1000_FRAME_DLC 0x0Fu
/// \}

/// \name Two acceptance filters [SJA1000, 6.4.15.2] [TWAI, 21.5.6.2]
/// Bytes 0 and 1: filter 1, bytes 2 and 3: filter 2. The highest 11 bits are compared with an 11-bit identifier, or
/// with the highest bits of a 29-bit one. The others are RTR and data of a frame with an 11-bit identifier, or the next
/// five bits of a 29-bit one.
/// \{
#define CO_SJA1000_FILTER_ID_SHIFT 5
#define CO_SJA1000_FILTER_OTHERS 0x1Fu
/// \}

/// \name Bus timing [SJA1000, 6.5.1 and 6.5.2] [TWAI, TWAI_BUS_TIMING_0_REG and TWAI_BUS_TIMING_1_REG]
/// A quantum is 2 (prescaler) periods of the clock. BTR0: prescaler - 1 from bit 0 on, synchronisation jump width - 1
/// from bit 6 on; in TWAI, but not that of ESP32, from bit 14 on. BTR1: bits 0…3: segment 1 - 1, 4…6: segment 2 - 1.
/// \{
#define CO_SJA1000_BTR0_SJW_SHIFT 6
#define CO_TWAI_BTR0_SJW_SHIFT 14
#define CO_SJA1000_BTR1_TSEG2_SHIFT 4
/// \}

/// \name OCR [SJA1000, 6.5.3]
/// \{
#define CO_SJA1000_OCR_NORMAL 0x02u     ///< normal output mode
#define CO_SJA1000_OCR_PUSH_PULL 0x18u  ///< TX0 drives both levels; TX1 floats
/// \}

/// \name CDR [SJA1000, 6.5.4] [TWAI, TWAI_CLOCK_DIVIDER_REG]
/// \{
#define CO_SJA1000_CDR_OFF (1u << 3)      ///< CLKOUT is off
#define CO_SJA1000_CDR_CBP (1u << 6)      ///< the input comparator is bypassed: RX0 only; not in TWAI
#define CO_SJA1000_CDR_PELICAN (1u << 7)  ///< PeliCAN mode; ESP32: likewise
#define CO_TWAI_CDR_OFF (1u << 8)         ///< CLKOUT is off; TWAI, but not that of ESP32
/// \}
/// \endcond

#ifdef __cplusplus
}
#endif

#endif
