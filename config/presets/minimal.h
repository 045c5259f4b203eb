// SPDX-License-Identifier: Apache-2.0
/// \file presets/minimal.h
/// The smallest node: one SDO server without block transfer, no SDO client, a PDO in each direction, EMCY, little
/// memory.
#ifndef CO_PRESET_MINIMAL_H_
#define CO_PRESET_MINIMAL_H_

#define CO_SSDO_N 1
#define USE_DICT_CHECK 0
#define USE_FAST_PATHS 0
#define USE_OBJ_EX 0
#define USE_CSDO 0
#define USE_SDO_BLOCK 0
#define CO_RPDO_N 1
#define CO_TPDO_N 1
#define USE_PDO_RTR 0
#define USE_SYNC 0
#define USE_LSS 0
#define USE_PARA 0
#define CO_EMCY_N 8
#define CO_HBCONS_N 0
#define USE_GUARDING 0
#define CO_TX_QUEUE_N 4
#define CO_SDO_BUF_SEG 8

#endif
