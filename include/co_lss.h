// SPDX-License-Identifier: Apache-2.0
/// \file co_lss.h
/// LSS slave: configuration of node-ID and bit rate by the network. [CiA 305]
///
/// An LSS master addresses a node by its identity, the four numbers of 1018h; without all four of them in the
/// dictionary LSS is disabled. All services work in every NMT state (with CO_LSS_IN_OPERATIONAL 0 not in Operational):
/// switch state global and selective, configure node-ID and bit timing, activate bit timing, store, inquire, identify
/// remote and non-configured slave, fastscan.
///
/// An unconfigured node (CO_NODE_SPEC.NodeId or COLssLoad(): CO_LSS_NO_NODE_ID) stays in CO_INIT after CONodeStart()
/// and sends only LSS. It sends its boot-up message and starts when an LSS master has configured a node-ID and switches
/// it to the state waiting. A node that already has a node-ID uses a new one after the next NMT reset.
///
/// A node in Operational that has to activate a bit rate leaves Operational first: it enters Stopped if 1029h:1 is 2,
/// otherwise Pre-operational. The NMT master has to start it again. CO_CALLBACKS.AccessLss may choose another state,
/// and may refuse each service that changes the node (co_callbacks.h).
///
/// Activating a bit rate takes twice the switch delay that the LSS master commands: once before and once after the
/// switch. In that time no RPDO is processed and nothing is sent; frames are queued. The CAN driver's Init and Enable
/// are called for the new bit rate.
///
/// Context: the loop.
#ifndef CO_LSS_H_
#define CO_LSS_H_

#include "co_err.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

#define CO_LSS_RX_ID 2021u      ///< 7E5h, from the LSS master
#define CO_LSS_TX_ID 2020u      ///< 7E4h, from the slaves
#define CO_LSS_NO_NODE_ID 255u  ///< in place of a node-ID: unconfigured

#define CO_LSS_WAIT 1u  ///< state waiting
#define CO_LSS_CONF 2u  ///< state configuration

/// \name Command specifiers of services that change the slave
/// \{
enum {
  CO_LSS_SERVICE_SWITCH_GLOBAL = 0x04,     ///< switch state global
  CO_LSS_SERVICE_NODE_ID = 0x11,           ///< configure node-ID
  CO_LSS_SERVICE_BIT_TIMING = 0x13,        ///< configure bit timing parameters
  CO_LSS_SERVICE_ACTIVATE = 0x15,          ///< activate bit timing parameters
  CO_LSS_SERVICE_STORE = 0x17,             ///< store configuration
  CO_LSS_SERVICE_SWITCH_SELECTIVE = 0x43,  ///< switch state selective: whole address has matched (last of 40h…43h)
  CO_LSS_SERVICE_FASTSCAN = 0x51,          ///< fastscan: whole address has matched
};
/// \}

/// The LSS slave of a node. The application must not access its members.
typedef struct CO_LSS_T {
  struct CO_NODE_T* Node;  ///< owner
  CO_TMR_MEM Tmr;          ///< switch delay
  uint32_t Delay;          ///< switch delay in ticks
  uint32_t OwnBaudrate;    ///< bit/s, from the application: used if nothing is stored
  uint32_t CfgBaudrate;    ///< bit/s, configured, to be activated
  uint8_t OwnNodeId;       ///< from the application: used if nothing is stored
  uint8_t CfgNodeId;       ///< configured, used after the next reset
  uint8_t Mode;            ///< LSS state: CO_LSS_WAIT, CO_LSS_CONF
  uint8_t Selected;        ///< switch state selective: number of address parts that have matched
  uint8_t Identified;      ///< identify remote slave: number of address parts that have matched
  uint8_t Scanned;         ///< fastscan: current part of the address
  uint8_t Started;         ///< CONodeStart() is pending until the node has a node-ID
} CO_LSS;

/// \name Callbacks of the application (see co_nmt.h on how to define them)
/// \{

/// Loads the stored node-ID and bit rate. Called in CONodeInit(), after the Init functions of the drivers, and at NMT
/// reset node (the bit rate is then ignored). \a baud (bit/s) and \a nodeId (1…127, CO_LSS_NO_NODE_ID) hold the values
/// of CO_NODE_SPEC or CONmtSetNodeId(): leave unchanged what was not stored. Values that an LSS master has configured
/// but not stored are lost at reset node. [CiA 305] The default leaves both unchanged.
/// \retval CO_ERR_NONE  both are loaded or unchanged; if \a nodeId is none of these values, nothing is loaded and the
///                      node's error is CO_ERR_LSS_LOAD
/// \retval other        nothing is loaded; the node's error is CO_ERR_LSS_LOAD
CO_ERR COLssLoad(uint32_t* baud, uint8_t* nodeId);

/// Stores \a baud (bit/s) and \a nodeId (1…127, CO_LSS_NO_NODE_ID). Called for the LSS service store. The default
/// returns CO_ERR_LSS_NO_STORE.
/// \retval CO_ERR_NONE          the values are stored
/// \retval CO_ERR_LSS_NO_STORE  storing is not supported: the response is error 1
/// \retval CO_ERR_OBJ_STATE     the budget of stores is used up (CO_PARA_BUDGET): the response is error 255 with the
///                              specific error 22h, as in SDO abort 0800 0022h
/// \retval other                the memory could not be accessed: the response is error 2
CO_ERR COLssStore(uint32_t baud, uint8_t nodeId);
/// \}

/// \name Storage of node-ID and bit rate
/// Implementations of the callbacks with the memory driver of the node (needs USE_PARA):
///
///     CO_ERR COLssLoad(uint32_t* baud, uint8_t* nodeId) { return COLssNvmLoad(&Node, 0, baud, nodeId); }
///     CO_ERR COLssStore(uint32_t baud, uint8_t nodeId) { return COLssNvmStore(&Node, 0, baud, nodeId); }
///
/// The callbacks have no node argument: a program with several nodes has to determine which one is being initialised or
/// processed. With a driver that has a Shape function, stores are atomic (power-fail safe) and occupy CO_PARA_SPACE(8,
/// …) bytes from \a offset on; with any other driver 8 bytes.
/// \{

/// Loads node-ID and bit rate. Leaves \a baud and \a nodeId unchanged if nothing was stored.
/// \retval CO_ERR_NONE         the values are loaded, or nothing was stored
/// \retval CO_ERR_PARA_STORE   the memory has no space at \a offset
/// \retval CO_ERR_IF_NVM_READ  the stored record is damaged or cannot be read
/// \retval CO_ERR_BAD_ARG      an argument is null
CO_ERR COLssNvmLoad(struct CO_NODE_T* node, uint32_t offset, uint32_t* baud, uint8_t* nodeId) CO_NEEDS(USE_LSS)
    CO_NEEDS(USE_PARA);

/// Stores node-ID and bit rate, unless they are stored already. The memory is not checked for an overlap with parameter
/// groups.
/// \retval CO_ERR_NONE          the values are stored
/// \retval CO_ERR_LSS_NO_STORE  the node has no memory
/// \retval CO_ERR_PARA_STORE    the memory has no space at \a offset
/// \retval CO_ERR_IF_NVM_WRITE  the memory does not hold the values; the old ones stay
/// \retval CO_ERR_OBJ_STATE     the budget of stores is used up (CO_PARA_BUDGET); only when called in COLssStore()
/// \retval CO_ERR_BAD_ARG       \a node is null
CO_ERR COLssNvmStore(struct CO_NODE_T* node, uint32_t offset, uint32_t baud, uint8_t nodeId) CO_NEEDS(USE_LSS)
    CO_NEEDS(USE_PARA);
/// \}

#ifdef __cplusplus
}
#endif

#endif
