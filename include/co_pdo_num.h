// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_num.h
/// 1600h…, 1A00h…, sub 0: number of mapped objects. [301:7.5.2.36, 38] Data: a uint8_t, or the value itself (flag D).
/// Refused: while the PDO exists (0601 0000h); more objects than CO_PDO_MAP_N, or more than 64 bits (0604 0042h); an
/// entry that names no object that may be mapped (0604 0041h). A refused number leaves 0. Objects without flag P, which
/// the table may map (co_pdo_map.h), are refused unless the number is the one that sub 0 already has.
///
/// With USE_MPDO: FEh and FFh make it a multiplex PDO with source or destination addressing (co_pdo.h). Refused: unless
/// the transmission type is 254 or 255 (0604 0043h); FEh, while the dictionary has no list for it (0604 0042h), and
/// while there is another TPDO of that kind (0604 0043h).
#ifndef CO_PDO_NUM_H_
#define CO_PDO_NUM_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoNum;

/// For RPDOs and TPDOs.
#define CO_TPDO_NUM ((const CO_OBJ_TYPE*)&COTPdoNum)

#ifdef __cplusplus
}
#endif

#endif
