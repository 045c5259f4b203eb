// SPDX-License-Identifier: Apache-2.0
/// \file co_lss_master.h
/// LSS master: gives node-IDs and bit rates to other nodes, and finds those that have none. [305]
///
/// A slave is addressed by four numbers, those of its 1018h: vendor-ID, product code, revision number and serial
/// number. It is configured in its state configuration: COLssmSwitchSelective() leads one slave there, a fastscan the
/// one that it has found, COLssmSwitchGlobal() all of them. The services to configure, store and inquire are answered
/// by every slave in that state, and the first answer is used: only one slave should be in configuration
/// (CO_LSSM.Heard counts the answers). Bit rates may be given to all slaves at once; it is then unknown which refuse.
///
///     COLssmFastscan(&node.Lssm, NULL, 0, found);                                      // whoever has no node-ID
///     void found(CO_LSSM* lssm, CO_LSSM_RESULT result) {
///       if (result == CO_LSSM_OK) COLssmConfigureNodeId(lssm, 5, configured);         // lssm->Address is its address
///     }
///     void configured(CO_LSSM* lssm, CO_LSSM_RESULT result) {
///       if (result == CO_LSSM_OK) COLssmSwitchGlobal(lssm, CO_LSSM_WAITING, waiting); // it boots with node-ID 5
///     }
///
/// A service is started by a function that returns at once: CO_ERR_NONE: the callback will come, once. Else it will
/// not, and nothing has changed: CO_ERR_BAD_ARG: \a lssm or \a callback is null, \a lssm belongs to no initialised
/// node, or an argument is out of the range that is named; CO_ERR_LSS_BUSY: a service is going on; CO_ERR_NMT_MODE: in
/// CO_INIT and CO_INVALID; CO_ERR_IF_CAN_SEND: the request has found no place in the transmit queue. Arrays are copied.
///
/// Several slaves may answer when a slave is looked for (identify, fastscan). These services listen for their whole
/// time, so that none of the answers is left for what follows. The times begin when a request is given to the
/// controller or the transmit queue. A request of several frames leaves 1 ms between them.
///
/// What is not awaited is ignored: other commands, other lengths, answers to nobody's request. An answer that comes
/// after its time is taken if the same service has been started again.
///
/// A node can be slave and master; it does not hear its own requests. Answers (7E4h) are received from the first
/// service on, until the node is reset.
///
/// Context: the loop. Callbacks run in CONodeProcess(), COTmrProcess(), COLssmCancel() and in the functions that stop
/// or reset the node. They may call everything, and start the next service.
#ifndef CO_LSS_MASTER_H_
#define CO_LSS_MASTER_H_

#include "co_err.h"
#include "co_needs.h"
#include "co_tmr.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_LSSM_T;

#define CO_LSSM_TIMEOUT_MS 1000u  ///< for the answer of a slave, unless COLssmSetTimes() says otherwise
#define CO_LSSM_LISTEN_MS 50u     ///< for each request that looks for slaves, unless COLssmSetTimes() says otherwise

/// \name Parts of an LSS address, in the order of 1018h
/// \{
#define CO_LSSM_VENDOR 0u
#define CO_LSSM_PRODUCT 1u
#define CO_LSSM_REVISION 2u
#define CO_LSSM_SERIAL 3u
#define CO_LSSM_PARTS 4u
/// \}

/// \name States of slaves
/// \{
#define CO_LSSM_WAITING 0u
#define CO_LSSM_CONFIGURATION 1u
/// \}

/// How a service has ended.
typedef enum CO_LSSM_RESULT_T {
  CO_LSSM_OK = 0,     ///< done; slaves have answered, if they have to
  CO_LSSM_REFUSED,    ///< the slave refuses: CO_LSSM.Error, CO_LSSM.Specific
  CO_LSSM_TIMEOUT,    ///< no answer
  CO_LSSM_NOT_FOUND,  ///< there is no slave of this kind
  CO_LSSM_NOT_SENT,   ///< a further frame of the service has found no place in the transmit queue
  CO_LSSM_CANCELLED,  ///< COLssmCancel()
  CO_LSSM_STOPPED     ///< the node was stopped or reset
} CO_LSSM_RESULT;

/// A service has ended. The next one may be started here.
typedef void (*CO_LSSM_CALLBACK)(struct CO_LSSM_T* lssm, CO_LSSM_RESULT result);

/// The LSS master of a node. The application reads what is marked so, from the callback until it starts the next
/// service, and touches nothing else.
typedef struct CO_LSSM_T {
  struct CO_NODE_T* Node;           ///< read
  uint32_t Value;                   ///< read: the number inquired
  uint32_t Address[CO_LSSM_PARTS];  ///< read: what a fastscan has found
  uint8_t Error;                    ///< read: error code of a slave that refuses, 1…255
  uint8_t Specific;                 ///< read: the manufacturer's error code, if Error is 255
  uint8_t State;                    ///< of the protocol; 0: no service is going on
  /// Read: answers to the last request, also after the service has ended, until the next request; at most 255. More
  /// than 1 for a service of one slave, some time after its end, or at the end of a fastscan: several slaves have the
  /// same address or are in configuration. Equal answers that slaves transmit in the same moment are one frame.
  uint8_t Heard;
  uint8_t Request;     ///< command of the first frame
  uint8_t Frames;      ///< of the request
  uint8_t Sent;        ///< of these
  uint8_t Answer;      ///< command that is awaited
  uint8_t Then;        ///< State behind the last frame
  uint8_t Known;       ///< fastscan: parts that need no scan
  uint8_t Part;        ///< fastscan: of the address
  uint8_t Bit;         ///< fastscan: the lowest that is compared
  uint8_t Routed;      ///< answers are received
  uint32_t Number[6];  ///< of the frames of the request
  uint32_t Baudrate;   ///< activate bit timing: the own new one, 0: none
  uint32_t Timeout;    ///< ms; 0: CO_LSSM_TIMEOUT_MS
  uint32_t Listen;     ///< ms; 0: CO_LSSM_LISTEN_MS
  CO_LSSM_CALLBACK Call;
  CO_TMR_MEM Tmr;
} CO_LSSM;

/// Sets times in ms from the next request on; CONodeInit() forgets them. \a timeout: for the answer of one slave; a
/// slave that stores may need long. \a listen: how long each request listens that looks for slaves; a fastscan makes up
/// to 133 of them. It should cover the cycle of the slowest slave and the waiting time on a busy bus, where LSS has a
/// low priority. 0: CO_LSSM_TIMEOUT_MS, CO_LSSM_LISTEN_MS. What the timer driver cannot count is taken as the longest
/// time it can. CO_ERR_BAD_ARG: \a lssm is null.
CO_ERR COLssmSetTimes(CO_LSSM* lssm, uint32_t timeout, uint32_t listen) CO_NEEDS(USE_LSS_MASTER);

/// Ends the service that is going on: the callback comes with CO_LSSM_CANCELLED before this returns. What was sent
/// stays sent. CO_ERR_BAD_ARG: \a lssm is null; CO_ERR_NONE, too, if no service is going on.
CO_ERR COLssmCancel(CO_LSSM* lssm) CO_NEEDS(USE_LSS_MASTER);

/// \name State of slaves
/// \{

/// Switches all slaves to \a state, CO_LSSM_WAITING or CO_LSSM_CONFIGURATION. No slave answers: CO_LSSM_OK follows
/// after 1 ms. Slaves without node-ID that were given one get to work in CO_LSSM_WAITING.
CO_ERR COLssmSwitchGlobal(CO_LSSM* lssm, uint8_t state, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Switches the slave with this address, that is in the state waiting, to configuration. CO_LSSM_TIMEOUT: there is
/// none. CO_ERR_BAD_ARG: \a address is null.
CO_ERR COLssmSwitchSelective(CO_LSSM* lssm, const uint32_t address[CO_LSSM_PARTS], CO_LSSM_CALLBACK callback)
    CO_NEEDS(USE_LSS_MASTER);
/// \}

/// \name Slaves in the state configuration
/// \{

/// Gives the slave a node-ID: 1…127, or 255: none. It takes it when it is switched to waiting, if it had none, else
/// with its next NMT reset communication. CO_LSSM_REFUSED with 1: it does not take this one.
CO_ERR COLssmConfigureNodeId(CO_LSSM* lssm, uint8_t nodeId, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Gives the slave a bit rate in bit/s: 1000000, 800000, 500000, 250000, 125000, 50000, 20000, 10000. CO_LSSM_REFUSED
/// with 1: it does not know this one.
CO_ERR COLssmConfigureBitTiming(CO_LSSM* lssm, uint32_t baudrate, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Lets all slaves in configuration take their bit rate. All nodes are silent for \a delay ms, switch, and are silent
/// for \a delay ms again. This node does the same, its frames wait; each time is at least 1 ms here. \a baudrate: the
/// one that this node takes itself, in bit/s; the CAN driver's Init and Enable are called. 0: it leaves its controller
/// alone. CO_LSSM_OK follows when all is over, also if the node is reset meanwhile. Cancelled, it sends again at the
/// bit rate that it then has. CO_ERR_IF_CAN_SEND: frames still wait for the controller.
CO_ERR COLssmActivateBitTiming(CO_LSSM* lssm, uint16_t delay, uint32_t baudrate, CO_LSSM_CALLBACK callback)
    CO_NEEDS(USE_LSS_MASTER);

/// Lets the slave store node-ID and bit rate. CO_LSSM_REFUSED with 1: it cannot store; 2: its memory has failed.
CO_ERR COLssmStore(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Inquires one part of the address of the slave: CO_LSSM_VENDOR…CO_LSSM_SERIAL. The answer is CO_LSSM.Value.
CO_ERR COLssmInquire(CO_LSSM* lssm, uint8_t part, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Inquires the node-ID of the slave: CO_LSSM.Value, 255 if it has none.
CO_ERR COLssmInquireNodeId(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);
/// \}

/// \name Slaves in any state
/// \{

/// Is there a slave in this range? \a range: vendor-ID, product code, lowest and highest revision number, lowest and
/// highest serial number. CO_LSSM_OK or CO_LSSM_NOT_FOUND. CO_ERR_BAD_ARG: \a range is null.
CO_ERR COLssmIdentify(CO_LSSM* lssm, const uint32_t range[6], CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Is there a slave without node-ID? CO_LSSM_OK or CO_LSSM_NOT_FOUND.
CO_ERR COLssmIdentifyUnconfigured(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);
/// \}

/// Finds a slave without node-ID, in the state waiting, and switches it to configuration; its address is
/// CO_LSSM.Address. Of several, it is the one with the lowest address. \a known: the first \a num parts of the address,
/// 0…4, are known and need no scan; may be null if \a num is 0.
/// CO_LSSM_NOT_FOUND: there is none (with these parts). CO_LSSM_TIMEOUT: the slave has not answered when its number was
/// complete: frames were lost, or it is gone. Perhaps it is in configuration: switch all to waiting before scanning
/// again. A slave that answers every request is found as 0, 0, 0, 0, again and again: end a loop of fastscans at an
/// address that was found before, and inquire the identity of what was found. CO_ERR_BAD_ARG: \a num is above 4, or \a
/// known is null though there are any.
CO_ERR COLssmFastscan(CO_LSSM* lssm, const uint32_t* known, uint8_t num, CO_LSSM_CALLBACK callback)
    CO_NEEDS(USE_LSS_MASTER);

#ifdef __cplusplus
}
#endif

#endif
