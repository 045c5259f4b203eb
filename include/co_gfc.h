// SPDX-License-Identifier: Apache-2.0
/// \file co_gfc.h
/// Global fail-safe command (GFC, USE_GFC): a frame with CAN-ID 001h and without data, with which a device makes other
/// devices enter their safe state early. [EN 50325-5] Any number of devices may send and receive it. It is not
/// monitored: a lost GFC is not detected, so only SRDOs (co_srdo.h) can ensure the safe state. The stack is a transport
/// for the safety functions of a device; it has no safety integrity level.
///
/// 1300h enables the GFC: 0: not used, 1: used. Data: a uint8_t, or the value itself (flag D). Refused: a value above 1
/// (0609 0030h), a write in Operational (0800 0022h). A GFC is sent and received in Operational only. The command of a
/// node does not call its own callback.
///
///     {CO_KEY(0x1300, 0, CO_OBJ_____RW), CO_TGFC, (CO_DATA)(&GfcUsed)}
///
/// Context: the loop; with a real-time thread (USE_REAL_TIME) COGfcReceived() is called by that thread.
#ifndef CO_GFC_H_
#define CO_GFC_H_

#include "co_err.h"
#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

extern const CO_OBJ_TYPE COTGfc CO_NEEDS(USE_GFC);  ///< functions of CO_TGFC

#define CO_TGFC ((const CO_OBJ_TYPE*)&COTGfc)  ///< type of 1300h

/// Sends a GFC. While an earlier one is still in the transmit queue, no second one is queued. A queued GFC is sent also
/// if the node leaves Operational meanwhile.
/// \retval CO_ERR_NONE         the frame is sent or queued
/// \retval CO_ERR_BAD_ARG      \a node is null
/// \retval CO_ERR_NMT_MODE     the node is not in Operational
/// \retval CO_ERR_OBJ_STATE    1300h is missing, or not 1
/// \retval CO_ERR_IF_CAN_SEND  the transmit queue is full
CO_ERR COGfcSend(struct CO_NODE_T* node) CO_NEEDS(USE_GFC);

/// \name Callback of the application (see co_nmt.h)
/// \{

/// Called when a GFC was received: the application enters its safe state.
void COGfcReceived(struct CO_NODE_T* node);
/// \}

#ifdef __cplusplus
}
#endif

#endif
