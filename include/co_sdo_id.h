// SPDX-License-Identifier: Apache-2.0
/// \file co_sdo_id.h
/// 1200h…12FFh sub 1 and 2, COB-IDs of SDO servers and clients. [CiA 301, 7.5.2.33-34] Data: a uint32_t, or the value
/// itself (flag D); flag N: the CAN-ID is relative to the node-ID. A change is possible only from or to "not valid"
/// (bit 31); other changes are refused with CO_ERR_OBJ_RANGE, and so are CAN-IDs that CiA 301 reserves (a client may
/// use those of the default SDO of other nodes). A change takes effect after the response of the transfer that made it.
#ifndef CO_SDO_ID_H_
#define CO_SDO_ID_H_

#include "co_obj.h"
#include "co_sdo.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTSdoId;  ///< functions of CO_TSDO_ID

#define CO_TSDO_ID ((const CO_OBJ_TYPE*)&COTSdoId)  ///< type of 1200h…12FFh, sub 1 and 2

#ifdef __cplusplus
}
#endif

#endif
