// SPDX-License-Identifier: Apache-2.0
/// \file co_csdo.h
/// SDO clients: read and write the objects of other nodes, and of the own one. [301:7.2.4]
///
/// A client is configured by 1280h + n: sub 1 COB-ID of its requests, sub 2 COB-ID of the answers, sub 3 node-ID of the
/// server. [301:7.5.2.34] The COB-IDs are complete identifiers (600h + node-ID, 580h + node-ID, or any other). The bare
/// 600h and 580h of a table written for CANopen-Stack get the node-ID of sub 3 added: as complete identifiers they
/// would belong to node-ID 0, which no node has. The entries are read again at every request.
///
/// If sub 3 is the own node-ID, the request reads or writes the own dictionary with the rights of the network, in one
/// piece of any length; nothing is sent. The COB-IDs have to be valid there, too.
///
/// How the data are carried is the stack's choice: expedited up to 4 bytes; from CO_CSDO_BLOCK bytes on by block
/// transfer, and segmented if the server refuses that; else segmented.
///
/// Every request that was started calls its callback once: when the transfer has ended, was aborted by either side, has
/// timed out, was cancelled, or when the NMT state no longer allows SDO. Numbers are not converted: the buffer holds
/// the bytes in the order of the bus (little endian).
///
/// Clients with the same COB-ID of the answers cannot tell whose answer a frame is, if they wait for the same object:
/// each takes it. A callback must not start a request of another such client for the same object.
///
/// Context: the loop. Callbacks run in CONodeProcess(), COTmrProcess(), COCSdoCancel(), in the functions that change
/// the NMT state, and in writes to 1280h… that change the COB-IDs of a busy client, whose server then gets an abort.
#ifndef CO_CSDO_H_
#define CO_CSDO_H_

#include "co_cfg.h"
#include "co_err.h"
#include "co_needs.h"
#include "co_sdo.h"
#include "co_tmr.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_CSDO_T;

typedef enum CO_CSDO_STATE_T {
  CO_CSDO_STATE_INVALID = 0,  ///< not configured
  CO_CSDO_STATE_IDLE,         ///< ready for a request
  CO_CSDO_STATE_BUSY          ///< a transfer is going on
} CO_CSDO_STATE;

/// The transfer of \a index, \a sub has ended. \a code: 0 = all data are transferred, else the abort code
/// (CO_SDO_ERR_…): the server's, or the client's own: CO_SDO_ERR_TIMEOUT; CO_SDO_ERR_MEM: the object does not fit into
/// the buffer; CO_SDO_ERR_TOS_LOCAL: COCSdoCancel(); CO_SDO_ERR_TOS_STATE: the NMT state no longer allows SDO, or the
/// client's COB-IDs have changed; CO_SDO_ERR_CMD and others of CiA 301: the server does not keep to the protocol. The
/// client is idle again: the next request may be started here. COCSdoGetNum() tells the bytes transferred.
typedef void (*CO_CSDO_CALLBACK_T)(struct CO_CSDO_T* csdo, uint16_t index, uint8_t sub, uint32_t code);

/// One SDO client (1280h, 1281h, …). The application reads State and NodeId and touches nothing else.
typedef struct CO_CSDO_T {
  struct CO_NODE_T* Node;
  CO_CSDO_STATE State;  ///< what the application sees
  uint8_t NodeId;       ///< of the server
  uint8_t Step;         ///< of the protocol
  uint8_t Flags;        ///< of the transfer
  uint8_t Toggle;       ///< toggle bit of the segment under way, in place (00h or 10h)
  uint8_t BlkSize;      ///< segments of a block
  uint8_t Seq;          ///< last segment of the block that was sent, or received in order
  uint8_t AckSeq;       ///< block upload: last acknowledge
  uint8_t Silence;      ///< block upload: quarters of the time-out without a segment
  uint16_t Crc;         ///< of the data so far
  uint32_t RxId;        ///< identifier of the server's frames, as in CO_IF_FRM; FFFF FFFFh: none
  uint32_t TxId;        ///< identifier of the client's frames
  uint32_t WasTxId;     ///< the one before, under which an abort may still wait for the controller
  CO_CSDO_CALLBACK_T Call;
  uint8_t* Buf;    ///< the caller's
  uint32_t Size;   ///< bytes at Buf
  uint32_t Num;    ///< bytes transferred; those of the present block not before it is acknowledged
  uint32_t Total;  ///< bytes that the transfer will have; 0: not known
  uint32_t Key;    ///< CO_DEV() of the object
  uint32_t Ticks;  ///< time-out; 0: none. The result of an access to the own dictionary that was ended
  CO_TMR_MEM Tmr;
} CO_CSDO;

/// Client \a num, from 0. Null: \a node is null, no such client, or 1280h + \a num is missing or not valid. A busy
/// client is returned, too: see State.
CO_CSDO* COCSdoFind(struct CO_NODE_T* node, uint8_t num) CO_NEEDS(USE_CSDO);

/// Reads the object \a key (CO_DEV()) of the server into \a buf, which must live until the callback and may be larger
/// than the object: COCSdoGetNum() tells how much was read. \a timeout in ms for each answer of the server (in a
/// block upload up to a quarter more), 0 waits for ever; what the timer driver cannot count is taken as the longest
/// time it can. CO_ERR_NONE: started, \a callback will come. Else it will not: CO_ERR_BAD_ARG: \a csdo, \a buf or \a
/// callback is null, or \a size is 0; CO_ERR_SDO_OFF: the client is not configured, or the NMT state does not allow
/// SDO; CO_ERR_SDO_BUSY: a transfer is going on; CO_ERR_IF_CAN_SEND: the request found no place in the transmit queue.
CO_ERR COCSdoRequestUpload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                           uint32_t timeout) CO_NEEDS(USE_CSDO);

/// Writes \a size bytes of \a buf to the object \a key of the server. The rest is as with COCSdoRequestUpload().
CO_ERR COCSdoRequestDownload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                             uint32_t timeout) CO_NEEDS(USE_CSDO);

/// Ends the transfer: the server gets an abort 0800 0021h, the callback comes with that code before this returns; or,
/// in a type function of an access to the own dictionary, behind that access.
/// CO_ERR_BAD_ARG: \a csdo is null; CO_ERR_SDO_OFF: no transfer is going on.
CO_ERR COCSdoCancel(CO_CSDO* csdo) CO_NEEDS(USE_CSDO);

/// Bytes that the transfer has carried so far; in the callback and after it, all of them. 0 if \a csdo is null.
uint32_t COCSdoGetNum(const CO_CSDO* csdo) CO_NEEDS(USE_CSDO);

/// Bytes that the transfer will carry; 0: the server has not said, or \a csdo is null.
uint32_t COCSdoGetTotal(const CO_CSDO* csdo) CO_NEEDS(USE_CSDO);

#ifdef __cplusplus
}
#endif

#endif
