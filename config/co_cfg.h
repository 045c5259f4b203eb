// SPDX-License-Identifier: Apache-2.0
/// \file co_cfg.h
/// Configuration. Each value can be given as a compiler definition, by a preset (CO_CFG_PRESET names a header of
/// config/presets), or by a co_cfg.h of your own that is found first. Library and application must agree.
#ifndef CO_CFG_H_
#define CO_CFG_H_

#ifdef CO_CFG_PRESET
#include CO_CFG_PRESET
#endif

/// SDO servers (1200h, 1201h, …): 1…128. Each costs 56 bytes of RAM (32-bit CPU),
/// besides its part of CO_NODE_SPEC.SdoBuf.
#ifndef CO_SSDO_N
#define CO_SSDO_N 1
#endif
#if CO_SSDO_N < 1 || CO_SSDO_N > 128
#error "CO_SSDO_N: 1...128 SDO servers"
#endif

/// SDO clients (1280h, 1281h, …): 0 or 1, and how many: 1…100. Each costs 76 bytes of RAM (32-bit CPU).
#ifndef USE_CSDO
#define USE_CSDO 1
#endif
#ifndef CO_CSDO_N
#define CO_CSDO_N 1
#endif
#if CO_CSDO_N < 1 || CO_CSDO_N > 100
#error "CO_CSDO_N: 1...100 SDO clients"
#endif

/// Block transfer of servers and clients: 0 or 1. 0 saves about 1.7 KB of flash in the server and
/// 1 KB in the client (Cortex-M0+, -Os).
#ifndef USE_SDO_BLOCK
#define USE_SDO_BLOCK 1
#endif

/// Bytes from which on a client asks for a block transfer: 5…256. Shorter objects need fewer frames in segments. No
/// cost.
#ifndef CO_CSDO_BLOCK
#define CO_CSDO_BLOCK 29
#endif
#if CO_CSDO_BLOCK < 5 || CO_CSDO_BLOCK > 256
#error "CO_CSDO_BLOCK: 5...256 bytes"
#endif

/// Time in ms after which the server ends a transfer whose client has fallen silent: 0 (never)…60000. It is not ended
/// before 7/8 of that time. The eighths are rounded up to ticks of the timer driver. With 0 a block
/// download is not asked for what is missing when its client falls silent, either. No cost.
#ifndef CO_SDO_TIMEOUT
#define CO_SDO_TIMEOUT 2000
#endif
#if CO_SDO_TIMEOUT < 0 || CO_SDO_TIMEOUT > 60000
#error "CO_SDO_TIMEOUT: 0...60000 ms"
#endif

/// Frames that can wait for the CAN controller inside the node: 1…1000. Each costs 16 bytes of RAM. CO_NODE_EXT can
/// bring more memory.
#ifndef CO_TX_QUEUE_N
#define CO_TX_QUEUE_N 8
#endif
#if CO_TX_QUEUE_N < 1 || CO_TX_QUEUE_N > 1000
#error "CO_TX_QUEUE_N: 1...1000 frames"
#endif

/// Segments of 7 bytes in the buffer of each SDO server (CO_NODE_SPEC.SdoBuf): 1…127. Each costs 7 bytes of RAM there.
#ifndef CO_SDO_BUF_SEG
#define CO_SDO_BUF_SEG 127
#endif
#if CO_SDO_BUF_SEG < 1 || CO_SDO_BUF_SEG > 127
#error "CO_SDO_BUF_SEG: 1...127 segments"
#endif

#endif
