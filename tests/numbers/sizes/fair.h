// SPDX-License-Identifier: Apache-2.0
/// \file sizes/fair.h
/// Preset slave without what neither CANopen-Stack nor CANopenNode has in the program that they are compared by.
#ifndef CO_PRESET_FAIR_H_
#define CO_PRESET_FAIR_H_

#define USE_FAST_PATHS 0
#define USE_DICT_CHECK 0
#define USE_CALLBACKS 0
#define USE_OBJ_EX 0
#define CO_CSDO_BLOCK 0
#define USE_CSDO_OWN 0
#define CO_EMCY_QUEUE_N 0
#define USE_GUARDING 0
#define USE_PDO_RTR 0
#define CO_PARA_BUDGET 0

#endif
