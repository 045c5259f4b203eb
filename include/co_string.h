// SPDX-License-Identifier: Apache-2.0
/// \file co_string.h
/// VISIBLE_STRING, OCTET_STRING and UNICODE_STRING. [CiA 301, 7.1.6]
#ifndef CO_STRING_H_
#define CO_STRING_H_

#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A text that ends at its NUL; the network can only read it.
typedef struct CO_OBJ_STR_T {
  uint32_t Offset;       ///< position of the next access
  const uint8_t* Start;  ///< the text, ended by NUL
} CO_OBJ_STR;

/// A string that can be written, up to its capacity. During a download, Size grows with each piece.
typedef struct CO_OBJ_STR_RW_T {
  uint32_t Offset;    ///< position of the next access
  uint32_t Size;      ///< length in bytes. CO_TVISIBLE_STRING: maintained, but the text also ends at a NUL
  uint32_t Capacity;  ///< bytes at Start
  uint8_t* Start;     ///< CO_TUNICODE_STRING: an array of uint16_t
} CO_OBJ_STR_RW;

extern const CO_OBJ_TYPE COTString;         ///< functions of CO_TSTRING
extern const CO_OBJ_TYPE COTVisibleString;  ///< functions of CO_TVISIBLE_STRING
extern const CO_OBJ_TYPE COTOctetString;    ///< functions of CO_TOCTET_STRING
extern const CO_OBJ_TYPE COTUnicodeString;  ///< functions of CO_TUNICODE_STRING

/// Read-only text; Data: a CO_OBJ_STR.
#define CO_TSTRING ((const CO_OBJ_TYPE*)&COTString)
/// Writable text; Data: a CO_OBJ_STR_RW. A NUL is appended to the text if there is space.
#define CO_TVISIBLE_STRING ((const CO_OBJ_TYPE*)&COTVisibleString)
/// Bytes; Data: a CO_OBJ_STR_RW.
#define CO_TOCTET_STRING ((const CO_OBJ_TYPE*)&COTOctetString)
/// 16-bit characters in the byte order of the CPU; Data: a CO_OBJ_STR_RW whose Size and Capacity are even.
#define CO_TUNICODE_STRING ((const CO_OBJ_TYPE*)&COTUnicodeString)

#ifdef __cplusplus
}
#endif

#endif
