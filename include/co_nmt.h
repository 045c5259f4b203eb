// SPDX-License-Identifier: Apache-2.0
/// \file co_nmt.h
/// Network management: the NMT slave, error control (heartbeat, guarding, nodes that are monitored), commands of an NMT
/// master. [301:7.3.2, 7.2.8]
///
/// Node guarding (USE_GUARDING): a remote frame with 700h + node-ID is answered while no heartbeat is produced (1017h
/// is 0 or missing). With the first one life guarding starts, unless 100Ch (guard time in ms) or 100Dh (life time
/// factor) is 0 or missing, or their product is more than the timer can hold: without a further one for that long the
/// NMT master is missing. Both are plain objects (CO_TUNSIGNED16, CO_TUNSIGNED8), read at each remote frame.
/// A data frame with 700h + node-ID, which only this node may send, is reported with EMCY 8150h, and counted as
/// malformed.
///
/// Context: the loop. Called from a type function or callback while a received frame is processed, a reset takes
/// effect when the answer to that frame has been sent.
#ifndef CO_NMT_H_
#define CO_NMT_H_

#include "co_cfg.h"
#include "co_err.h"
#include "co_if.h"
#include "co_needs.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// \name What may be communicated, in CO_NMT.Allowed. [301:7.3.2.2.4]
/// \{
#define CO_NMT_ALLOWED 0x01u   ///< NMT commands and error control
#define CO_BOOT_ALLOWED 0x02u  ///< boot-up
#define CO_EMCY_ALLOWED 0x04u
#define CO_TIME_ALLOWED 0x08u
#define CO_SYNC_ALLOWED 0x10u
#define CO_SDO_ALLOWED 0x20u
#define CO_LSS_ALLOWED 0x80u
#define CO_PDO_ALLOWED 0x40u
/// \}

typedef enum CO_MODE_T {
  CO_INVALID = 0,  ///< not initialised, or stopped by CONodeStop()
  CO_INIT,         ///< Initialisation
  CO_PREOP,        ///< Pre-operational
  CO_OPERATIONAL,  ///< Operational
  CO_STOP,         ///< Stopped
  CO_MODE_NUM
} CO_MODE;

typedef enum CO_NMT_RESET_T {
  CO_RESET_INVALID = 0,
  CO_RESET_NODE,  ///< reset node: application and communication
  CO_RESET_COM,   ///< reset communication
  CO_RESET_NUM
} CO_NMT_RESET;

typedef struct CO_NMT_T {
  struct CO_NODE_T* Node;
  CO_MODE Mode;
  CO_MODE Next;     ///< mode to be entered; Mode unless that is being changed
  uint8_t Allowed;  ///< CO_…_ALLOWED bits of the present mode
  uint8_t Booting;  ///< the node has not been in Pre-operational since it was initialised
} CO_NMT;

/// Resets the node as the NMT command of that name does: transfers end, timers of the stack stop, everything is
/// initialised by the same code as in CONodeInit(). Ends with boot-up and Pre-operational (or Operational, see
/// co_nmt_startup.h), except in CO_INIT, where the node waits for CONodeStart(). Timers of the application go on. \a
/// type other than CO_RESET_NODE and CO_RESET_COM, and a node in CO_INVALID, are ignored. Where there is a real-time
/// thread (CO_NODE_EXT.Mainline), all that waits for the next CONodeProcess().
void CONmtReset(CO_NMT* nmt, CO_NMT_RESET type);

/// Changes the NMT state, as a command of the NMT master would. A node in CO_INVALID, and modes other than CO_PREOP,
/// CO_OPERATIONAL and CO_STOP, are refused with CO_ERR_NMT_MODE (node error). In CO_INIT use CONodeStart() first;
/// firmware that changes the mode from CO_INIT directly gets the boot-up of CONodeStart() before the new mode.
void CONmtSetMode(CO_NMT* nmt, CO_MODE mode);

/// The NMT state. CO_INVALID if \a nmt is null (after CONodeFatalError()).
CO_MODE CONmtGetMode(CO_NMT* nmt);

/// Sets the node-ID (1…127), in CO_INIT only (else node error CO_ERR_NMT_MODE; an ID out of range: CO_ERR_BAD_ARG, and
/// nothing changes). Call CONmtReset(nmt, CO_RESET_NODE) afterwards, so that node-ID relative identifiers follow. A
/// node-ID that COLssLoad() then gives comes before this one.
void CONmtSetNodeId(CO_NMT* nmt, uint8_t nodeId);

/// The node-ID; 0 if \a nmt is null (after CONodeFatalError()).
uint8_t CONmtGetNodeId(CO_NMT* nmt);

/// State byte of a heartbeat (0, 4, 5, 127) as mode; CO_INVALID for any other value. [301:7.2.8.2.2.1]
CO_MODE CONmtModeDecode(uint8_t code);
/// Mode as state byte of a heartbeat; 255 for CO_INVALID and out of range.
uint8_t CONmtModeEncode(CO_MODE mode);

/// How many times a heartbeat of the node \a nodeId was missed since the last call: once each period, at most 255.
/// -1: the node is not monitored (1016h, co_hb_cons.h), or \a nmt is null (after CONodeFatalError()).
int16_t CONmtGetHbEvents(CO_NMT* nmt, uint8_t nodeId) CO_NEEDS(CO_HBCONS_N);

/// The state that the last heartbeat of the node \a nodeId has told. CO_INVALID: a reserved one, none was heard, the
/// node is not monitored, or \a nmt is null (after CONodeFatalError()).
CO_MODE CONmtLastHbState(CO_NMT* nmt, uint8_t nodeId) CO_NEEDS(CO_HBCONS_N);

/// Command specifiers of the NMT master. [301:7.2.8.2.1]
typedef enum CO_NMT_COMMAND_T {
  CO_NMT_COMMAND_START = 1,         ///< enter Operational
  CO_NMT_COMMAND_STOP = 2,          ///< enter Stopped
  CO_NMT_COMMAND_PREOP = 128,       ///< enter Pre-operational
  CO_NMT_COMMAND_RESET_NODE = 129,  ///< reset node
  CO_NMT_COMMAND_RESET_COM = 130    ///< reset communication
} CO_NMT_COMMAND;

/// Commands the node \a nodeId (1…127), or all nodes with 0. This node does what it commands itself, in place of a
/// message or, with 0, after it, as by CONmtSetMode() and CONmtReset().
/// CO_ERR_BAD_ARG: \a nmt is null, no such command, \a nodeId above 127; CO_ERR_NMT_MODE: in CO_INIT and CO_INVALID;
/// CO_ERR_IF_CAN_SEND: the transmit queue is full, nothing was done.
CO_ERR CONmtCommand(CO_NMT* nmt, CO_NMT_COMMAND command, uint8_t nodeId) CO_NEEDS(USE_NMT_MASTER);

/// \name Callbacks of the application
/// Ordinary functions to be defined by the application; the defaults do nothing. Define them in an object file or an
/// object library of the program: linkers ignore a definition in a static library that nothing else needs.
/// \{

/// Before the mode changes to \a mode; CO_NMT.Mode is still the old one. If it asks for another mode, or for
/// CONodeStop(), that is entered in place of \a mode, after it was called for that one, too.
void CONmtModeChange(CO_NMT* nmt, CO_MODE mode);

/// After a reset that the NMT master commanded: the stack is reset and in Pre-operational (or Operational, see
/// co_nmt_startup.h).
void CONmtResetRequest(CO_NMT* nmt, CO_NMT_RESET reset);

/// The monitored node \a nodeId has sent no heartbeat for its time (1016h), again after each further period.
void CONmtHbConsEvent(CO_NMT* nmt, uint8_t nodeId);

/// The monitored node \a nodeId tells another state than before (CONmtLastHbState() still gives that), is back after it
/// was missing, or has sent a boot-up message (CO_INIT). CO_INVALID: a reserved state.
void CONmtHbConsChange(CO_NMT* nmt, uint8_t nodeId, CO_MODE mode);

/// Life guarding: the NMT master is missing (\a occurred), or is back.
void CONmtLifeGuardEvent(CO_NMT* nmt, bool occurred);
/// \}

#ifdef __cplusplus
}
#endif

#endif
