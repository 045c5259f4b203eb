// SPDX-License-Identifier: Apache-2.0
/// \file co_hb_cons.h
/// 1016h, consumer heartbeat time: the nodes that this node monitors. [301:7.5.2.19, 7.2.8.3.2.2]
///
/// Entries: sub 0, a uint8_t or the value itself (flag D); sub 1…CO_HBCONS_N, a CO_HBCONS in RAM each. The network
/// reads and writes an UNSIGNED32: time in ms in bits 0…15, node-ID in bits 16…23; the bits above are read as 0. An
/// entry with time 0, node-ID 0 or a node-ID above 127 monitors nobody.
///
/// Monitoring starts with the first heartbeat or boot-up message of the node, and goes on in Pre-operational,
/// Operational and Stopped. Without one for the time it is missing: EMCY 8130h and what 1029h asks for, once, and
/// CONmtHbConsEvent(), which is repeated with every further period. Its next heartbeat ends that: EMCY 0000h and
/// CONmtHbConsChange(). Reserved state bytes are heartbeats, too; bit 7 is not looked at.
///
/// A write that changes an entry starts from there: nothing has been heard, and an error of the entry is forgotten. A
/// write that does not change it has no effect.
/// Refused are a node that another entry monitors (CO_ERR_OBJ_INCOMPATIBLE, 0604 0043h), and a time that the timer
/// cannot hold (CO_ERR_OBJ_RANGE, 0609 0030h). Such an entry of the table monitors nobody (node error CO_ERR_OBJ_INIT).
#ifndef CO_HB_CONS_H_
#define CO_HB_CONS_H_

#include "co_err.h"
#include "co_needs.h"
#include "co_nmt.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// An entry of 1016h. The application sets Time and NodeId, and touches nothing once the node is initialised.
typedef struct CO_HBCONS_T {
  struct CO_NODE_T* Node;
  struct CO_HBCONS_T* Next;  ///< not used
  CO_MODE State;             ///< last state heard; CO_INVALID: none
  int16_t Tmr;               ///< last state byte heard, or a negative number while there is none
  uint16_t Time;             ///< ms
  uint8_t NodeId;
  uint8_t Event;  ///< periods without a heartbeat, see CONmtGetHbEvents()
} CO_HBCONS;

/// \cond internal
typedef struct CO_HB_WATCH_T {  ///< an entry of 1016h that monitors a node
  CO_HBCONS* Cons;              ///< null: it monitors nobody
  uint32_t Seen;                ///< clock at the last heartbeat, or at the end of the last period without one
  uint32_t Period;              ///< ticks
} CO_HB_WATCH;
/// \endcond

extern const CO_OBJ_TYPE COTNmtHbCons CO_NEEDS(CO_HBCONS_N);

#define CO_THB_CONS ((const CO_OBJ_TYPE*)&COTNmtHbCons)

/// Lets \a hbc, an entry of 1016h of a node that is initialised, monitor \a nodeid with \a time in ms; the same as a
/// write of the entry. Errors as above; CO_ERR_BAD_ARG: \a hbc is null, or is not in the dictionary.
CO_ERR CONmtHbConsActivate(CO_HBCONS* hbc, uint16_t time, uint8_t nodeid) CO_NEEDS(CO_HBCONS_N);

#ifdef __cplusplus
}
#endif

#endif
