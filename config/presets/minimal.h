// SPDX-License-Identifier: Apache-2.0
/// \file presets/minimal.h
/// Preset for the smallest node: one SDO server without block transfer, no SDO client, a PDO in each direction, EMCY,
/// little memory. Settings that are not listed here have the defaults of co_cfg.h.
#ifndef CO_PRESET_MINIMAL_H_
#define CO_PRESET_MINIMAL_H_

/// \cond internal
#ifndef CO_SSDO_N
#define CO_SSDO_N 1
#endif
#ifndef USE_DICT_CHECK
#define USE_DICT_CHECK 0
#endif
#ifndef USE_FAST_PATHS
#define USE_FAST_PATHS 0
#endif
#ifndef USE_CALLBACKS
#define USE_CALLBACKS 0
#endif
#ifndef USE_OBJ_EX
#define USE_OBJ_EX 0
#endif
#ifndef USE_CSDO
#define USE_CSDO 0
#endif
#ifndef USE_SDO_BLOCK
#define USE_SDO_BLOCK 0
#endif
#ifndef CO_RPDO_N
#define CO_RPDO_N 1
#endif
#ifndef CO_TPDO_N
#define CO_TPDO_N 1
#endif
#ifndef USE_PDO_RTR
#define USE_PDO_RTR 0
#endif
#ifndef USE_SYNC
#define USE_SYNC 0
#endif
#ifndef USE_LSS
#define USE_LSS 0
#endif
#ifndef USE_PARA
#define USE_PARA 0
#endif
#ifndef CO_EMCY_QUEUE_N
#define CO_EMCY_QUEUE_N 0
#endif
#ifndef CO_EMCY_N
#define CO_EMCY_N 8
#endif
#ifndef CO_HBCONS_N
#define CO_HBCONS_N 0
#endif
#ifndef USE_GUARDING
#define USE_GUARDING 0
#endif
#ifndef CO_TX_QUEUE_N
#define CO_TX_QUEUE_N 4
#endif
#ifndef CO_SDO_BUF_SEG
#define CO_SDO_BUF_SEG 8
#endif
/// \endcond

#endif
