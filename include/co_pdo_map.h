// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_map.h
/// 1600h…, 1A00h…, sub 1…: a mapped object, CO_LINK(index, sub-index, bits). [CiA 301, 7.5.2.36, 38] Data: a uint32_t,
/// or the value itself (flag D). Refused: while the PDO exists, and while sub 0 is not 0 (0601 0000h); an index without
/// object (0602 0000h); an object without flag P, without flag W (RPDO) or R (TPDO), or of another length (0604 0041h).
///
/// The mapping in the table may also contain objects without flag P: the PDO works, also after resets and when its
/// COB-ID switches it off and on. CO_OD_CHECK() rejects such an object (CO_DICT_NOT_MAPPABLE) if the mapping is a
/// constant (flag D): add flag P, or do not use the check. If the mapping entries have another type that the network
/// may write (CO_TUNSIGNED32), flag P is not checked at all. An RPDO may map the static data types 0001h…0007h, which
/// need no entry in the dictionary, to skip their bits. [CiA 301, 7.4.1]
#ifndef CO_PDO_MAP_H_
#define CO_PDO_MAP_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoMap;  ///< functions of CO_TPDO_MAP

/// Type of 1600h… and 1A00h…, sub 1…, for RPDOs and TPDOs.
#define CO_TPDO_MAP ((const CO_OBJ_TYPE*)&COTPdoMap)

#ifdef __cplusplus
}
#endif

#endif
