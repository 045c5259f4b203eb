// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_num.h
/// 1600h…, 1A00h…, sub 0: number of mapped objects. [CiA 301, 7.5.2.36, 38] Data: a uint8_t, or the value itself (flag
/// D). Refused: while the PDO exists (0601 0000h); more objects than CO_PDO_MAP_N, or more than 64 bits (0604 0042h);
/// an entry without a mappable object (0604 0041h). After a refused write the number is 0. Objects without flag P,
/// which the table may map (co_pdo_map.h), are refused unless the number is the one that sub 0 already has.
///
/// With USE_MPDO: FEh and FFh make it a multiplex PDO with source or destination addressing (co_pdo.h). Refused: if the
/// transmission type is not 254 or 255 (0604 0043h); FEh, if the dictionary has no object scanner or dispatching list
/// (0604 0042h), or if there is another TPDO of that kind (0604 0043h).
#ifndef CO_PDO_NUM_H_
#define CO_PDO_NUM_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoNum;  ///< functions of CO_TPDO_NUM

/// Type of 1600h… and 1A00h…, sub 0, for RPDOs and TPDOs.
#define CO_TPDO_NUM ((const CO_OBJ_TYPE*)&COTPdoNum)

#ifdef __cplusplus
}
#endif

#endif
