// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/routes.h
/// Members of CO_NODE that no application accesses: the routing table and the transmit queue.
#ifndef LEXICAN_DETAIL_ROUTES_H_
#define LEXICAN_DETAIL_ROUTES_H_

#include "co_cfg.h"
#include "co_if_can.h"
#include "co_types.h"
#include "lexican/detail/parts.h"

/// \cond internal
#if CO_ROUTE_N > 255
typedef uint16_t CO_ROUTE_NUM;
#else
typedef uint8_t CO_ROUTE_NUM;
#endif

#define CO_ROUTE_CLASS_N (USE_FAST_PATHS ? 17 : 1)

// With USE_FAST_PATHS 0 and USE_REAL_TIME 0 each service instance that can receive frames has a fixed slot, and frames
// are compared with all of them.
#define CO_ROUTES_SORTED (USE_FAST_PATHS || USE_REAL_TIME)

#if CO_ROUTES_SORTED
typedef struct CO_ROUTES_T {  ///< routing table: the service instances that consume each identifier
  /// Index of the first route of each function code (CAN-ID >> 7) and of the 29-bit identifiers, then the end. With
  /// USE_FAST_PATHS 0 one class holds all routes.
  CO_ROUTE_NUM Start[CO_ROUTE_CLASS_N + 1];
  uint32_t Id[CO_ROUTE_N + 1];  ///< identifiers with flags, ascending, then an end mark that is no identifier
  uint16_t Owner[CO_ROUTE_N];   ///< receiver in bits 15…12, number of its instance in bits 11…0
} CO_ROUTES;
#else
typedef struct CO_ROUTES_T {    ///< identifier that each service instance consumes, with flags
  uint32_t Id[CO_ROUTE_N + 1];  ///< the last element is the identifier that is searched
} CO_ROUTES;
#endif

// Transmit queue. Invariants (transmit.cpp, is_consistent()):
// - Num frames of at most Len are queued, the next one first;
// - the first Fixed of them keep their positions: the boot-up message and those before it;
// - the others are ordered by their rank in the arbitration on the bus, and by time of the same rank.
typedef struct CO_TX_QUEUE_T {
  CO_IF_FRM* Frame;
  uint16_t Len;
  uint16_t Num;
  uint16_t Fixed;  ///< number of frames at the head that no frame may overtake: up to and including the boot-up message
} CO_TX_QUEUE;
/// \endcond

#endif
