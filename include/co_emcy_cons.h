// SPDX-License-Identifier: Apache-2.0
/// \file co_emcy_cons.h
/// 1028h, emergency consumer object, sub 1…127: the COB-ID of the EMCY messages of the node with that node-ID; up to
/// CO_EMCY_CONS_N. [CiA 301, 7.5.2.30] Sub 0 is a plain CO_TUNSIGNED8. Data: a uint32_t, or the value itself (flag D).
/// Bit 31 set: messages of the node are ignored. While bit 31 is 0 the other bits cannot be changed, unless the same
/// write sets bit 31. Restricted CAN-IDs, and those that do not fit the frame format, are refused (0609 0030h). A write
/// takes effect at once.
#ifndef CO_EMCY_CONS_H_
#define CO_EMCY_CONS_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTEmcyCons CO_NEEDS(CO_EMCY_CONS_N);  ///< functions of CO_TEMCY_CONS

#define CO_TEMCY_CONS ((const CO_OBJ_TYPE*)&COTEmcyCons)  ///< type of 1028h, sub 1…127

#ifdef __cplusplus
}
#endif

#endif
