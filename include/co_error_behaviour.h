// SPDX-License-Identifier: Apache-2.0
/// \file co_error_behaviour.h
/// 1029h, error behaviour. [CiA 301, 7.5.2.32] Data: a uint8_t, or the value itself (flag D).
///
/// Sub 1 is the reaction to the loss of the network: bus-off, a missing heartbeat of a monitored node, or a missing NMT
/// master (life guarding). 0, or without the object: a node in Operational enters Pre-operational; 1: none; 2: the node
/// enters Stopped, also from Pre-operational. The reaction occurs once for each loss. Other sub-indices are evaluated
/// by the application only. All other values are refused (0609 0030h).
#ifndef CO_ERROR_BEHAVIOUR_H_
#define CO_ERROR_BEHAVIOUR_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CO_ERROR_BEHAVIOUR_PREOP 0u  ///< from Operational to Pre-operational
#define CO_ERROR_BEHAVIOUR_NONE 1u   ///< no change of the NMT state
#define CO_ERROR_BEHAVIOUR_STOP 2u   ///< from Operational or Pre-operational to Stopped

extern const CO_OBJ_TYPE COTErrorBehaviour;  ///< functions of CO_TERROR_BEHAVIOUR

#define CO_TERROR_BEHAVIOUR ((const CO_OBJ_TYPE*)&COTErrorBehaviour)  ///< type of 1029h

#ifdef __cplusplus
}
#endif

#endif
