// SPDX-License-Identifier: Apache-2.0
/// \file co_nmt.h
/// Network management: NMT slave, error control (heartbeat producer and consumer, node and life guarding), commands of
/// an NMT master. [CiA 301, 7.3.2, 7.2.8]
///
/// Node guarding (USE_GUARDING): the node responds to a remote frame with 700h + node-ID while it produces no heartbeat
/// (1017h is 0 or missing). Life guarding starts with the first remote frame, unless 100Ch (guard time in ms) or 100Dh
/// (life time factor) is 0 or missing, or their product is beyond the range of the timer. Without a further remote
/// frame within that time, the NMT master is considered missing. Both objects are plain objects (CO_TUNSIGNED16,
/// CO_TUNSIGNED8), read at each remote frame. A data frame with 700h + node-ID, which no other node may send, is
/// reported with EMCY 8150h and counted as malformed.
///
/// Context: the loop. A state or reset that a type function or callback requests while the node works (a received
/// frame, a timer of the stack, an access) is entered where the outermost call ends, after the response to the frame.
#ifndef CO_NMT_H_
#define CO_NMT_H_

#include "co_cfg.h"
#include "co_err.h"
#include "co_if.h"
#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// \name Services that an NMT state allows, bits of CO_NMT.Allowed. [CiA 301, 7.3.2.2.4]
/// \{
#define CO_NMT_ALLOWED 0x01u   ///< NMT commands and error control
#define CO_BOOT_ALLOWED 0x02u  ///< boot-up
#define CO_EMCY_ALLOWED 0x04u  ///< EMCY
#define CO_TIME_ALLOWED 0x08u  ///< TIME
#define CO_SYNC_ALLOWED 0x10u  ///< SYNC
#define CO_SDO_ALLOWED 0x20u   ///< SDO
#define CO_LSS_ALLOWED 0x80u   ///< LSS
#define CO_PDO_ALLOWED 0x40u   ///< PDO
/// \}

/// NMT states. [CiA 301, 7.3.2.2]
typedef enum CO_MODE_T {
  CO_INVALID = 0,  ///< not initialised, or stopped by CONodeStop()
  CO_INIT,         ///< Initialisation
  CO_PREOP,        ///< Pre-operational
  CO_OPERATIONAL,  ///< Operational
  CO_STOP,         ///< Stopped
  CO_MODE_NUM      ///< number of modes
} CO_MODE;

/// NMT resets. [CiA 301, 7.3.2.2.1]
typedef enum CO_NMT_RESET_T {
  CO_RESET_INVALID = 0,  ///< no reset
  CO_RESET_NODE,         ///< reset node: application and communication
  CO_RESET_COM,          ///< reset communication
  CO_RESET_NUM           ///< number of values
} CO_NMT_RESET;

/// The NMT slave of a node: &node.Nmt, a handle for the functions below.
typedef struct CO_NMT_T {
  struct CO_NODE_T* Node;  ///< owner
  CO_MODE Mode;            ///< present mode, see CONmtGetMode()
  CO_MODE Next;            ///< mode that was requested last; equal to Mode unless a change is pending
  uint8_t Allowed;         ///< CO_…_ALLOWED bits of the present mode
  uint8_t Booting;         ///< the node has not been in Pre-operational since its initialisation
} CO_NMT;

/// Resets the node like the NMT command: ends transfers, stops the timers of the stack, and initialises everything as
/// CONodeInit() does. Then sends the boot-up message and enters Pre-operational (or Operational, see co_nmt.h),
/// except in CO_INIT, where the node waits for CONodeStart(). Timers of the application continue. Has no effect if \a
/// type is neither CO_RESET_NODE nor CO_RESET_COM, or if the node is in CO_INVALID. With a real-time thread
/// (CO_NODE_EXT.Mainline) the reset is deferred to the next CONodeProcess().
void CONmtReset(CO_NMT* nmt, CO_NMT_RESET type);

/// Changes the NMT state like a command of the NMT master. In CO_INVALID, and for modes other than CO_PREOP,
/// CO_OPERATIONAL and CO_STOP, the change is refused with the node error CO_ERR_NMT_MODE. In CO_INIT, call
/// CONodeStart() first; if the firmware changes the mode from CO_INIT
/// directly, the boot-up message is sent and Pre-operational is entered before the change. Of several states that
/// callbacks request, the last one is entered.
void CONmtSetMode(CO_NMT* nmt, CO_MODE mode);

/// Returns the NMT state, or the one that was requested and is entered where the outermost call ends; CO_INVALID if
/// \a nmt is null (after CONodeFatalError()).
CO_MODE CONmtGetMode(CO_NMT* nmt);

/// Sets the node-ID, 1…127, in CO_INIT. Call CONmtReset(nmt, CO_RESET_NODE) afterwards, which updates the identifiers
/// that are relative to the node-ID. A node-ID that COLssLoad() returns then has priority. On an error nothing changes:
/// node error CO_ERR_NMT_MODE (not in CO_INIT) or CO_ERR_BAD_ARG (out of range).
void CONmtSetNodeId(CO_NMT* nmt, uint8_t nodeId);

/// Returns the node-ID; 0 if \a nmt is null (after CONodeFatalError()).
uint8_t CONmtGetNodeId(CO_NMT* nmt);

/// Converts the state byte of a heartbeat (0, 4, 5, 127) to a mode; CO_INVALID for any other value. [CiA
/// 301, 7.2.8.2.2.1]
CO_MODE CONmtModeDecode(uint8_t code);
/// Converts a mode to the state byte of a heartbeat; 255 for CO_INVALID and values out of range.
uint8_t CONmtModeEncode(CO_MODE mode);

/// Returns the number of missed heartbeats of node \a nodeId since the last call: one for each period, at most 255.
/// \retval -1  the node is not monitored (1016h, co_heartbeat.h), or \a nmt is null (after CONodeFatalError())
int16_t CONmtGetHbEvents(CO_NMT* nmt, uint8_t nodeId) CO_NEEDS(CO_HBCONS_N);

/// Returns the NMT state of node \a nodeId in its last heartbeat.
/// \retval CO_INVALID  the state byte was a reserved one, no heartbeat was received, the node is not monitored, or \a
///                     nmt is null (after CONodeFatalError())
CO_MODE CONmtLastHbState(CO_NMT* nmt, uint8_t nodeId) CO_NEEDS(CO_HBCONS_N);

/// Command specifiers of the NMT master. [CiA 301, 7.2.8.2.1]
typedef enum CO_NMT_COMMAND_T {
  CO_NMT_COMMAND_START = 1,         ///< enter Operational
  CO_NMT_COMMAND_STOP = 2,          ///< enter Stopped
  CO_NMT_COMMAND_PREOP = 128,       ///< enter Pre-operational
  CO_NMT_COMMAND_RESET_NODE = 129,  ///< reset node
  CO_NMT_COMMAND_RESET_COM = 130    ///< reset communication
} CO_NMT_COMMAND;

/// Sends an NMT command to node \a nodeId (1…127), or to all nodes with 0. A command that addresses this node is
/// executed like CONmtSetMode() or CONmtReset(): instead of a message, or with 0 after it.
/// \retval CO_ERR_NONE         the command is sent, or executed
/// \retval CO_ERR_BAD_ARG      \a nmt is null, there is no such command, or \a nodeId is above 127
/// \retval CO_ERR_NMT_MODE     the node is in CO_INIT or CO_INVALID
/// \retval CO_ERR_IF_CAN_SEND  the transmit queue is full; nothing is sent or executed
CO_ERR CONmtCommand(CO_NMT* nmt, CO_NMT_COMMAND command, uint8_t nodeId) CO_NEEDS(USE_NMT_MASTER);

/// \name 1F80h, NMT startup
/// [CiA 302-2] Data: a uint32_t, or the value itself (flag D). Bit 2 = 0: self-start: after CONodeStart() and after
/// every reset the node enters Operational, once, as soon as it is in Pre-operational. Bit 2 = 1, or no such object: it
/// stays in Pre-operational. A mode that CONmtModeChange() requests has priority. The other bits configure how an NMT
/// master boots a network (bit 0: this node is the master; bits 1 and 3…6: how it starts the other nodes and reacts to
/// missing ones). This is implemented by the application, with CONmtCommand(): the node ignores these bits and refuses
/// to change them (CO_ERR_OBJ_RANGE, 0609 0030h).
/// \{

#define CO_NMT_STARTUP_STAY 0x04u  ///< bit 2: no self-start

extern const CO_OBJ_TYPE COTNmtStartup;  ///< functions of CO_TNMT_STARTUP

#define CO_TNMT_STARTUP ((const CO_OBJ_TYPE*)&COTNmtStartup)  ///< type of 1F80h
/// \}

/// \name 1029h, error behaviour
/// [CiA 301, 7.5.2.32] Data: a uint8_t, or the value itself (flag D). Sub 1 is the reaction to the loss of the network:
/// bus-off, a missing heartbeat of a monitored node, or a missing NMT master (life guarding). 0, or without the object:
/// a node in Operational enters Pre-operational; 1: none; 2: the node enters Stopped, also from Pre-operational. The
/// reaction occurs once for each loss. Sub 2...254 are the reactions to errors of the device, which the application
/// executes by COErrorBehaviour(). All other values are refused (0609 0030h).
/// \{

enum {
  CO_ERROR_BEHAVIOUR_PREOP = 0,  ///< from Operational to Pre-operational
  CO_ERROR_BEHAVIOUR_NONE = 1,   ///< no change of the NMT state
  CO_ERROR_BEHAVIOUR_STOP = 2,   ///< from Operational or Pre-operational to Stopped
};

extern const CO_OBJ_TYPE COTErrorBehaviour;  ///< functions of CO_TERROR_BEHAVIOUR

#define CO_TERROR_BEHAVIOUR ((const CO_OBJ_TYPE*)&COTErrorBehaviour)  ///< type of 1029h

/// Executes the reaction of 1029h sub-index \a sub, 1...254, to an error of the device: enters Pre-operational or
/// Stopped, or keeps the NMT state, like the reaction to the loss of the network (sub 1). Without the entry it is
/// CO_ERROR_BEHAVIOUR_PREOP, the default for serious device failures. To be called once when the error occurs. An
/// EMCY message should be sent before (COEmcySet()), because Stopped does not allow it. Context: the loop.
/// \retval CO_ERR_NONE      the reaction was executed
/// \retval CO_ERR_BAD_ARG   \a node is null, or \a sub is 0 or 255
/// \retval CO_ERR_NMT_MODE  the node is in CO_INIT or CO_INVALID
CO_ERR COErrorBehaviour(struct CO_NODE_T* node, uint8_t sub);
/// \}

/// \name As in CANopen-Stack: callbacks
/// Functions that the application may define for all nodes; the defaults do nothing. CO_CALLBACKS (co_callbacks.h) has
/// functions of one node for the same events. Define them in an object file or an object library of the program:
/// linkers ignore a definition in a static library from which nothing else is needed.
/// \{

/// Called before the mode changes to \a mode; CO_NMT.Mode is still the old one. If the callback requests another mode,
/// or calls CONodeStop(), that mode is entered instead of \a mode, after a further call of the callback for it.
void CONmtModeChange(CO_NMT* nmt, CO_MODE mode);

/// Called after a reset by a command of the NMT master, when the node is in Pre-operational (or Operational, see
/// co_nmt.h) again.
void CONmtResetRequest(CO_NMT* nmt, CO_NMT_RESET reset);

/// Called when the monitored node \a nodeId has sent no heartbeat within its time (1016h), and again after each further
/// period.
void CONmtHbConsEvent(CO_NMT* nmt, uint8_t nodeId);

/// Called when the monitored node \a nodeId reports a new state (CONmtLastHbState() still returns the previous one), is
/// back after it was missing, or has sent a boot-up message (CO_INIT). \a mode is CO_INVALID for reserved states;
/// a change from one reserved state to another is not a new state.
void CONmtHbConsChange(CO_NMT* nmt, uint8_t nodeId, CO_MODE mode);

/// Called by life guarding when the NMT master is missing (\a occurred true), or is back (false).
void CONmtLifeGuardEvent(CO_NMT* nmt, bool occurred);
/// \}

#ifdef __cplusplus
}
#endif

#endif
