// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_scan.h
/// 1FA0h…1FCFh, sub 1…254: object scanner list, with USE_MPDO. [CiA 301, 7.5.2.39] It contains the objects of the one
/// TPDO that is a multiplex PDO with source addressing (co_pdo.h). Data: a uint32_t, CO_MPDO_SCAN(), or the value
/// itself (flag D); 0: the entry is not used. The list begins with 1FA0h sub 1 and continues with all entries in the
/// dictionary; sub 0 is a plain CO_TUNSIGNED8.
///
/// Refused: an index without object (0602 0000h); an object that could not be mapped into a TPDO, or has more than 4
/// bytes (0604 0041h); more than CO_MPDO_SCAN_N objects (0604 0042h); a block beyond sub-index 255 (0609 0030h). A
/// change takes effect at once and discards pending transmissions; with a plain CO_TUNSIGNED32, it takes effect when
/// the PDO is switched on.
#ifndef CO_PDO_SCAN_H_
#define CO_PDO_SCAN_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoScan CO_NEEDS(USE_MPDO);  ///< functions of CO_TPDO_SCAN

#define CO_TPDO_SCAN ((const CO_OBJ_TYPE*)&COTPdoScan)  ///< type of 1FA0h…1FCFh, sub 1…254

/// Value of an entry: \a block objects with consecutive sub-indices (0 and 1: one), from \a idx, \a sub on.
#define CO_MPDO_SCAN(block, idx, sub) \
  ((((uint32_t)(block)&0xFFu) << 24) | (((uint32_t)(idx)&0xFFFFu) << 8) | ((uint32_t)(sub)&0xFFu))

#ifdef __cplusplus
}
#endif

#endif
