// SPDX-License-Identifier: Apache-2.0
/// \file co_emcy_id.h
/// 1014h, COB-ID EMCY. [CiA 301, 7.5.2.17] Data: a uint32_t, or the value itself (flag D); with flag N the CAN-ID is
/// relative to the node-ID, the flags of the COB-ID are not. Bit 31 set: no EMCY is sent. Bit 29 set: 29-bit CAN-ID.
/// While bit 31 is 0 the other bits cannot be changed, unless the same write sets bit 31. Always refused are restricted
/// CAN-IDs, bit 30, and a CAN-ID that does not fit the frame format (0609 0030h). A write takes effect at once; queued
/// messages are discarded when bit 31 is set, and counted as dropped.
#ifndef CO_EMCY_ID_H_
#define CO_EMCY_ID_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTEmcyId CO_NEEDS(USE_EMCY);  ///< functions of CO_TEMCY_ID

#define CO_TEMCY_ID ((const CO_OBJ_TYPE*)&COTEmcyId)  ///< type of 1014h

#ifdef __cplusplus
}
#endif

#endif
