// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_type.h
/// 1400h…, 1800h…, sub 2: transmission type. [CiA 301, 7.5.2.35, 37] Data: a uint8_t, or the value itself (flag D).
/// RPDO: 0…240 synchronous, 254 and 255 event-driven. TPDO: 0 with the SYNC after an event, 1…240 with every n-th SYNC,
/// 252 and 253 on remote request (USE_PDO_RTR), sampled at the SYNC or at the request, 254 and 255 event-driven. Other
/// values are refused (0609 0030h); while a multiplex PDO exists (co_pdo.h), all but 254 and 255 are. May be written at
/// any time and takes effect at once.
#ifndef CO_PDO_TYPE_H_
#define CO_PDO_TYPE_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoType;  ///< functions of CO_TPDO_TYPE

/// Type of 1400h… and 1800h…, sub 2, for RPDOs and TPDOs.
#define CO_TPDO_TYPE ((const CO_OBJ_TYPE*)&COTPdoType)

#ifdef __cplusplus
}
#endif

#endif
