// SPDX-License-Identifier: Apache-2.0
/// \file presets/full.h
/// Everything, for a node with memory to spare: several SDO servers and clients, a long transmit queue.
#ifndef CO_PRESET_FULL_H_
#define CO_PRESET_FULL_H_

#define CO_SSDO_N 4
#define CO_CSDO_N 3
#define CO_TX_QUEUE_N 32

#endif
