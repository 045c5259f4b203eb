// SPDX-License-Identifier: Apache-2.0
/// \file lexican/detail/faults.h
/// The list of the communication faults that the stack detects. A new fault is a row here, and the calls of
/// event::raise() and event::resolve() in its part.
#ifndef LEXICAN_DETAIL_FAULTS_H_
#define LEXICAN_DETAIL_FAULTS_H_

#include "co_cfg.h"

/// \cond internal
// The first three rows are states of the controller and of the bus.
// X(fault, code, led). The position of a row is the bit CO_EMCY_BIT_...; a new row is placed at the end. code: EMCY
// error code [301:7.2.7]. led: CO_LED_... that it sets, or 0.
#define CO_FAULTS(X)                                                \
  X(overrun, CO_EMCY_CODE_MON_COM_OVERRUN_ERR, 0)                   \
  X(collision, CO_EMCY_CODE_MON_COM_COLLISION_ERR, 0)               \
  X(passive, CO_EMCY_CODE_MON_COM_PASSIVE_ERR, 0)                   \
  X(heartbeat, CO_EMCY_CODE_MON_COM_HEARTBEAT_ERR, CO_LED_CONTROL)  \
  X(life_guard, CO_EMCY_CODE_MON_COM_HEARTBEAT_ERR, CO_LED_CONTROL) \
  X(recovered, CO_EMCY_CODE_MON_COM_RECOVER_ERR, 0)                 \
  X(pdo_short, CO_EMCY_CODE_MON_PROT_PDO_IGN_ERR, 0)                \
  X(pdo_long, CO_EMCY_CODE_MON_PROT_PDO_LEN_ERR, 0)                 \
  X(pdo_unknown, CO_EMCY_CODE_MON_PROT_DAM_ERR, 0)                  \
  X(sync_length, CO_EMCY_CODE_MON_PROT_SYNC_LEN_ERR, CO_LED_SYNC)   \
  X(pdo_timeout, CO_EMCY_CODE_MON_PROT_PDO_TIMEOUT_ERR, CO_LED_PDO) \
  CO_FAULTS_OF_SRDO(X)
#if CO_SRDO_N > 0
#define CO_FAULTS_OF_SRDO(X)                            \
  X(srdo_configuration, CO_EMCY_CODE_SW_DATASET_ERR, 0) \
  X(srdo, CO_EMCY_CODE_MON_PROT_ERR, 0)
#else
#define CO_FAULTS_OF_SRDO(X)
#endif

// NOLINTNEXTLINE(bugprone-macro-parentheses): a term of a sum
#define CO_COUNT_FAULT(fault, code, led) +1
#define CO_EMCY_FAULT_N (0 CO_FAULTS(CO_COUNT_FAULT))
/// \endcond

#endif
