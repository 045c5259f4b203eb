// SPDX-License-Identifier: Apache-2.0
/// \file co_callbacks.h
/// Callbacks of one node: a constant table of functions that CO_NODE_EXT.Callbacks names. Every function receives the
/// node and CO_NODE_EXT.User, so several nodes in one program need no global variables, and a table in a static library
/// works. Where an entry is null, the C function of the same purpose is called, as in CANopen-Stack, which the
/// application may define for all nodes (CONmtModeChange() and others). With USE_CALLBACKS 0 (co_cfg.h) only these C
/// functions are called.
///
/// Context: the loop; with USE_REAL_TIME the mainline. The node lock is held.
#ifndef CO_CALLBACKS_H_
#define CO_CALLBACKS_H_

#include "co_types.h"

#include "co_cfg.h"
#include "co_if_can.h"
#include "co_nmt.h"
#include "co_obj.h"
#include "co_pdo.h"
#include "co_srdo.h"
#include "co_time_of_day.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_PARA_T;

/// \name Access hook (USE_ACCESS_HOOK)
/// Permits or refuses each access of the network before it has an effect, for configuration locks, roles or rate limits
/// (docs/access.md). Not checked are API functions (CODict…, COObj…, OD_…, CONmtCommand()), an SDO client that accesses
/// its own node, and PDOs, which write mapped objects.
///
/// The functions may call the API. A reset is carried out after the response to the request was sent; a node that was
/// stopped by CONodeStop() sends no response. The structures are valid during the call; later versions may append
/// members.
/// \{

/// An SDO transfer that a client initiates. It passed the checks of index, sub-index and access right; its length was
/// not checked yet.
typedef struct CO_ACCESS_SDO_T {
  CO_OBJ_TRANSFER Direction;  ///< CO_OBJ_UPLOAD: the client reads; CO_OBJ_DOWNLOAD: it writes
  uint16_t Index;             ///< index of the object
  uint8_t Sub;                ///< sub-index of the object
  uint8_t Channel;            ///< SDO server, from 0: the one with the parameters 1200h + Channel
  uint32_t Size;              ///< bytes that the client announces for a download; 0: unknown, and in an upload
  const uint8_t* Data;        ///< expedited download: Size bytes, or 4 if that is 0, in the order of the bus; else null
} CO_ACCESS_SDO;

/// A command of the NMT master that addresses this node. [CiA 301, 7.2.8.2.1]
typedef struct CO_ACCESS_NMT_T {
  uint8_t Command;  ///< 1 start, 2 stop, 128 enter Pre-operational, 129 reset node, 130 reset communication
  uint8_t NodeId;   ///< as commanded: the node-ID of this node, or 0 for all nodes
} CO_ACCESS_NMT;

/// An LSS service with valid parameters that changes something in this node. Services that only identify slaves or
/// inquire values are not checked. [CiA 305]
typedef struct CO_ACCESS_LSS_T {
  uint8_t Service;    ///< command specifier, CO_LSS_SERVICE_… (co_lss.h)
  uint8_t State;      ///< the LSS state to be entered (services 04h, 43h, 51h): CO_LSS_WAIT, CO_LSS_CONF; else 0
  uint8_t NodeId;     ///< to be configured (11h), to be stored (17h): 1…127, CO_LSS_NO_NODE_ID; else 0
  uint8_t Specific;   ///< out: the manufacturer's error code, transmitted if the result is 255
  uint32_t Baudrate;  ///< bit/s, to be configured (13h), activated (15h) or stored (17h); else 0
  uint16_t Delay;     ///< ms, switch delay (15h); else 0
  /// Activate bit timing (15h): in: the NMT state that the node enters before the switch delay. A node in Operational
  /// enters Stopped if 1029h:1 is 2, otherwise Pre-operational; any other node keeps its state. out: CO_PREOP,
  /// CO_OPERATIONAL or CO_STOP chooses another one; anything else, and a node in CO_INIT, keeps the present state.
  CO_MODE Mode;
} CO_ACCESS_LSS;
/// \}

/// Callbacks of a node. Initialise it with zero, then set the functions that the application needs. It must live as
/// long as the node. A function does what the C function does that its comment names.
typedef struct CO_CALLBACKS_T {
  void (*ModeChange)(struct CO_NODE_T* node, void* user, CO_MODE mode);                    ///< see CONmtModeChange()
  void (*ResetRequest)(struct CO_NODE_T* node, void* user, CO_NMT_RESET reset);            ///< see CONmtResetRequest()
  void (*HbConsEvent)(struct CO_NODE_T* node, void* user, uint8_t nodeId);                 ///< see CONmtHbConsEvent()
  void (*HbConsChange)(struct CO_NODE_T* node, void* user, uint8_t nodeId, CO_MODE mode);  ///< see CONmtHbConsChange()
  void (*LifeGuardEvent)(struct CO_NODE_T* node, void* user, bool occurred);         ///< see CONmtLifeGuardEvent()
  void (*CanReceive)(struct CO_NODE_T* node, void* user, CO_IF_FRM* frm);            ///< see COIfCanReceive()
  void (*CanChange)(struct CO_NODE_T* node, void* user, CO_CAN_EVENT event);         ///< see CONodeCanChange()
  void (*PdoTransmit)(struct CO_NODE_T* node, void* user, CO_IF_FRM* frm);           ///< see COPdoTransmit()
  int16_t (*PdoReceive)(struct CO_NODE_T* node, void* user, CO_IF_FRM* frm);         ///< see COPdoReceive()
  void (*PdoSyncUpdate)(struct CO_NODE_T* node, void* user, CO_RPDO* pdo);           ///< see COPdoSyncUpdate()
  void (*PdoUpdate)(struct CO_NODE_T* node, void* user, CO_RPDO* pdo);               ///< see COPdoUpdate()
  int16_t (*ParaDefault)(struct CO_NODE_T* node, void* user, struct CO_PARA_T* pg);  ///< see COParaDefault()
  void (*ParaLost)(struct CO_NODE_T* node, void* user, const struct CO_PARA_T* pg);  ///< see COParaLost()
  CO_ERR (*LssLoad)(struct CO_NODE_T* node, void* user, uint32_t* baud, uint8_t* nodeId);  ///< see COLssLoad()
  CO_ERR (*LssStore)(struct CO_NODE_T* node, void* user, uint32_t baud, uint8_t nodeId);   ///< see COLssStore()
  void (*TimeUpdate)(struct CO_NODE_T* node, void* user, const CO_TIME_OF_DAY* time);      ///< see COTimeUpdate()
  void (*LedChange)(struct CO_NODE_T* node, void* user, uint8_t leds);                     ///< see COLedChange()
  /// See COEmcyReceived().
  void (*EmcyReceived)(struct CO_NODE_T* node, void* user, uint8_t nodeId, uint16_t code, uint8_t reg,
                       const uint8_t msef[5]);
  /// Called when the newest stored record of a parameter group is damaged and an older one was loaded in its place, by
  /// CONodeInit() and by NMT resets: in CO_INIT, before anything uses the values. No EMCY can be sent then;
  /// docs/storage.md shows how to send one.
  void (*ParaRecovered)(struct CO_NODE_T* node, void* user, const struct CO_PARA_T* group);
  void (*GfcReceived)(struct CO_NODE_T* node, void* user);                                      ///< see COGfcReceived()
  void (*SrdoChange)(struct CO_NODE_T* node, void* user, uint8_t number, CO_SRDO_STATE state);  ///< see COSrdoChange()
#if USE_ACCESS_HOOK
  /// Called when a client initiates an SDO transfer: expedited, segmented or block, in either direction. 1010h and
  /// 1011h are objects like any other.
  /// \retval 0      the transfer is permitted
  /// \retval other  the transfer is refused with this abort code, e.g. CO_SDO_ERR_TOS_LOCAL
  uint32_t (*AccessSdo)(struct CO_NODE_T* node, void* user, const CO_ACCESS_SDO* access);

  /// Called before a command of the NMT master is carried out.
  /// \retval 0      the command is carried out
  /// \retval other  the command is ignored
  uint8_t (*AccessNmt)(struct CO_NODE_T* node, void* user, const CO_ACCESS_NMT* access);

  /// Called before an LSS service has an effect.
  /// \retval 0      the service is carried out
  /// \retval other  the service is refused. The response to 11h, 13h and 17h contains this error code (1: out of range
  ///                or not supported; 2, 17h only: storage failed; 255: manufacturer-specific, see
  ///                CO_ACCESS_LSS.Specific); other services have no response and no effect
  uint8_t (*AccessLss)(struct CO_NODE_T* node, void* user, CO_ACCESS_LSS* access);
#endif
} CO_CALLBACKS;

/// Returns CO_NODE_EXT.User; null if there is none, or \a node is null.
void* CONodeGetUser(const struct CO_NODE_T* node);

#ifdef __cplusplus
}
#endif

#endif
