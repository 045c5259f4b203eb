// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/parts.h
/// The list of the parts of the stack: services, and others that take part in the events of a node. A new part is a
/// folder (in src/service, or src/storage and src/extra) and a row here.
#ifndef LEXICAN_DETAIL_PARTS_H_
#define LEXICAN_DETAIL_PARTS_H_

#include "co_cfg.h"

/// \cond internal
// X(part, instances, routes, senders, permission). Events pass the parts in this order, and so do frames that several
// parts receive and deferred messages. part: namespace of its co::Part. instances: 0 if the configuration leaves it
// out. routes: identifiers that it receives. senders: of frames that continue when the controller accepts them.
// permission: CO_..._ALLOWED bit that the NMT state must have for its frames.
// Order that matters: error_control before heartbeat_consumer, which may receive the same frames; mpdo before pdo,
// which configures it; emcy before tpdo, because EMCY messages are sent first; tpdo before rpdo, because a SYNC samples
// TPDOs before it writes the data of RPDOs. A new row is placed at the end, if it has no such reason.
#define CO_PARTS(X)                                                    \
  X(nmt, 1, 1, 0, CO_NMT_ALLOWED)                                      \
  X(error_behaviour, 1, 0, 0, CO_NMT_ALLOWED)                          \
  X(sdo_server, CO_SSDO_N, CO_SSDO_N, CO_SSDO_N, CO_SDO_ALLOWED)       \
  X(sdo_client, USE_CSDO, CO_CSDO_N, CO_CSDO_N, CO_SDO_ALLOWED)        \
  X(error_control, 1, 1, 0, CO_NMT_ALLOWED)                            \
  X(heartbeat_consumer, CO_HBCONS_N, CO_HBCONS_N, 0, CO_NMT_ALLOWED)   \
  X(sync, USE_SYNC, 1, 0, CO_SYNC_ALLOWED)                             \
  X(time, USE_TIME, 1, 0, CO_TIME_ALLOWED)                             \
  X(emcy, USE_EMCY, 0, 0, CO_EMCY_ALLOWED)                             \
  X(mpdo, CO_MPDO_N, 0, (CO_TPDO_N > 0 ? 1 : 0), CO_PDO_ALLOWED)       \
  X(pdo, CO_RPDO_N + CO_TPDO_N, 0, 0, CO_PDO_ALLOWED)                  \
  X(tpdo, CO_TPDO_N, (USE_PDO_RTR ? CO_TPDO_N : 0), 0, CO_PDO_ALLOWED) \
  X(rpdo, CO_RPDO_N, CO_RPDO_N, 0, CO_PDO_ALLOWED)                     \
  X(gfc, USE_GFC, 1, 0, CO_PDO_ALLOWED)                                \
  X(srdo, CO_SRDO_N, 2 * CO_SRDO_N, 0, CO_PDO_ALLOWED)                 \
  X(emcy_consumer, CO_EMCY_CONS_N, CO_EMCY_CONS_N, 0, CO_EMCY_ALLOWED) \
  X(lss, USE_LSS, 1, 0, CO_LSS_ALLOWED)                                \
  X(lss_master, USE_LSS_MASTER, 1, 0, CO_LSS_ALLOWED)                  \
  X(heartbeat, 1, 0, 0, CO_NMT_ALLOWED)                                \
  X(para, USE_PARA, 0, 0, CO_NMT_ALLOWED)                              \
  X(led, USE_LED, 0, 0, CO_NMT_ALLOWED)                                \
  X(recorder, USE_RECORDER, 0, 0, CO_NMT_ALLOWED)

// Number of routes of a node.
// NOLINTNEXTLINE(bugprone-macro-parentheses): a term of a sum
#define CO_ROUTES_OF(part, instances, routes, senders, permission) +((instances) != 0 ? (routes) : 0)
#define CO_ROUTE_N (0 CO_PARTS(CO_ROUTES_OF))
/// \endcond

#endif
