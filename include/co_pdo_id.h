// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_id.h
/// 1400h…, 1800h…, sub 1: COB-ID of a PDO, RPDO or TPDO. [CiA 301, 7.5.2.35, 37] Data: a uint32_t, or the value itself
/// (flag D); with flag N the CAN-ID is relative to the node-ID, the flags of the COB-ID are not. Bit 31 set: the PDO
/// does not exist. Bit 30 set: no remote requests (TPDO; reserved in RPDOs, ignored). Bit 29 set: 29-bit CAN-ID. While
/// the PDO exists, bits 0 to 29 cannot be changed; a CAN-ID that CiA 301 restricts, one that does not fit the frame
/// format, and a PDO without mapping are refused (0609 0030h). A write takes effect at once.
#ifndef CO_PDO_ID_H_
#define CO_PDO_ID_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoId;  ///< functions of CO_TPDO_ID

/// Type of 1400h… and 1800h…, sub 1, for RPDOs and TPDOs.
#define CO_TPDO_ID ((const CO_OBJ_TYPE*)&COTPdoId)

#ifdef __cplusplus
}
#endif

#endif
