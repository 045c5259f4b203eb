// SPDX-License-Identifier: Apache-2.0
/// \file presets/full.h
/// Preset for a node with much memory: several SDO servers and clients, every service (CO_FULL in co_cfg.h), a long
/// transmit queue. Other settings have the defaults of co_cfg.h.
#ifndef CO_PRESET_FULL_H_
#define CO_PRESET_FULL_H_

/// \cond internal
#ifndef CO_FULL
#define CO_FULL 1
#endif
#ifndef CO_SSDO_N
#define CO_SSDO_N 4
#endif
#ifndef CO_CSDO_N
#define CO_CSDO_N 3
#endif
#ifndef CO_RPDO_N
#define CO_RPDO_N 8
#endif
#ifndef CO_TPDO_N
#define CO_TPDO_N 8
#endif
#ifndef CO_MPDO_N
#define CO_MPDO_N 16
#endif
#ifndef CO_SRDO_N
#define CO_SRDO_N 4
#endif
#ifndef CO_EMCY_CONS_N
#define CO_EMCY_CONS_N 8
#endif
#ifndef CO_HBCONS_N
#define CO_HBCONS_N 16
#endif
#ifndef CO_TX_QUEUE_N
#define CO_TX_QUEUE_N 32
#endif
/// \endcond

#endif
