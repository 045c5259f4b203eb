// SPDX-License-Identifier: Apache-2.0
/// \file co_csdo.h
/// SDO clients: read and write objects of other nodes, and of this node. [CiA 301, 7.2.4]
///
/// A client is configured by 1280h + n: sub 1 COB-ID of its requests, sub 2 COB-ID of the responses, sub 3 node-ID of
/// the server. [CiA 301, 7.5.2.34] The COB-IDs are complete identifiers (600h + node-ID, 580h + node-ID, or any other).
/// The plain values 600h and 580h, as in tables written for CANopen-Stack, get the node-ID of sub 3 added, because as
/// complete identifiers they would belong to the invalid node-ID 0. The entries are read at every request.
///
/// If sub 3 is the node-ID of this node, the request reads or writes the own dictionary with the rights of the network,
/// in one piece of any length; nothing is sent. The COB-IDs have to be valid in this case, too. With USE_CSDO_OWN 0
/// such a client is not configured.
///
/// The stack selects the kind of transfer: expedited up to 4 bytes; block transfer from CO_CSDO_BLOCK bytes on
/// (0: never), with fallback to a segmented transfer if the server refuses it; otherwise segmented.
///
/// Every request that was started calls its callback once: when the transfer is complete, was aborted by either side,
/// has timed out, was cancelled, or when the NMT state no longer allows SDO. Numbers are not converted: the buffer
/// holds the bytes in the order of the bus (little endian).
///
/// Clients with the same COB-ID of the responses cannot distinguish their responses if they access the same object at
/// the same time: each client consumes the response. A callback must not start a request of another such client for the
/// same object.
///
/// Context: the loop. Callbacks run in CONodeProcess(), COTmrProcess(), COCSdoCancel(), in the functions that change
/// the NMT state, and in writes to 1280h… that change the COB-IDs of a busy client, whose server then receives an
/// abort.
#ifndef CO_CSDO_H_
#define CO_CSDO_H_

#include "co_cfg.h"
#include "co_err.h"
#include "co_sdo.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_CSDO_T;

/// State of an SDO client.
typedef enum CO_CSDO_STATE_T {
  CO_CSDO_STATE_INVALID = 0,  ///< not configured
  CO_CSDO_STATE_IDLE,         ///< ready for a request
  CO_CSDO_STATE_BUSY          ///< a transfer is in progress
} CO_CSDO_STATE;

/// Called when the transfer of \a index, \a sub has ended. The client is idle again: the callback may start the next
/// request. COCSdoGetNum() returns the number of bytes transferred. \a code is 0 if all data were transferred,
/// otherwise the abort code of the server, or one of the client:
/// - CO_SDO_ERR_TIMEOUT: the server has not responded in time;
/// - CO_SDO_ERR_MEM: the object does not fit into the buffer;
/// - CO_SDO_ERR_TOS_LOCAL: COCSdoCancel() was called;
/// - CO_SDO_ERR_TOS_STATE: the NMT state no longer allows SDO, or the client's COB-IDs have changed;
/// - CO_SDO_ERR_CMD and others of CiA 301: the server violates the protocol.
typedef void (*CO_CSDO_CALLBACK_T)(struct CO_CSDO_T* csdo, uint16_t index, uint8_t sub, uint32_t code);

/// An SDO client (1280h, 1281h, …). The application may read State and NodeId and must not access other members.
typedef struct CO_CSDO_T {
  struct CO_NODE_T* Node;   ///< owner
  CO_CSDO_STATE State;      ///< state for the application
  uint8_t NodeId;           ///< node-ID of the server
  CO_SDO_FLOW Flow;         ///< data of the transfer; Size: bytes at Buf, until the server announces the size
  uint32_t RxId;            ///< identifier of the server's frames, as in CO_IF_FRM; FFFF FFFFh: none
  uint32_t TxId;            ///< identifier of the client's frames
  uint32_t WasTxId;         ///< previous TxId, under which an abort may still be in the transmit queue
  CO_CSDO_CALLBACK_T Call;  ///< callback of the transfer
  uint8_t* Buf;             ///< buffer, owned by the caller
  uint32_t Key;             ///< CO_DEV() of the object
  uint32_t Ticks;           ///< time-out in ticks; 0: none
  CO_TMR_MEM Tmr;           ///< time-out, or start of an access to the own dictionary
} CO_CSDO;

/// Returns client \a num, from 0. A busy client is returned, too: see State.
/// \retval null  \a node is null, there is no such client, or 1280h + \a num is missing or not valid
CO_CSDO* COCSdoFind(struct CO_NODE_T* node, uint8_t num) CO_NEEDS(USE_CSDO);

/// Starts to read the object \a key (CO_DEV()) of the server into \a buf of \a size bytes. The caller owns the buffer,
/// which must stay valid until the callback; it may be larger than the object: COCSdoGetNum() returns the number of
/// bytes read. \a timeout in ms applies to each response of the server that continues the transfer (in a block upload
/// up to a quarter more); 0: no time-out; a time beyond the range of the timer is treated as the longest possible one.
/// \retval CO_ERR_NONE         the transfer has started; \a callback will be called once. On an error it is not called
/// \retval CO_ERR_BAD_ARG      \a csdo, \a buf or \a callback is null, or \a size is 0
/// \retval CO_ERR_SDO_OFF      the client is not configured, or the NMT state does not allow SDO
/// \retval CO_ERR_SDO_BUSY     a transfer is in progress
/// \retval CO_ERR_IF_CAN_SEND  the transmit queue is full
CO_ERR COCSdoRequestUpload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                           uint32_t timeout) CO_NEEDS(USE_CSDO);

/// Starts to write \a size bytes of \a buf to the object \a key of the server; 0 bytes empty a string or a domain. The
/// parameters are those of COCSdoRequestUpload().
/// \retval CO_ERR_NONE         the transfer has started; \a callback will be called once. On an error it is not called
/// \retval CO_ERR_BAD_ARG      \a csdo, \a buf or \a callback is null
/// \retval CO_ERR_SDO_OFF      the client is not configured, or the NMT state does not allow SDO
/// \retval CO_ERR_SDO_BUSY     a transfer is in progress
/// \retval CO_ERR_IF_CAN_SEND  the transmit queue is full
CO_ERR COCSdoRequestDownload(CO_CSDO* csdo, uint32_t key, uint8_t* buf, uint32_t size, CO_CSDO_CALLBACK_T callback,
                             uint32_t timeout) CO_NEEDS(USE_CSDO);

/// Cancels the transfer: sends the abort 0800 0021h to the server and calls the callback with that code before the
/// function returns. When called by a type function during an access to the own dictionary, the callback runs after
/// that access.
/// \retval CO_ERR_NONE     the transfer is cancelled
/// \retval CO_ERR_BAD_ARG  \a csdo is null
/// \retval CO_ERR_SDO_OFF  no transfer is in progress
CO_ERR COCSdoCancel(CO_CSDO* csdo) CO_NEEDS(USE_CSDO);

/// Returns the number of bytes transferred so far; in the callback and after it, the total. 0 if \a csdo is null.
uint32_t COCSdoGetNum(const CO_CSDO* csdo) CO_NEEDS(USE_CSDO);

/// Returns the number of bytes that the transfer will have; 0: the server has not announced it, or \a csdo is null.
uint32_t COCSdoGetTotal(const CO_CSDO* csdo) CO_NEEDS(USE_CSDO);

#ifdef __cplusplus
}
#endif

#endif
