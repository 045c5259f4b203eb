// SPDX-License-Identifier: Apache-2.0
/// \file presets/minimal.h
/// The smallest node: one SDO server, little memory.
#ifndef CO_PRESET_MINIMAL_H_
#define CO_PRESET_MINIMAL_H_

#define CO_SSDO_N 1
#define CO_TX_QUEUE_N 4
#define CO_SDO_BUF_SEG 8

#endif
