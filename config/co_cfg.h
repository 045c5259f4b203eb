// SPDX-License-Identifier: Apache-2.0
/// \file co_cfg.h
/// Settings of the stack, with meaning and range; the values below are the defaults. docs/sizes.md has the bytes that
/// each costs. A value is a number. Each value can be defined as a compiler definition
/// (-D), by a preset (CO_CFG_PRESET names a header of config/presets), or by a co_cfg.h of the application that is
/// found first. A definition has priority over the preset. Library and application need the same values: the linker
/// refuses different ones, unless one is an expression such as (4 + 2) (lexican/detail/configuration.h).
#ifndef CO_CFG_H_
#define CO_CFG_H_

#ifdef CO_CFG_PRESET
#include CO_CFG_PRESET
#endif

/// Default of those settings that preset full sets to 1 with this name: 0 or 1.
#ifndef CO_FULL
#define CO_FULL 0
#endif

/// SDO servers (1200h, 1201h, …): 1…128. Each has a part of CO_NODE_SPEC.SdoBuf.
#ifndef CO_SSDO_N
#define CO_SSDO_N 1
#endif
#if CO_SSDO_N < 1 || CO_SSDO_N > 128
#error "CO_SSDO_N: 1...128 SDO servers"
#endif

/// Check of the dictionary at run time, by CODictInit() and the Init functions of types: 0 or 1. Instead, C++ tables
/// can be checked by the compiler (CO_OD_CHECK()), C tables by a test build with 1. With 0 a wrong table is used
/// unchecked: an entry in a wrong position may not be found or have no effect, and numbers of services beyond the
/// configuration access no memory; but each Type must be set, and Data must be null or as the type requires.
#ifndef USE_DICT_CHECK
#define USE_DICT_CHECK 1
#endif

/// Checks of the stack's own invariants (co_assert.h), for tests and to find memory errors of the application: 0 or 1.
/// With 1 a violated one calls COAssertFailed(). Only the library depends on it.
#ifndef USE_ASSERT
#define USE_ASSERT 0
#endif

/// Callbacks of each node in a table (CO_NODE_EXT.Callbacks, co_callbacks.h): 0 or 1. With 0 only the C functions that
/// are the same for all nodes are called.
#ifndef USE_CALLBACKS
#define USE_CALLBACKS 1
#endif

/// Optimisations for speed: 0 or 1. With 0 the dictionary and the routes of frames are searched linearly, and every
/// object of a PDO, of an expedited SDO transfer and of an SDO segment is read and written by the functions of its
/// type; a driver with Filter function then needs 4 bytes of the CPU's stack for each receiver.
#ifndef USE_FAST_PATHS
#define USE_FAST_PATHS 1
#endif

/// Types with functions for the begin and the end of an SDO transfer (CO_OBJ_TYPE_EX), and uploads of objects whose
/// length is not known beforehand (CO_OBJ_SIZE_UNKNOWN): 0 or 1. With 0, COObjTypeExReset() does not exist, and an
/// upload of unknown length is refused (0800 0020h).
#ifndef USE_OBJ_EX
#define USE_OBJ_EX 1
#endif

/// OD access interface in the style of CANopenNode (co_od.h): 0 or 1. Objects that do not use it cost nothing.
#ifndef USE_OD
#define USE_OD CO_FULL
#endif
#if USE_OD && !USE_OBJ_EX
#error "USE_OD needs USE_OBJ_EX"
#endif

/// SDO clients (1280h, 1281h, …): 0 or 1.
#ifndef USE_CSDO
#define USE_CSDO 1
#endif
/// Number of SDO clients: 1…100.
#ifndef CO_CSDO_N
#define CO_CSDO_N 1
#endif
#if CO_CSDO_N < 1 || CO_CSDO_N > 100
#error "CO_CSDO_N: 1...100 SDO clients"
#endif

/// Block transfer of servers and clients: 0 or 1.
#ifndef USE_SDO_BLOCK
#define USE_SDO_BLOCK 1
#endif

/// Minimum number of bytes for which SDO clients request a block transfer: 5…256; 0: they transfer objects of any
/// length in segments. Objects shorter than the default need fewer frames in segments. Without USE_SDO_BLOCK 0 by
/// default.
#ifndef CO_CSDO_BLOCK
#if USE_SDO_BLOCK
#define CO_CSDO_BLOCK 29
#else
#define CO_CSDO_BLOCK 0
#endif
#endif
#if CO_CSDO_BLOCK != 0 && !USE_SDO_BLOCK
#error "CO_CSDO_BLOCK needs USE_SDO_BLOCK"
#endif
#if CO_CSDO_BLOCK != 0 && (CO_CSDO_BLOCK < 5 || CO_CSDO_BLOCK > 256)
#error "CO_CSDO_BLOCK: 0 or 5...256 bytes"
#endif

/// Access of SDO clients to the dictionary of their own node, if sub 3 of 1280h… is its node-ID: 0 or 1. With 0 such a
/// client is not configured: COCSdoFind() returns null.
#ifndef USE_CSDO_OWN
#define USE_CSDO_OWN 1
#endif

/// Time in ms after which the server ends a transfer whose client no longer responds: 0 (never)…60000. It is not ended
/// before 7/8 of that time. The eighths are rounded up to ticks of the timer driver. With 0, the server also does not
/// request missing segments of a block download when its client stops sending.
#ifndef CO_SDO_TIMEOUT
#define CO_SDO_TIMEOUT 2000
#endif
#if CO_SDO_TIMEOUT < 0 || CO_SDO_TIMEOUT > 60000
#error "CO_SDO_TIMEOUT: 0...60000 ms"
#endif

/// RPDOs (1400h…): 0…512.
#ifndef CO_RPDO_N
#define CO_RPDO_N 4
#endif
/// TPDOs (1800h…): 0…512.
#ifndef CO_TPDO_N
#define CO_TPDO_N 4
#endif
#if CO_RPDO_N < 0 || CO_RPDO_N > 512 || CO_TPDO_N < 0 || CO_TPDO_N > 512
#error "CO_RPDO_N, CO_TPDO_N: 0...512 PDOs"
#endif

/// Mapping of single bits: 0 or 1. 1: BOOLEAN takes one bit of a PDO, and up to 64 objects fit into one.
#ifndef USE_PDO_BITS
#define USE_PDO_BITS 0
#endif

/// Remote requests for TPDOs, and their transmission types 252 and 253: 0 or 1.
#ifndef USE_PDO_RTR
#define USE_PDO_RTR 1
#endif

/// Multiplex PDOs with destination and source addressing (FFh and FEh in sub 0 of 1600h…, 1A00h…; 1FA0h…, 1FD0h…):
/// maximum number of objects in the object scanner list, including all objects of blocks, and of entries in the object
/// dispatching list, 1…1024; 0: none.
#ifndef CO_MPDO_N
#define CO_MPDO_N 0
#endif
#if CO_MPDO_N < 0 || CO_MPDO_N > 1024
#error "CO_MPDO_N: 0...1024 objects and entries"
#endif

/// Transmission of event-driven TPDOs (types 254 and 255) when the node enters Operational: 0 or 1.
#ifndef CO_TPDO_ON_START
#define CO_TPDO_ON_START 0
#endif

/// Use of CAN-IDs that CiA 301 reserves (7.3.5) for other services in PDO, SYNC, TIME, EMCY and SDO: 0 or 1. 1 is for
/// devices in networks that do not follow the standard's identifier allocation.
#ifndef CO_RESTRICTED_IDS
#define CO_RESTRICTED_IDS 0
#endif

/// SYNC consumer and producer (1005h, 1006h, 1007h, 1019h): 0 or 1. With 0 there are no synchronous PDOs.
#ifndef USE_SYNC
#define USE_SYNC 1
#endif

/// Shortest period of SYNC in µs in 1006h, besides 0 (no SYNC is produced): 1…1000000. A write of a shorter period is
/// refused (0609 0032h). If a table or a stored group contains a shorter period, no SYNC is produced and the node's
/// error is CO_ERR_OBJ_RANGE_LOW. Without this limit one SDO write could occupy the CPU with timer interrupts, and the
/// bus with SYNC. 500 µs is half the shortest cycle that drives commonly use, and ten times the length of a SYNC frame
/// at 1 Mbit/s.
#ifndef CO_SYNC_PERIOD_MIN
#define CO_SYNC_PERIOD_MIN 500
#endif
#if CO_SYNC_PERIOD_MIN < 1 || CO_SYNC_PERIOD_MIN > 1000000
#error "CO_SYNC_PERIOD_MIN: 1...1000000 us"
#endif

/// TIME consumer and producer (1012h), and a running clock: 0 or 1.
#ifndef USE_TIME
#define USE_TIME CO_FULL
#endif

/// High-resolution time stamp (1013h): a clock in µs that is synchronised by SYNC and time stamps: 0 or 1. Needs
/// USE_TIME and USE_SYNC.
#ifndef USE_TIME_HIGH_RES
#if USE_TIME && USE_SYNC
#define USE_TIME_HIGH_RES CO_FULL
#else
#define USE_TIME_HIGH_RES 0
#endif
#endif
#if USE_TIME_HIGH_RES && !(USE_TIME && USE_SYNC)
#error "USE_TIME_HIGH_RES needs USE_TIME and USE_SYNC"
#endif

/// Global fail-safe command (1300h, co_gfc.h): 0 or 1.
#ifndef USE_GFC
#define USE_GFC CO_FULL
#endif

/// Safety-relevant data objects, SRDOs (1301h…, co_srdo.h): 0…64.
#ifndef CO_SRDO_N
#define CO_SRDO_N 0
#endif
#if CO_SRDO_N < 0 || CO_SRDO_N > 64
#error "CO_SRDO_N: 0...64 SRDOs"
#endif

/// Shortest time between the two frames of an SRDO that is sent, in µs, rounded up to ticks of the timer driver:
/// 0…100000; 0: one after the other without delay. The refresh time of each SRDO must be longer.
#ifndef CO_SRDO_GAP
#define CO_SRDO_GAP 0
#endif
#if CO_SRDO_GAP < 0 || CO_SRDO_GAP > 100000
#error "CO_SRDO_GAP: 0...100000 us"
#endif

/// Recorder of objects with time and trigger, and its plot as CSV or numbers (co_recorder.h): 0 or 1. The application
/// provides the memory of each recorder and its points.
#ifndef USE_RECORDER
#define USE_RECORDER CO_FULL
#endif
#if USE_RECORDER && !USE_OBJ_EX
#error "USE_RECORDER needs USE_OBJ_EX"
#endif

/// EMCY producer, error register and history (1001h, 1003h, 1014h, 1015h): 0 or 1.
#ifndef USE_EMCY
#define USE_EMCY 1
#endif

/// Maximum number of errors in the application's error table (COEmcySet()): 1…256.
#ifndef CO_EMCY_N
#define CO_EMCY_N 32
#endif
#if CO_EMCY_N < 1 || CO_EMCY_N > 256
#error "CO_EMCY_N: 1...256 errors"
#endif

/// Length of the queue of EMCY messages that wait for the inhibit time (1015h) or for the transmit queue: 0…255. With
/// 0, messages are sent at once, 1015h has no effect, and a message that finds the transmit queue full is lost.
#ifndef CO_EMCY_QUEUE_N
#define CO_EMCY_QUEUE_N 4
#endif
#if CO_EMCY_QUEUE_N < 0 || CO_EMCY_QUEUE_N > 255
#error "CO_EMCY_QUEUE_N: 0...255 messages"
#endif

/// EMCY consumer: the highest sub-index (node-ID) of 1028h, 0…127.
#ifndef CO_EMCY_CONS_N
#define CO_EMCY_CONS_N 0
#endif
#if CO_EMCY_CONS_N < 0 || CO_EMCY_CONS_N > 127
#error "CO_EMCY_CONS_N: 0...127 nodes"
#endif

/// Heartbeat consumers: the highest sub-index of 1016h, 0…127.
#ifndef CO_HBCONS_N
#define CO_HBCONS_N 8
#endif
#if CO_HBCONS_N < 0 || CO_HBCONS_N > 127
#error "CO_HBCONS_N: 0...127 heartbeat consumers"
#endif

/// Node guarding and life guarding (100Ch, 100Dh): 0 or 1.
#ifndef USE_GUARDING
#define USE_GUARDING 1
#endif

/// Commands of the NMT master (CONmtCommand()): 0 or 1.
#ifndef USE_NMT_MASTER
#define USE_NMT_MASTER CO_FULL
#endif

/// Status LEDs of CiA 303-3: 0 or 1.
#ifndef USE_LED
#define USE_LED CO_FULL
#endif

/// LSS slave: 0 or 1.
#ifndef USE_LSS
#define USE_LSS 1
#endif

/// LSS master (co_lss_master.h): 0 or 1.
#ifndef USE_LSS_MASTER
#define USE_LSS_MASTER CO_FULL
#endif

/// Services of the LSS slave in Operational: 0 or 1. According to CiA 305, LSS is independent of the NMT state (1).
/// With 0 all LSS frames are ignored in Operational; a node in Pre-operational or Stopped, or without node-ID, can
/// still be configured.
#ifndef CO_LSS_IN_OPERATIONAL
#define CO_LSS_IN_OPERATIONAL 1
#endif

/// Access hook: the functions AccessSdo, AccessNmt and AccessLss in CO_CALLBACKS (co_callbacks.h) permit or refuse SDO
/// transfers, NMT commands and LSS services of the network: 0 or 1. With 0 these members do not exist, and nothing is
/// called.
#ifndef USE_ACCESS_HOOK
#define USE_ACCESS_HOOK CO_FULL
#endif
#if USE_ACCESS_HOOK && !USE_CALLBACKS
#error "USE_ACCESS_HOOK needs USE_CALLBACKS"
#endif

/// Parameter groups (1010h, 1011h, 1020h): 0 or 1.
#ifndef USE_PARA
#define USE_PARA 1
#endif

/// Period in ms of the check for changed groups that are stored autonomously (CO_PARA__A_), 1…65535: changed groups are
/// stored at each check. Determines the wear of a flash memory.
#ifndef CO_PARA_PERIOD
#define CO_PARA_PERIOD 10000
#endif
#if CO_PARA_PERIOD < 1 || CO_PARA_PERIOD > 65535
#error "CO_PARA_PERIOD: 1...65535 ms"
#endif

/// Budget of stores that the bus can cause in a row, refilled by one each minute: 0…255; 0: no limit. A "save" (1010h),
/// a "load" (1011h) or an LSS store that writes the memory uses one, and so does a round of autonomous stores. When the
/// budget is used up, "save" and "load" are aborted with 0800 0022h, the response to LSS store is error 255, and
/// autonomous groups are stored later. Limits the wear of a flash memory (docs/storage.md).
#ifndef CO_PARA_BUDGET
#define CO_PARA_BUDGET 32
#endif
#if CO_PARA_BUDGET < 0 || CO_PARA_BUDGET > 255
#error "CO_PARA_BUDGET: 0...255 stores"
#endif

/// Size of the buffer on the stack for loading and storing, in bytes: 8…1024, at least the ProgramSize of the memory.
/// With USE_REAL_TIME a multiple of 8 and of ProgramSize: between two pieces another thread may hold the node lock and
/// change the group, so no number may be divided between two pieces. This holds for numbers at a multiple of their size
/// from the begin of their group.
#ifndef CO_STORE_BUFFER
#define CO_STORE_BUFFER 32
#endif
#if CO_STORE_BUFFER < 8 || CO_STORE_BUFFER > 1024
#error "CO_STORE_BUFFER: 8...1024 bytes"
#endif

/// Use of a node by several threads under the node lock, one of them for SYNC and PDOs only (CO_NODE_EXT.Enter,
/// CONodeRealTime()): 0 or 1.
#ifndef USE_REAL_TIME
#define USE_REAL_TIME CO_FULL
#endif
#if USE_REAL_TIME && CO_STORE_BUFFER % 8 != 0
#error "CO_STORE_BUFFER: a multiple of 8 with USE_REAL_TIME, or stored numbers may be partially written"
#endif

/// Length of the transmit queue inside the node, in frames: 1…1000. CO_NODE_EXT.TxQueue can provide a longer one.
#ifndef CO_TX_QUEUE_N
#define CO_TX_QUEUE_N 8
#endif
#if CO_TX_QUEUE_N < 1 || CO_TX_QUEUE_N > 1000
#error "CO_TX_QUEUE_N: 1...1000 frames"
#endif

/// Segments of 7 bytes in the buffer of each SDO server (CO_NODE_SPEC.SdoBuf): 1…127.
#ifndef CO_SDO_BUF_SEG
#define CO_SDO_BUF_SEG 127
#endif
#if CO_SDO_BUF_SEG < 1 || CO_SDO_BUF_SEG > 127
#error "CO_SDO_BUF_SEG: 1...127 segments"
#endif

/// Maximum number of segments of block transfers that one call of CONodeProcess() or COTmrProcess() sends, by servers
/// and clients together: 1…127. 32 segments take 4 ms at 1 Mbit/s.
#ifndef CO_SDO_BLOCK_PACE
#define CO_SDO_BLOCK_PACE 32
#endif
#if CO_SDO_BLOCK_PACE < 1 || CO_SDO_BLOCK_PACE > 127
#error "CO_SDO_BLOCK_PACE: 1...127 segments"
#endif

#endif
