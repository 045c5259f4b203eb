// SPDX-License-Identifier: Apache-2.0
/// \file co_hb_prod.h
/// 1017h, producer heartbeat time. [CiA 301, 7.5.2.20] Data: a uint16_t in ms, or the value itself (flag D); 0: off.
/// A write takes effect at once; with a plain CO_TUNSIGNED16 instead, at the next reset. A time beyond the range of the
/// timer is refused with CO_ERR_OBJ_RANGE.
#ifndef CO_HB_PROD_H_
#define CO_HB_PROD_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef uint16_t CO_OBJ_HB_PROD;  ///< variable of 1017h, in ms

extern const CO_OBJ_TYPE COTNmtHbProd;  ///< functions of CO_THB_PROD

#define CO_THB_PROD ((const CO_OBJ_TYPE*)&COTNmtHbProd)  ///< type of 1017h

#ifdef __cplusplus
}
#endif

#endif
