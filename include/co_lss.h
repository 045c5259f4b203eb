// SPDX-License-Identifier: Apache-2.0
/// \file co_lss.h
/// LSS slave: node-ID and bit rate by the network. [305]
///
/// A node is addressed by its identity, the four numbers of 1018h; a dictionary that lacks one of them has no LSS. All
/// services are served in every NMT state (with CO_LSS_IN_OPERATIONAL 0 not in Operational): switch state global and
/// selective, configure node-ID and bit timing, activate bit timing, store, inquire, identify remote and non-configured
/// slave, fastscan.
///
/// A node without node-ID (CO_NODE_SPEC.NodeId or COLssLoad(): CO_LSS_NO_NODE_ID) waits after CONodeStart() in CO_INIT,
/// silent but for LSS. It gets to work, with its boot-up message, when it is switched back to the state waiting with
/// a node-ID. A node that has one takes a new one with the next NMT reset.
///
/// A node in Operational that has to activate a bit rate leaves Operational first: it enters Stopped if 1029h:1 is 2,
/// otherwise Pre-operational. The NMT master starts it again. CO_CALLBACKS.AccessLss may choose another state, and may
/// refuse each service that changes the node (co_callbacks.h).
///
/// While the bit rate is switched no RPDO is applied and nothing is sent: a delay before, which the LSS master
/// commands, and the same after it. Frames wait meanwhile. The CAN driver's Init and Enable are called for the new
/// rate.
///
/// Context: the loop.
#ifndef CO_LSS_H_
#define CO_LSS_H_

#include "co_err.h"
#include "co_needs.h"
#include "co_tmr.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

#define CO_LSS_RX_ID 2021u  ///< 7E5h, from the LSS master
#define CO_LSS_TX_ID 2020u  ///< 7E4h, from the slaves
#define CO_LSS_NO_NODE_ID 255u

#define CO_LSS_WAIT 1u  ///< state waiting
#define CO_LSS_CONF 2u  ///< state configuration

/// \name Command specifiers of services that change the slave
/// \{
#define CO_LSS_SERVICE_SWITCH_GLOBAL 0x04u
#define CO_LSS_SERVICE_NODE_ID 0x11u
#define CO_LSS_SERVICE_BIT_TIMING 0x13u
#define CO_LSS_SERVICE_ACTIVATE 0x15u
#define CO_LSS_SERVICE_STORE 0x17u
#define CO_LSS_SERVICE_SWITCH_SELECTIVE 0x43u  ///< the last of 40h…43h: the whole address has matched
#define CO_LSS_SERVICE_FASTSCAN 0x51u          ///< the whole address has matched
/// \}

/// The LSS slave of a node. The application touches nothing of it.
typedef struct CO_LSS_T {
  struct CO_NODE_T* Node;
  CO_TMR_MEM Tmr;        ///< of the switch delay
  uint32_t Delay;        ///< ticks
  uint32_t OwnBaudrate;  ///< bit/s, of the application: what holds where nothing is stored
  uint32_t CfgBaudrate;  ///< bit/s, to be activated
  uint8_t OwnNodeId;     ///< of the application
  uint8_t CfgNodeId;     ///< of the next reset
  uint8_t Mode;          ///< CO_LSS_WAIT, CO_LSS_CONF
  uint8_t Selected;      ///< parts of the address that have matched: switch state selective
  uint8_t Identified;    ///< the same: identify remote slave
  uint8_t Scanned;       ///< part that fastscan looks for
  uint8_t Started;       ///< CONodeStart() waits for a node-ID
} CO_LSS;

/// \name Callbacks of the application (see co_nmt.h on how to define them)
/// \{

/// What was stored: in CONodeInit(), after the drivers' Init, and at NMT reset node (the bit rate is then left alone).
/// \a baud (bit/s) and \a nodeId (1…127, CO_LSS_NO_NODE_ID) hold what the application has given in CO_NODE_SPEC or by
/// CONmtSetNodeId(): leave unchanged what was not stored. What an LSS master has configured and not stored ends with
/// reset node. [305] An error, or another node-ID, is CO_ERR_LSS_LOAD, and nothing is taken. Default: unchanged.
CO_ERR COLssLoad(uint32_t* baud, uint8_t* nodeId);

/// The LSS master commands to store: \a baud as COLssLoad(), \a nodeId the same. CO_ERR_LSS_NO_STORE is
/// answered by error 1 (not supported), CO_ERR_OBJ_STATE by error 255 with the specific error 22h (the budget of stores
/// is used up, see CO_PARA_BUDGET; 22h as in SDO abort 0800 0022h), any other error by error 2 (access to the medium).
/// Default: CO_ERR_LSS_NO_STORE.
CO_ERR COLssStore(uint32_t baud, uint8_t nodeId);
/// \}

/// \name Ready-made
/// What the callbacks need, over the memory driver of the node (needs USE_PARA):
///
///     CO_ERR COLssLoad(uint32_t* baud, uint8_t* nodeId) { return COLssNvmLoad(&Node, 0, baud, nodeId); }
///     CO_ERR COLssStore(uint32_t baud, uint8_t nodeId) { return COLssNvmStore(&Node, 0, baud, nodeId); }
///
/// The callbacks do not name a node: a program with several has to know which one it is initialising or processing.
/// Never torn with a driver that tells the shape of the memory; they take CO_PARA_SPACE(8, …) bytes there from
/// \a offset on, else 8 bytes.
/// \{

/// Leaves \a baud and \a nodeId unchanged where nothing was stored. CO_ERR_PARA_STORE: no place at \a offset;
/// CO_ERR_IF_NVM_READ: what is stored is damaged, or cannot be read; CO_ERR_BAD_ARG: an argument is null.
CO_ERR COLssNvmLoad(struct CO_NODE_T* node, uint32_t offset, uint32_t* baud, uint8_t* nodeId) CO_NEEDS(LSS_STORAGE);

/// Stores node-ID and bit rate, unless they are stored already. The memory is not checked for an overlap with parameter
/// groups.
/// \retval CO_ERR_NONE          the values are stored
/// \retval CO_ERR_LSS_NO_STORE  the node has no memory
/// \retval CO_ERR_PARA_STORE    no place at \a offset
/// \retval CO_ERR_IF_NVM_WRITE  the memory does not hold the values; the old ones stay
/// \retval CO_ERR_OBJ_STATE     the budget of stores is used up (CO_PARA_BUDGET); only when called in COLssStore()
/// \retval CO_ERR_BAD_ARG       \a node is null
CO_ERR COLssNvmStore(struct CO_NODE_T* node, uint32_t offset, uint32_t baud, uint8_t nodeId) CO_NEEDS(LSS_STORAGE);
/// \}

#ifdef __cplusplus
}
#endif

#endif
