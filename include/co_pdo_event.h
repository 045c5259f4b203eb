// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_event.h
/// 1400h…, 1800h…, sub 5: event timer. [CiA 301, 7.5.2.35, 37] Data: a uint16_t in ms, or the value itself (flag D); 0:
/// off. TPDO: an event-driven TPDO is sent when this time has elapsed since its last transmission. RPDO: maximum time
/// between two receptions, from the first one on; if it elapses, the node reports 8250h. A write takes effect at once.
#ifndef CO_PDO_EVENT_H_
#define CO_PDO_EVENT_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoEvent;  ///< functions of CO_TPDO_EVENT

/// Type of 1400h… and 1800h…, sub 5, for RPDOs and TPDOs.
#define CO_TPDO_EVENT ((const CO_OBJ_TYPE*)&COTPdoEvent)

#ifdef __cplusplus
}
#endif

#endif
