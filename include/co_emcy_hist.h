// SPDX-License-Identifier: Apache-2.0
/// \file co_emcy_hist.h
/// 1003h, pre-defined error field. [CiA 301, 7.5.2.4] Sub-index 0: number of errors in the history, Data: a uint8_t,
/// which is not used, or flag D. Writing 0 empties the history; other values are refused (0609 0030h). Sub-indices
/// 1…254 without a gap: the errors, 1 is the newest; code in bits 15…0, manufacturer-specific information in bits
/// 31…16. Data: a uint32_t each, not flag D. The variables form a ring: read them through the dictionary. Reading an
/// unused entry returns CO_ERR_TYPE_RD; an SDO client gets 0800 0024h. The errors cannot be written (0601 0002h).
#ifndef CO_EMCY_HIST_H_
#define CO_EMCY_HIST_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTEmcyHist CO_NEEDS(USE_EMCY);  ///< functions of CO_TEMCY_HIST

#define CO_TEMCY_HIST ((const CO_OBJ_TYPE*)&COTEmcyHist)  ///< type of 1003h, all sub-indices

#ifdef __cplusplus
}
#endif

#endif
