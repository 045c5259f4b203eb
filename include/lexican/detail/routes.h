// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/routes.h
/// Members of CO_NODE that no application accesses: the routing table and the transmit queue.
#ifndef LEXICAN_DETAIL_ROUTES_H_
#define LEXICAN_DETAIL_ROUTES_H_

#include "co_cfg.h"
#include "co_if_can.h"
#include "co_types.h"

/// \cond internal
// Routes: NMT, error control, LSS, SDO, heartbeat and EMCY consumers, SYNC and TIME, PDOs, GFC, both frames of SRDOs.
#define CO_ROUTE_N                                                                                           \
  (2 + (USE_LSS ? 1 : 0) + (USE_LSS_MASTER ? 1 : 0) + CO_SSDO_N + (USE_CSDO ? CO_CSDO_N : 0) + CO_HBCONS_N + \
   CO_EMCY_CONS_N + (USE_SYNC ? 1 : 0) + (USE_TIME ? 1 : 0) + CO_RPDO_N + (USE_PDO_RTR ? CO_TPDO_N : 0) +    \
   (USE_GFC ? 1 : 0) + 2 * CO_SRDO_N)
#if CO_ROUTE_N > 255
typedef uint16_t CO_ROUTE_NUM;
#else
typedef uint8_t CO_ROUTE_NUM;
#endif

#define CO_ROUTE_CLASS_N (USE_FAST_PATHS ? 17 : 1)

// With USE_FAST_PATHS 0 each service instance that can receive frames has a fixed place, and frames are compared with
// all of them.
#define CO_ROUTES_SORTED (USE_FAST_PATHS || USE_REAL_TIME)

#if CO_ROUTES_SORTED
typedef struct CO_ROUTES_T {  ///< routing table: the service instances that consume each identifier
  /// Index of the first route of each function code (CAN-ID >> 7) and of the 29-bit identifiers, then the end. With
  /// USE_FAST_PATHS 0 one class holds all routes.
  CO_ROUTE_NUM Start[CO_ROUTE_CLASS_N + 1];
  uint32_t Id[CO_ROUTE_N + 1];  ///< identifiers with flags, ascending, then an end mark that is no identifier
  uint16_t Owner[CO_ROUTE_N];   ///< service in bits 15…12, number of its instance in bits 11…0
} CO_ROUTES;
#else
// Consumers of heartbeats and EMCY are numbered from 1; an RPDO may be a multiplex PDO instead.
#define CO_ROUTE_PLACES                                                    \
  (CO_ROUTE_N + (CO_HBCONS_N > 0 ? 1 : 0) + (CO_EMCY_CONS_N > 0 ? 1 : 0) + \
   (USE_MPDO ? (CO_RPDO_N > 0 ? CO_RPDO_N : 1) : 0))
typedef struct CO_ROUTES_T {         ///< identifier that each service instance consumes, with flags
  uint32_t Id[CO_ROUTE_PLACES + 1];  ///< the last element is the identifier that is searched
} CO_ROUTES;
#endif

typedef struct CO_TX_QUEUE_T {  ///< transmit queue, ordered by priority
  CO_IF_FRM* Frame;
  uint16_t Len;
  uint16_t Num;
  uint16_t Fixed;  ///< number of frames at the head that no frame may overtake: up to and including the boot-up message
} CO_TX_QUEUE;
/// \endcond

#endif
