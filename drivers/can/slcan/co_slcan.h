// SPDX-License-Identifier: Apache-2.0
/// \file co_slcan.h
/// Driver for a CAN controller behind a serial line: the slcan protocol of Lawicel, over a UART, a USB adapter or any
/// other byte stream without loss. C and C++, bare metal and hosts.
///
///     static CO_SLCAN can;
///     static CO_IF_FRM frames[32];
///     COSlcanInit(&can, frames, 32, uart_start, NULL);        // once, before the UART interrupts are enabled
///     ext.Can = &SlcanDriver;  ext.CanCtx = &can;             // CO_NODE_EXT
///
///     receive interrupt:   COSlcanReceive(&can, UART_DATA);
///     transmit interrupt:  const uint8_t* bytes;
///                          if (COSlcanPending(&can, &bytes) == 0) { stop the interrupt; }
///                          else { UART_DATA = bytes[0]; COSlcanSent(&can, 1); }
///     uart_start:          enable the transmit interrupt    // there is text to send
///
/// Frames are lines that end with CR: t or T, identifier in 3 or 8 hex digits, length, data; r and R are remote frames,
/// without data. Enable sends C (close), S0…S8 (bit rate, one of 10, 20, 50, 100, 125, 250, 500, 800 and 1000 kbit/s;
/// at another one the adapter keeps its rate) and O (open); Close sends C. The driver receives frames, with the time
/// stamp that some adapters append, and counts BELL, by which an adapter refuses the last line. It ignores the other
/// answers of the adapter, and the commands of a peer that regards this node as its adapter. So two nodes can
/// communicate directly, without an adapter.
///
/// A line that is not a valid frame is dropped and counted; the next CR ends it. Frames are lost while the ring is
/// full: Read reports that by an error frame in the coding of SocketCAN.
/// Send queues a frame if there is space for all of its text, else it returns 0; it never blocks.
///
/// Contexts: COSlcanReceive() and COSlcanBroken() in one context, such as the receive interrupt; COSlcanPending() and
/// COSlcanSent() in one context, such as the transmit interrupt; the functions of the driver in the loop, which also
/// calls uart_start. The three contexts may be the same.
/// Owner: the structure and the frames are the caller's; they must outlive the node.
#ifndef CO_SLCAN_H_
#define CO_SLCAN_H_

#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CO_SLCAN_LINE 30u  ///< characters of the longest frame, time stamp included, without CR
/// Capacity of the transmit buffer in bytes, a power of two: 16 bytes for commands, and two frames with 11-bit
/// identifiers or one with 29 bits.
#define CO_SLCAN_TX_BYTES 64u

/// State of a controller. The application may write Baud; the driver owns all other members.
typedef struct CO_SLCAN_T {
  uint32_t Baud;                  ///< bit/s if Enable is called with 0; 0: the rate that the adapter has
  void (*Start)(void* ctx);       ///< called by Send, Enable and Close when there is text to send
  void* Ctx;                      ///< argument of Start
  CO_RING Frames;                 ///< received frames
  uint16_t ReportedLost;          ///< lost frames (ring full) that Read has reported
  uint16_t Malformed;             ///< invalid lines; written by the receiving context only
  uint16_t Refused;               ///< lines that the adapter has refused; written by the receiving context only
  uint8_t Open;                   ///< 1: on the bus, frames are received; written by the loop only
  uint8_t Busy;                   ///< 1: Send has found too little space; written by the loop only
  uint8_t TxHead;                 ///< bytes written to Tx, modulo 256; written by the loop only
  uint8_t TxTail;                 ///< bytes sent from Tx, modulo 256; written by the transmitting context only
  uint8_t LineLen;                ///< characters in Line; more than CO_SLCAN_LINE: not a frame
  uint8_t Line[CO_SLCAN_LINE];    ///< line that is being received
  uint8_t Tx[CO_SLCAN_TX_BYTES];  ///< text to be sent, a circular buffer
} CO_SLCAN;

/// Initialises a controller with \a num frames at \a mem as its receive queue. \a start and \a ctx (may be null) are
/// the members Start and Ctx. No other context may use it meanwhile.
/// \retval true   the controller is initialised
/// \retval false  \a can, \a mem or \a start is null, or \a num is 0 or above 32767; the driver receives nothing
bool COSlcanInit(CO_SLCAN* can, CO_IF_FRM* mem, uint16_t num, void (*start)(void* ctx), void* ctx);

/// Processes a received byte. Context: one, such as the receive interrupt.
void COSlcanReceive(CO_SLCAN* can, uint8_t byte);
/// Reports lost bytes (such as an overrun of the UART): the driver drops the line that it is receiving. Context: that
/// of COSlcanReceive().
void COSlcanBroken(CO_SLCAN* can);

/// Returns the number of bytes at \a bytes that have to be sent, 0: none. The buffer is circular: call it again after
/// COSlcanSent() for the bytes at its begin. The bytes are the driver's, and valid until COSlcanSent(). Context: one,
/// such as the transmit interrupt.
uint32_t COSlcanPending(const CO_SLCAN* can, const uint8_t** bytes);
/// Releases the first \a num of the bytes that COSlcanPending() has returned; they have been sent, or copied. Context:
/// that of COSlcanPending().
void COSlcanSent(CO_SLCAN* can, uint32_t num);

/// Returns true if CONodeProcess() has work: a received frame, or free space for a frame that Send has refused. Call it
/// with interrupts disabled before the CPU is put to sleep.
bool COSlcanIsDue(const CO_SLCAN* can);

/// Returns the number of invalid lines since COSlcanInit(), saturating. Any context.
uint16_t COSlcanMalformed(const CO_SLCAN* can);
/// Returns the number of lines that the adapter has refused (BELL) since COSlcanInit(), saturating. Any context.
uint16_t COSlcanRefused(const CO_SLCAN* can);

/// The driver; its context is a CO_SLCAN.
extern const CO_IF_CAN_DRV_EX SlcanDriver;

#ifdef __cplusplus
}
#endif

#endif
