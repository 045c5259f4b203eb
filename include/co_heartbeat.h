// SPDX-License-Identifier: Apache-2.0
/// \file co_heartbeat.h
/// Heartbeat consumer and producer. [CiA 301, 7.2.8.3.2.2]
///
/// 1016h, consumer heartbeat time: the nodes that this node monitors. [CiA 301, 7.5.2.19, 7.2.8.3.2.2]
///
/// Entries: sub 0, a uint8_t or the value itself (flag D); sub 1…CO_HBCONS_N, a CO_HBCONS in RAM each. The network
/// reads and writes an UNSIGNED32: time in ms in bits 0…15, node-ID in bits 16…23; the bits above are read as 0. An
/// entry with time 0, node-ID 0 or a node-ID above 127 is not used.
///
/// Monitoring starts with the first heartbeat or boot-up message of the node, and continues in Pre-operational,
/// Operational and Stopped. If no heartbeat arrives within the time, the node is missing: EMCY 8130h and the reaction
/// of 1029h, once, and CONmtHbConsEvent(), which is repeated with every further period. The next heartbeat ends this
/// state: EMCY 0000h and CONmtHbConsChange(). Reserved state bytes count as heartbeats, too; bit 7 is ignored.
///
/// A write that changes an entry restarts its monitoring: no heartbeat has been received, and an error of the entry is
/// resolved. A write that does not change the entry has no effect. A write is refused for a node that another entry
/// monitors (CO_ERR_OBJ_INCOMPATIBLE, 0604 0043h), and for a time beyond the range of the timer (CO_ERR_OBJ_RANGE, 0609
/// 0030h). If the table contains such an entry, the entry is not used (node error CO_ERR_OBJ_INIT).
#ifndef CO_HEARTBEAT_H_
#define CO_HEARTBEAT_H_

#include "co_err.h"
#include "co_nmt.h"
#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// An entry of 1016h. The application sets Time and NodeId before CONodeInit() and must not access it afterwards.
typedef struct CO_HBCONS_T {
  struct CO_NODE_T* Node;    ///< owner, set by CONodeInit()
  struct CO_HBCONS_T* Next;  ///< not used
  CO_MODE State;             ///< last state received; CO_INVALID: none
  int16_t Tmr;               ///< monitoring: 0: no heartbeat received yet, 1: in time, 2: missing
  uint16_t Time;             ///< ms
  uint8_t NodeId;            ///< node-ID of the monitored node; 0, and above 127: the entry is not used
  uint8_t Event;             ///< missed periods, see CONmtGetHbEvents()
} CO_HBCONS;

/// \cond internal
typedef struct CO_HB_WATCH_T {  ///< an entry of 1016h that monitors a node
  CO_HBCONS* Cons;              ///< the entry; null: not used
  uint32_t Seen;                ///< clock at the last heartbeat, or at the end of the last missed period
  uint32_t Period;              ///< period in ticks
} CO_HB_WATCH;
/// \endcond

extern const CO_OBJ_TYPE COTNmtHbCons CO_NEEDS(CO_HBCONS_N);  ///< functions of CO_THB_CONS

#define CO_THB_CONS ((const CO_OBJ_TYPE*)&COTNmtHbCons)  ///< type of 1016h, all sub-indices

/// Sets the time in ms and the node-ID of \a hbc, an entry of 1016h of an initialised node, like a write of the entry
/// by the network.
/// \retval CO_ERR_NONE              the entry is set
/// \retval CO_ERR_BAD_ARG           \a hbc is null, or not in the dictionary
/// \retval CO_ERR_OBJ_INCOMPATIBLE  another entry monitors the node
/// \retval CO_ERR_OBJ_RANGE         the time is beyond the range of the timer
CO_ERR CONmtHbConsActivate(CO_HBCONS* hbc, uint16_t time, uint8_t nodeid) CO_NEEDS(CO_HBCONS_N);

/// \name 1017h, producer heartbeat time
/// [CiA 301, 7.5.2.20] Data: a uint16_t in ms, or the value itself (flag D); 0: off. A write takes effect at once; with
/// a plain CO_TUNSIGNED16 instead, at the next reset. A time beyond the range of the timer is refused with
/// CO_ERR_OBJ_RANGE.
/// \{

typedef uint16_t CO_OBJ_HB_PROD;  ///< variable of 1017h, in ms

extern const CO_OBJ_TYPE COTNmtHbProd;  ///< functions of CO_THB_PROD

#define CO_THB_PROD ((const CO_OBJ_TYPE*)&COTNmtHbProd)  ///< type of 1017h
/// \}

#ifdef __cplusplus
}
#endif

#endif
