// SPDX-License-Identifier: Apache-2.0
/// \file mcp2515_registers.h
/// SPI instructions and registers of the CAN controllers MCP2515 and MCP25625.
///
/// Source: [MCP2515] data sheet "MCP2515, Stand-Alone CAN Controller with SPI Interface", Microchip, DS20001801J.
/// [Errata] "MCP2515 Rev. B Silicon Errata", Microchip, DS80179G.
#ifndef MCP2515_REGISTERS_H_
#define MCP2515_REGISTERS_H_

#ifdef __cplusplus
extern "C" {
#endif

/// \cond internal

/// \name Instructions [MCP2515, table 12-1]
/// \{
#define CO_MCP2515_RESET 0xC0u
#define CO_MCP2515_READ 0x03u                       ///< address, then any number of registers
#define CO_MCP2515_WRITE 0x02u                      ///< address, then any number of registers
#define CO_MCP2515_BIT_MODIFY 0x05u                 ///< address, mask, value; not all registers
#define CO_MCP2515_READ_RX(n) (0x90u | ((n) << 2))  ///< from RXBnSIDH on; clears RXnIF when CS rises
#define CO_MCP2515_RTS(n) (0x80u | (1u << (n)))     ///< requests transmission of buffer n
#define CO_MCP2515_READ_STATUS 0xA0u
/// \}

/// \name Answer to READ STATUS [MCP2515, figure 12-8]
/// \{
#define CO_MCP2515_STATUS_RX(n) (1u << (n))               ///< CANINTF.RXnIF
#define CO_MCP2515_STATUS_TXREQ(n) (1u << (2 + 2 * (n)))  ///< TXBnCTRL.TXREQ
#define CO_MCP2515_STATUS_TXIF(n) (1u << (3 + 2 * (n)))   ///< CANINTF.TXnIF
#define CO_MCP2515_STATUS_PENDING 0x54u                   ///< TXREQ of all buffers
/// \}

/// \name Addresses [MCP2515, table 11-1]
/// \{
#define CO_MCP2515_FILTERS 0x00u  ///< RXF0…2, each SIDH, SIDL, EID8, EID0; written in Configuration mode
#define CO_MCP2515_CANSTAT 0x0Eu
#define CO_MCP2515_CANCTRL 0x0Fu
#define CO_MCP2515_FILTERS3 0x10u  ///< RXF3…5; written in Configuration mode
#define CO_MCP2515_TEC 0x1Cu       ///< followed by REC
#define CO_MCP2515_MASKS 0x20u     ///< RXM0, RXM1; written in Configuration mode
#define CO_MCP2515_CNF3 0x28u      ///< followed by CNF2, CNF1; written in Configuration mode
#define CO_MCP2515_CANINTE 0x2Bu
#define CO_MCP2515_CANINTF 0x2Cu
#define CO_MCP2515_EFLG 0x2Du
#define CO_MCP2515_TXCTRL(n) (0x30u + 0x10u * (n))  ///< followed by SIDH, SIDL, EID8, EID0, DLC and eight bytes of data
#define CO_MCP2515_RXCTRL(n) (0x60u + 0x10u * (n))
/// \}

/// \name CANCTRL, CANSTAT [MCP2515, registers 10-1 and 10-2]
/// \{
#define CO_MCP2515_MODE 0xE0u  ///< REQOP, OPMOD
#define CO_MCP2515_MODE_NORMAL 0x00u
#define CO_MCP2515_MODE_LOOPBACK 0x40u
#define CO_MCP2515_MODE_CONFIGURATION 0x80u  ///< clears the error counters
#define CO_MCP2515_ABAT 0x10u                ///< aborts all buffers that are not being transmitted, while it is set
#define CO_MCP2515_CLOCK_OUTPUT 0x07u        ///< CLKEN, CLKPRE
/// \}

/// \name CNF1, CNF2, CNF3 [MCP2515, registers 5-1 to 5-3]
/// \{
#define CO_MCP2515_CNF1_SJW_SHIFT 6
#define CO_MCP2515_CNF2_BTLMODE 0x80u  ///< CNF3 has the length of phase segment 2
#define CO_MCP2515_CNF2_PHSEG1_SHIFT 3
/// \}

/// \name CANINTE, CANINTF [MCP2515, registers 7-1 and 7-2]
/// Flags are set also while they are not enabled.
/// \{
#define CO_MCP2515_INT_RX(n) (1u << (n))
#define CO_MCP2515_INT_TX(n) (4u << (n))
#define CO_MCP2515_INT_ERR 0x20u  ///< EFLG has changed
/// \}

/// \name EFLG [MCP2515, register 6-3]
/// \{
#define CO_MCP2515_EFLG_RX0OVR 0x40u  ///< cleared by writing 0
#define CO_MCP2515_EFLG_RX1OVR 0x80u  ///< cleared by writing 0
#define CO_MCP2515_EFLG_TXBO 0x20u    ///< bus-off
#define CO_MCP2515_EFLG_TXEP 0x10u    ///< error passive as transmitter
#define CO_MCP2515_EFLG_RXEP 0x08u    ///< error passive as receiver
/// \}

/// \name Buffers [MCP2515, registers 3-1 to 3-8 and 4-1 to 4-8]
/// \{
#define CO_MCP2515_TXCTRL_MLOA 0x20u  ///< the frame has lost the arbitration
#define CO_MCP2515_RXCTRL_BUKT 0x04u  ///< RXB0CTRL: a frame for RXB0 moves to RXB1 if RXB0 is full
#define CO_MCP2515_SIDL_EXIDE 0x08u   ///< 29-bit identifier
#define CO_MCP2515_SIDL_SRR 0x10u     ///< received remote frame with an 11-bit identifier
#define CO_MCP2515_DLC_RTR 0x40u      ///< remote frame; received ones with 29-bit identifiers only
#define CO_MCP2515_DLC_LENGTH 0x0Fu
/// \}

/// \endcond

#ifdef __cplusplus
}
#endif

#endif
