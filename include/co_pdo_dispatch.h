// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_dispatch.h
/// 1FD0h…1FFFh, sub 1…254: object dispatching list, with USE_MPDO. [CiA 301, 7.5.2.40] It defines which object of this
/// node is written when an object of another node is received in a multiplex PDO with source addressing (co_pdo.h). The
/// first matching entry is used. Data: a uint64_t, CO_MPDO_DISPATCH(); 0: the entry is not used. The list begins with
/// 1FD0h sub 1 and continues with all entries in the dictionary; sub 0 is a plain CO_TUNSIGNED8.
///
/// Refused: an index without object (0602 0000h); an object of this node that could not be mapped into an RPDO, or has
/// more than 4 bytes (0604 0041h); more than CO_MPDO_DISPATCH_N entries (0604 0042h); a node-ID outside 1…127, a block
/// beyond sub-index 255 (0609 0030h). A change takes effect at once; with a plain CO_TUNSIGNED64, when an RPDO that
/// uses the list is switched on.
#ifndef CO_PDO_DISPATCH_H_
#define CO_PDO_DISPATCH_H_

#include "co_needs.h"
#include "co_obj.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_OBJ_TYPE COTPdoDispatch CO_NEEDS(USE_MPDO);  ///< functions of CO_TPDO_DISPATCH

#define CO_TPDO_DISPATCH ((const CO_OBJ_TYPE*)&COTPdoDispatch)  ///< type of 1FD0h…1FFFh, sub 1…254

/// Value of an entry: \a block objects with consecutive sub-indices (0 and 1: one), from \a idx, \a sub on in this
/// node, and from \a from_idx, \a from_sub on in node \a node_id.
#define CO_MPDO_DISPATCH(block, idx, sub, from_idx, from_sub, node_id)                                       \
  ((((uint64_t)(block)&0xFFu) << 56) | (((uint64_t)(idx)&0xFFFFu) << 40) | (((uint64_t)(sub)&0xFFu) << 32) | \
   (((uint64_t)(from_idx)&0xFFFFu) << 16) | (((uint64_t)(from_sub)&0xFFu) << 8) | ((uint64_t)(node_id)&0xFFu))

#ifdef __cplusplus
}
#endif

#endif
