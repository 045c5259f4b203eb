// SPDX-License-Identifier: Apache-2.0
/// \file presets/full.h
/// Everything, for a node with memory to spare: several SDO servers and clients, every service, a long transmit queue.
#ifndef CO_PRESET_FULL_H_
#define CO_PRESET_FULL_H_

#define CO_SSDO_N 4
#define CO_CSDO_N 3
#define CO_RPDO_N 8
#define CO_TPDO_N 8
#define USE_MPDO 1
#define USE_REAL_TIME 1
#define USE_OD 1
#define USE_TIME 1
#define CO_EMCY_CONS_N 8
#define CO_HBCONS_N 16
#define USE_NMT_MASTER 1
#define USE_LSS_MASTER 1
#define USE_LED 1
#define USE_ACCESS_HOOK 1
#define CO_TX_QUEUE_N 32

#endif
