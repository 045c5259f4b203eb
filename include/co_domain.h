// SPDX-License-Identifier: Apache-2.0
/// \file co_domain.h
/// DOMAIN: any bytes. [CiA 301, 7.1.6.8] CO_TDOMAIN, Data: a CO_OBJ_DOM. A download may be shorter than the memory.
/// CO_TDOMAIN_RO, Data: a CO_OBJ_DOM_RO: constant bytes, for example in flash, which are never written.
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

/// Constant bytes of a domain, owned by the application. The structure is in RAM, the bytes may be in flash.
typedef struct CO_OBJ_DOM_RO_T {
  uint32_t Offset;       ///< position of the next access
  uint32_t Size;         ///< bytes at Start
  const uint8_t* Start;  ///< the bytes
} CO_OBJ_DOM_RO;

extern const CO_OBJ_TYPE COTDomain;    ///< functions of CO_TDOMAIN
extern const CO_OBJ_TYPE COTDomainRo;  ///< functions of CO_TDOMAIN_RO

#define CO_TDOMAIN ((const CO_OBJ_TYPE*)&COTDomain)  ///< DOMAIN; Data: a CO_OBJ_DOM
/// DOMAIN that cannot be written (0601 0002h); Data: a CO_OBJ_DOM_RO. For the device's own EDS (1021h), among others.
#define CO_TDOMAIN_RO ((const CO_OBJ_TYPE*)&COTDomainRo)

/// \name Values of 1022h, the format of the EDS in 1021h, a CO_TUNSIGNED16. [CiA 301, 7.5.2.24, 7.5.2.25]
/// The stack serves the bytes of 1021h as they are; it neither compresses nor checks them.
/// \{
#define CO_EDS_FORMAT_PLAIN 0x00u  ///< text, not compressed
#define CO_EDS_FORMAT_ZLIB 0x80u   ///< manufacturer-specific: a zlib stream (RFC 1950), as other CANopen stacks use it
/// \}

#ifdef __cplusplus
}
#endif

#endif
