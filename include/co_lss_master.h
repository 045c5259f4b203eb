// SPDX-License-Identifier: Apache-2.0
/// \file co_lss_master.h
/// LSS master: configures node-IDs and bit rates of other nodes, and finds unconfigured nodes. [CiA 305]
///
/// A slave is addressed by four numbers, those of its 1018h: vendor-ID, product code, revision number and serial
/// number. It is configured in the LSS state configuration: COLssmSwitchSelective() switches one slave to this state,
/// COLssmFastscan() the slave that it finds, COLssmSwitchGlobal() all slaves. Every slave in this state responds to the
/// services configure, store and inquire, and the first response is used: only one slave should be in this state
/// (CO_LSSM.Heard counts the responses). Bit rates may be configured in all slaves at once; it is then unknown which
/// slaves refuse.
///
///     COLssmFastscan(&node.Lssm, NULL, 0, found);                                      // a node without node-ID
///     void found(CO_LSSM* lssm, CO_LSSM_RESULT result) {
///       if (result == CO_LSSM_OK) COLssmConfigureNodeId(lssm, 5, configured);         // lssm->Address is its address
///     }
///     void configured(CO_LSSM* lssm, CO_LSSM_RESULT result) {
///       if (result == CO_LSSM_OK) COLssmSwitchGlobal(lssm, CO_LSSM_WAITING, waiting); // it boots with node-ID 5
///     }
///
/// Each function that starts a service returns at once, and the callback reports the result. Arrays are copied. All
/// these functions return:
/// \retval CO_ERR_NONE         the service has started; the callback will be called once. On an error it is not called,
///                             and nothing has changed
/// \retval CO_ERR_BAD_ARG      \a lssm or \a callback is null, \a lssm belongs to no initialised node, or an argument
///                             is out of its range
/// \retval CO_ERR_LSS_BUSY     a service is in progress
/// \retval CO_ERR_NMT_MODE     the node is in CO_INIT or CO_INVALID
/// \retval CO_ERR_IF_CAN_SEND  the transmit queue is full
///
/// Several slaves may respond to the services that search for slaves (identify, fastscan). These services receive
/// responses for their whole time, so that no late response is taken for one to the next service. Times begin when a
/// request is given to the controller or the transmit queue. A request of several frames leaves 1 ms between them.
///
/// Unexpected frames are ignored: other commands, other lengths, responses without a request. A response that arrives
/// after its time-out is used if the same service was started again.
///
/// A node can be slave and master; it does not receive its own requests. Responses (7E4h) are received from the first
/// service on, until the node is reset.
///
/// Context: the loop. Callbacks run in CONodeProcess(), COTmrProcess(), COLssmCancel() and in the functions that stop
/// or reset the node. They may call any function and start the next service.
#ifndef CO_LSS_MASTER_H_
#define CO_LSS_MASTER_H_

#include "co_err.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_LSSM_T;

#define CO_LSSM_TIMEOUT_MS 1000u  ///< default time-out for the response of a slave, see COLssmSetTimes()
/// Default time for responses to a request that searches for slaves, see COLssmSetTimes().
#define CO_LSSM_LISTEN_MS 50u

/// \name Parts of an LSS address, in the order of 1018h
/// \{
enum {
  CO_LSSM_VENDOR = 0,    ///< vendor-ID
  CO_LSSM_PRODUCT = 1,   ///< product code
  CO_LSSM_REVISION = 2,  ///< revision number
  CO_LSSM_SERIAL = 3,    ///< serial number
  CO_LSSM_PARTS = 4,     ///< number of parts
};
/// \}

/// \name States of slaves
/// \{
enum {
  CO_LSSM_WAITING = 0,        ///< LSS state waiting
  CO_LSSM_CONFIGURATION = 1,  ///< LSS state configuration
};
/// \}

/// Result of a service.
typedef enum CO_LSSM_RESULT_T {
  CO_LSSM_OK = 0,     ///< success; slaves have responded, if the service has a response
  CO_LSSM_REFUSED,    ///< the slave has refused: CO_LSSM.Error, CO_LSSM.Specific
  CO_LSSM_TIMEOUT,    ///< no response
  CO_LSSM_NOT_FOUND,  ///< there is no such slave
  CO_LSSM_NOT_SENT,   ///< a further frame of the service was not sent: the transmit queue is full
  CO_LSSM_CANCELLED,  ///< COLssmCancel() was called
  CO_LSSM_STOPPED     ///< the node was stopped or reset
} CO_LSSM_RESULT;

/// Called when a service has ended. The callback may start the next service.
typedef void (*CO_LSSM_CALLBACK)(struct CO_LSSM_T* lssm, CO_LSSM_RESULT result);

/// The LSS master of a node. The application may read members marked "read", from the callback on until the next
/// service starts, and must not access other members.
typedef struct CO_LSSM_T {
  struct CO_NODE_T* Node;           ///< read
  uint32_t Value;                   ///< read: result of an inquiry
  uint32_t Address[CO_LSSM_PARTS];  ///< read: address found by a fastscan
  uint8_t Error;                    ///< read: error code of a slave that has refused, 1…255
  uint8_t Specific;                 ///< read: the manufacturer's error code, if Error is 255
  uint8_t State;                    ///< state of the protocol; 0: no service is in progress
  /// Read: number of responses to the last request, at most 255; counted until the next request, also after the end of
  /// the service. More than 1 response to a service for one slave (some time after its end), or at the end of a
  /// fastscan, means that several slaves have the same address or are in configuration. Equal responses that slaves
  /// transmit at the same moment appear as one frame.
  uint8_t Heard;
  uint8_t Request;        ///< command specifier of the first frame
  uint8_t Frames;         ///< number of frames of the request
  uint8_t Sent;           ///< number of frames sent
  uint8_t Answer;         ///< command specifier of the expected response
  uint8_t Then;           ///< value of State after the last frame
  uint8_t Known;          ///< fastscan: number of parts that need no scan
  uint8_t Part;           ///< fastscan: current part of the address
  uint8_t Bit;            ///< fastscan: lowest bit that is compared
  uint8_t Routed;         ///< a route for responses exists
  uint32_t Number[6];     ///< parameters of the frames of the request
  uint32_t Baudrate;      ///< activate bit timing: new bit rate of this node, 0: unchanged
  uint32_t Timeout;       ///< time-out for responses in ms; 0: CO_LSSM_TIMEOUT_MS
  uint32_t Listen;        ///< time for responses of a search in ms; 0: CO_LSSM_LISTEN_MS
  CO_LSSM_CALLBACK Call;  ///< callback of the service in progress
  CO_TMR_MEM Tmr;         ///< time-out, time between two frames, or switch delay
} CO_LSSM;

/// Sets times in ms, from the next request on until CONodeInit(). \a timeout: for the response of one slave; a slave
/// may need long to store. \a listen: time for responses to each request that searches for slaves; a fastscan sends up
/// to 133 of them. It should cover the cycle of the slowest slave and the delay on a busy bus, where LSS has a low
/// priority. 0: CO_LSSM_TIMEOUT_MS, CO_LSSM_LISTEN_MS. Times beyond the timer's range are limited to the longest
/// possible time.
/// \retval CO_ERR_NONE     the times are set
/// \retval CO_ERR_BAD_ARG  \a lssm is null
CO_ERR COLssmSetTimes(CO_LSSM* lssm, uint32_t timeout, uint32_t listen) CO_NEEDS(USE_LSS_MASTER);

/// Cancels the service in progress: calls its callback with CO_LSSM_CANCELLED before it returns. Frames already sent or
/// queued are not withdrawn.
/// \retval CO_ERR_NONE     the service is cancelled, or no service is in progress
/// \retval CO_ERR_BAD_ARG  \a lssm is null
CO_ERR COLssmCancel(CO_LSSM* lssm) CO_NEEDS(USE_LSS_MASTER);

/// \name State of slaves
/// \{

/// Switches all slaves to \a state, CO_LSSM_WAITING or CO_LSSM_CONFIGURATION. There is no response: the result is
/// CO_LSSM_OK after 1 ms. CO_LSSM_WAITING starts unconfigured slaves that have received a node-ID.
CO_ERR COLssmSwitchGlobal(CO_LSSM* lssm, uint8_t state, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Switches the slave with this address from the state waiting to configuration. \a address must not be null. Result
/// CO_LSSM_TIMEOUT: there is no such slave.
CO_ERR COLssmSwitchSelective(CO_LSSM* lssm, const uint32_t address[CO_LSSM_PARTS], CO_LSSM_CALLBACK callback)
    CO_NEEDS(USE_LSS_MASTER);
/// \}

/// \name Slaves in the state configuration
/// \{

/// Configures the node-ID of the slave: 1…127, or 255: none. A slave without node-ID uses it when it is switched to
/// waiting, any other with its next NMT reset communication. Result CO_LSSM_REFUSED with Error 1: the slave does not
/// accept this node-ID.
CO_ERR COLssmConfigureNodeId(CO_LSSM* lssm, uint8_t nodeId, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Configures the bit rate of the slave in bit/s: 1000000, 800000, 500000, 250000, 125000, 50000, 20000, 10000. Result
/// CO_LSSM_REFUSED with Error 1: the slave does not support this bit rate.
CO_ERR COLssmConfigureBitTiming(CO_LSSM* lssm, uint32_t baudrate, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Activates the configured bit rate in all slaves in configuration. All nodes stop sending for \a delay ms, switch,
/// and stop sending for \a delay ms again. This node does the same and queues its frames; each time is at least 1 ms in
/// this node. \a baudrate: new bit rate of this node in bit/s, set by the CAN driver's Init and Enable; 0: the
/// controller is not changed. Result CO_LSSM_OK at the end of both times, also if the node is reset meanwhile. After
/// COLssmCancel() the node sends again at its present bit rate. Returns CO_ERR_IF_CAN_SEND also if frames are in the
/// transmit queue.
CO_ERR COLssmActivateBitTiming(CO_LSSM* lssm, uint16_t delay, uint32_t baudrate, CO_LSSM_CALLBACK callback)
    CO_NEEDS(USE_LSS_MASTER);

/// Requests the slave to store node-ID and bit rate. Result CO_LSSM_REFUSED with Error 1: storing is not supported; 2:
/// the slave's memory failed.
CO_ERR COLssmStore(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Inquires one part of the address of the slave, CO_LSSM_VENDOR…CO_LSSM_SERIAL. The result is in CO_LSSM.Value.
CO_ERR COLssmInquire(CO_LSSM* lssm, uint8_t which, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Inquires the node-ID of the slave. The result is in CO_LSSM.Value, 255 if it has none.
CO_ERR COLssmInquireNodeId(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);
/// \}

/// \name Slaves in any state
/// \{

/// Checks whether there is a slave in an address range: CO_LSSM_OK or CO_LSSM_NOT_FOUND. \a range: vendor-ID, product
/// code, lowest and highest revision number, lowest and highest serial number; not null.
CO_ERR COLssmIdentify(CO_LSSM* lssm, const uint32_t range[6], CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);

/// Checks whether there is a slave without node-ID: CO_LSSM_OK or CO_LSSM_NOT_FOUND.
CO_ERR COLssmIdentifyUnconfigured(CO_LSSM* lssm, CO_LSSM_CALLBACK callback) CO_NEEDS(USE_LSS_MASTER);
/// \}

/// Finds a slave without node-ID in the state waiting and switches it to configuration. Its address is in
/// CO_LSSM.Address; if there are several slaves, it is the one with the lowest address. \a known: the first \a num
/// parts of the address (0…4), which are not scanned; may be null if \a num is 0. Results:
/// - CO_LSSM_NOT_FOUND: there is no such slave;
/// - CO_LSSM_TIMEOUT: the slave did not respond when its address was complete, because frames were lost or it was
///   removed. It may be in configuration: switch all slaves to waiting before the next scan.
///
/// A slave that responds to every request is found as 0, 0, 0, 0 repeatedly: end a loop of fastscans at an address that
/// was found before, and inquire the identity of the slave. Returns CO_ERR_BAD_ARG also if \a num is above 4, or \a
/// known is null and \a num is not 0.
CO_ERR COLssmFastscan(CO_LSSM* lssm, const uint32_t* known, uint8_t num, CO_LSSM_CALLBACK callback)
    CO_NEEDS(USE_LSS_MASTER);

#ifdef __cplusplus
}
#endif

#endif
