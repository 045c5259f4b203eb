// SPDX-License-Identifier: Apache-2.0
/// \file co_slcan.h
/// A CAN controller behind a line of text: the slcan protocol of Lawicel, over a UART, a USB adapter or any other
/// stream of bytes that is not lossy. C and C++, bare metal and hosts.
///
///     static CO_SLCAN can;
///     static CO_IF_FRM frames[32];
///     COSlcanInit(&can, frames, 32, uart_start, NULL);        // once, before the interrupts of the UART are let in
///     ext.Can = &SlcanDriver;  ext.CanCtx = &can;             // CO_NODE_EXT
///
///     receive interrupt:   COSlcanReceive(&can, UART_DATA);
///     transmit interrupt:  const uint8_t* bytes;
///                          if (COSlcanPending(&can, &bytes) == 0) { stop the interrupt; }
///                          else { UART_DATA = bytes[0]; COSlcanSent(&can, 1); }
///     uart_start:          let the transmit interrupt in    // there is something to be sent
///
/// Frames are lines that end with CR: t or T, identifier in 3 or 8 hex digits, length, data; r and R are remote frames,
/// without data. Enable sends C (close), S0…S8 (bit rate, one of 10, 20, 50, 100, 125, 250, 500, 800 and 1000 kbit/s;
/// at another one the adapter keeps its own) and O (open), Close sends C. Received are frames, with the time stamp
/// that some adapters append; BELL, by which an adapter refuses what it was sent last, is counted; its other answers,
/// and the commands of a peer that takes us for its adapter, are passed over. So two nodes can speak with each other
/// without any adapter in between.
///
/// A line that is no frame, whatever it looks like, is dropped and counted; the next CR ends it. Frames that find the
/// ring full are lost: Read reports that by an error frame, coded as SocketCAN does.
/// Send takes a frame if there is room for all of it, else returns 0; it never waits.
///
/// Contexts: COSlcanReceive() and COSlcanBroken() in one context, say the receive interrupt; COSlcanPending() and
/// COSlcanSent() in one, say the transmit interrupt; the driver in the loop, as is uart_start. All may be the same.
/// Owner: the structure and the frames are the caller's; they must outlive the node.
#ifndef CO_SLCAN_H_
#define CO_SLCAN_H_

#include "co_if_can.h"
#include "co_ring.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CO_SLCAN_LINE 30u      ///< characters of the longest frame, time stamp included, without CR
#define CO_SLCAN_TX_BYTES 64u  ///< room for text that waits to be sent: two frames and the commands; a power of two

/// All members but Baud are the driver's.
typedef struct CO_SLCAN_T {
  uint32_t Baud;             ///< bit/s where Enable names none; 0: what the adapter has
  void (*Start)(void* ctx);  ///< called by Send, Enable and Close: there is text to be sent
  void* Ctx;
  CO_RING Frames;
  uint16_t LostSeen;   // of the frames that found the ring full, those that Read has reported
  uint16_t Malformed;  // written by the receiving context only
  uint16_t Refused;    // likewise
  uint8_t Open;        // on the bus: frames are received; written by the loop only
  uint8_t Busy;        // Send had no room; written by the loop only
  uint8_t TxHead;      // count 0…255; written by the loop only
  uint8_t TxTail;      // written by the transmitting context only
  uint8_t LineLen;     // characters received, more than CO_SLCAN_LINE: no frame
  uint8_t Line[CO_SLCAN_LINE];
  uint8_t Tx[CO_SLCAN_TX_BYTES];
} CO_SLCAN;

/// Prepares a controller over \a num frames at \a mem for what is received. No other context may use it meanwhile.
/// Returns false if an argument is null or \a num is 0 or above 32767; nothing is received then.
bool COSlcanInit(CO_SLCAN* can, CO_IF_FRM* mem, uint16_t num, void (*start)(void* ctx), void* ctx);

/// A byte has arrived.
void COSlcanReceive(CO_SLCAN* can, uint8_t byte);
/// Bytes have been lost, say by an overrun of the UART: the line that is being received is no frame.
void COSlcanBroken(CO_SLCAN* can);

/// Returns how many bytes wait to be sent at \a bytes, 0: none. More may follow behind the end of the buffer: ask
/// again.
uint32_t COSlcanPending(const CO_SLCAN* can, const uint8_t** bytes);
/// The first \a num of these bytes have been sent, or taken over.
void COSlcanSent(CO_SLCAN* can, uint32_t num);

/// Whether CONodeProcess() has something to do for the driver: a frame to be read, or room for one that Send has
/// refused. To be asked with the interrupts kept away before the CPU is put to sleep.
bool COSlcanIsDue(const CO_SLCAN* can);

/// Lines that were no frames since COSlcanInit(), saturating. From any context.
uint16_t COSlcanMalformed(const CO_SLCAN* can);
/// What the adapter has refused since COSlcanInit(), saturating. From any context.
uint16_t COSlcanRefused(const CO_SLCAN* can);

/// The driver; its context is a CO_SLCAN.
extern const CO_IF_CAN_DRV_EX SlcanDriver;

#ifdef __cplusplus
}
#endif

#endif
