// SPDX-License-Identifier: Apache-2.0
/// \file co_para.h
/// Parameter groups: memory that is stored in and loaded from non-volatile memory as a whole. [301:7.5.2.13, 7.5.2.14]
///
/// So far these are the declarations that a dictionary needs; the functions follow with the storage service. A program
/// that uses them does not link yet.
#ifndef CO_PARA_H_
#define CO_PARA_H_

#include "co_nmt.h"
#include "co_obj.h"
#include "co_types.h"

#if defined(__cplusplus) && !defined(CO_DATA_INTEGER)
#include "co/address.hpp"
typedef co::Address CO_PARA_MEM;
#else
/// Memory of a parameter group. In C++ it is a class of the same size and layout (co/address.hpp) that can be
/// initialised with the address of any object and is used like a uint8_t *; define CO_DATA_INTEGER to get the plain
/// pointer there, too. In C write (uint8_t *)&structure: compilers warn about, or refuse, the address of a structure
/// without the cast.
typedef uint8_t* CO_PARA_MEM;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// \name CO_PARA.Value
/// \{
#define CO_PARA____ 0u  ///< not stored
#define CO_PARA___E 1u  ///< stored on command
#define CO_PARA__A_ 2u  ///< stored autonomously
#define CO_PARA__AE 3u  ///< both
/// \}

typedef struct CO_PARA_T {
  uint32_t Offset;           ///< start address in the non-volatile memory
  uint32_t Size;             ///< bytes
  CO_PARA_MEM Start;         ///< the parameters
  CO_PARA_MEM Default;       ///< their default values, or null
  enum CO_NMT_RESET_T Type;  ///< the reset that loads them
  void* Ident;               ///< for the application
  uint32_t Value;            ///< CO_PARA_…
} CO_PARA;

extern const CO_OBJ_TYPE COTParaStore;
extern const CO_OBJ_TYPE COTParaRestore;

#define CO_TPARA_STORE ((const CO_OBJ_TYPE*)&COTParaStore)
#define CO_TPARA_RESTORE ((const CO_OBJ_TYPE*)&COTParaRestore)

CO_ERR COParaStore(const CO_PARA* pg, struct CO_NODE_T* node);
CO_ERR COParaRestore(const CO_PARA* pg, struct CO_NODE_T* node);

#ifdef __cplusplus
}
#endif

#endif
