// SPDX-License-Identifier: Apache-2.0
/// \file co_domain.h
/// DOMAIN: any bytes. [CiA 301, 7.1.6.8] Data: a CO_OBJ_DOM. A download may be shorter than the memory.
#ifndef CO_DOMAIN_H_
#define CO_DOMAIN_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Memory of a domain, owned by the application.
typedef struct CO_OBJ_DOM_T {
  uint32_t Offset;  ///< position of the next access
  uint32_t Size;    ///< bytes at Start
  uint8_t* Start;   ///< the bytes
} CO_OBJ_DOM;

extern const CO_OBJ_TYPE COTDomain;  ///< functions of CO_TDOMAIN

#define CO_TDOMAIN ((const CO_OBJ_TYPE*)&COTDomain)  ///< DOMAIN; Data: a CO_OBJ_DOM

#ifdef __cplusplus
}
#endif

#endif
