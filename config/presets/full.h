// SPDX-License-Identifier: Apache-2.0
/// \file presets/full.h
/// Preset for a node with much memory: several SDO servers and clients, every service, a long transmit queue. Settings
/// that are not listed here have the defaults of co_cfg.h.
#ifndef CO_PRESET_FULL_H_
#define CO_PRESET_FULL_H_

/// \cond internal
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
#ifndef USE_REAL_TIME
#define USE_REAL_TIME 1
#endif
#ifndef USE_OD
#define USE_OD 1
#endif
#ifndef USE_TIME
#define USE_TIME 1
#endif
#ifndef CO_SRDO_N
#define CO_SRDO_N 4
#endif
#ifndef USE_GFC
#define USE_GFC 1
#endif
#ifndef USE_RECORDER
#define USE_RECORDER 1
#endif
#ifndef CO_EMCY_CONS_N
#define CO_EMCY_CONS_N 8
#endif
#ifndef CO_HBCONS_N
#define CO_HBCONS_N 16
#endif
#ifndef USE_NMT_MASTER
#define USE_NMT_MASTER 1
#endif
#ifndef USE_LSS_MASTER
#define USE_LSS_MASTER 1
#endif
#ifndef USE_LED
#define USE_LED 1
#endif
#ifndef USE_ACCESS_HOOK
#define USE_ACCESS_HOOK 1
#endif
#ifndef CO_TX_QUEUE_N
#define CO_TX_QUEUE_N 32
#endif
/// \endcond

#endif
