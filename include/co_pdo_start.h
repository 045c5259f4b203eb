// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_start.h
/// 1800h…, sub 6: SYNC start value. [CiA 301, 7.5.2.37] Data: a uint8_t, or the value itself (flag D). If it is not 0
/// and SYNC has a counter (1019h), the SYNC with this counter value is the first that the TPDO counts. Values above
/// 240, and a change while the PDO exists, are refused (0609 0030h).
#ifndef CO_PDO_START_H_
#define CO_PDO_START_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoStart;  ///< functions of CO_TPDO_START

#define CO_TPDO_START ((const CO_OBJ_TYPE*)&COTPdoStart)  ///< type of 1800h…, sub 6

#ifdef __cplusplus
}
#endif

#endif
