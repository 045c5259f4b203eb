// SPDX-License-Identifier: Apache-2.0
/// \file co_ssdo.h
/// The SDO server. It needs no calls from the application; see COObjTypeUserSDOAbort() (co_obj.h) for abort codes of
/// its own. [CiA 301, 7.2.4]
#ifndef CO_SSDO_H_
#define CO_SSDO_H_

#include "co_cfg.h"
#include "co_obj.h"
#include "co_sdo.h"
#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One SDO server channel (1200h, 1201h, …). Invariants between frames (server.cpp, is_consistent()):
/// - without an open transfer (State 0) there is no object: Obj is null;
/// - in a block, Seq and AckSeq are at most 127, and the buffer contains at most CO_SDO_BUF_BYTE bytes (Fill).
typedef struct CO_SDO_T {
  struct CO_NODE_T* Node;  ///< owner
  CO_SDO_FLOW Flow;        ///< data of the open transfer
  uint8_t Value[8];        ///< collects a value of up to 8 bytes, in the byte order of the bus
  CO_OBJ* Obj;             ///< entry of the open transfer; null: none
  uint32_t RxId;           ///< identifier of the client's frames, as in CO_IF_FRM; FFFF FFFFh: the channel is off
  uint32_t TxId;           ///< identifier of the server's frames
  uint32_t WasTxId;        ///< previous TxId, under which a response may still be in the transmit queue
  uint32_t Key;            ///< CO_DEV() of the open transfer
  uint32_t Read;           ///< position behind the last bytes read or written
#if USE_SDO_BLOCK
  uint32_t Summed;  ///< block upload: bytes that Crc covers
#endif
} CO_SDO;

#ifdef __cplusplus
}
#endif

#endif
