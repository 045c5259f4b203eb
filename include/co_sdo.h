// SPDX-License-Identifier: Apache-2.0
/// \file co_sdo.h
/// Abort codes and COB-IDs of SDO servers and clients. [CiA 301, 7.2.4.3.17]
#ifndef CO_SDO_H_
#define CO_SDO_H_

#include "co_cfg.h"
#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

/// \name SDO abort codes
/// \{
#define CO_SDO_ERR_TBIT 0x05030000u          ///< toggle bit not alternated
#define CO_SDO_ERR_TIMEOUT 0x05040000u       ///< protocol timed out
#define CO_SDO_ERR_CMD 0x05040001u           ///< command specifier not valid
#define CO_SDO_ERR_BLK_SIZE 0x05040002u      ///< invalid block size
#define CO_SDO_ERR_SEQ_NUM 0x05040003u       ///< invalid sequence number
#define CO_SDO_ERR_CRC 0x05040004u           ///< CRC error
#define CO_SDO_ERR_MEM 0x05040005u           ///< out of memory
#define CO_SDO_ERR_UNSUP 0x06010000u         ///< unsupported access
#define CO_SDO_ERR_RD 0x06010001u            ///< read of a write-only object
#define CO_SDO_ERR_WR 0x06010002u            ///< write of a read-only object
#define CO_SDO_ERR_OBJ 0x06020000u           ///< object does not exist
#define CO_SDO_ERR_OBJ_MAP 0x06040041u       ///< object cannot be mapped
#define CO_SDO_ERR_OBJ_MAP_N 0x06040042u     ///< PDO length exceeded
#define CO_SDO_ERR_PARA_INCOMP 0x06040043u   ///< general parameter incompatibility
#define CO_SDO_ERR_INTERNAL 0x06040047u      ///< general internal incompatibility
#define CO_SDO_ERR_HW_ACCESS 0x06060000u     ///< hardware error
#define CO_SDO_ERR_LEN 0x06070010u           ///< length does not match
#define CO_SDO_ERR_LEN_HIGH 0x06070012u      ///< length too high
#define CO_SDO_ERR_LEN_SMALL 0x06070013u     ///< length too low
#define CO_SDO_ERR_SUB 0x06090011u           ///< sub-index does not exist
#define CO_SDO_ERR_RANGE 0x06090030u         ///< invalid value
#define CO_SDO_ERR_RANGE_HIGH 0x06090031u    ///< value too high
#define CO_SDO_ERR_RANGE_LOW 0x06090032u     ///< value too low
#define CO_SDO_ERR_RANGE_LIMITS 0x06090036u  ///< maximum less than minimum
#define CO_SDO_ERR_NO_CONNECT 0x060A0023u    ///< resource not available: SDO connection
#define CO_SDO_ERR_GENERAL 0x08000000u       ///< general error
#define CO_SDO_ERR_TOS 0x08000020u           ///< data cannot be transferred or stored
#define CO_SDO_ERR_TOS_LOCAL 0x08000021u     ///< … because of local control
#define CO_SDO_ERR_TOS_STATE 0x08000022u     ///< … because of the present device state
#define CO_SDO_ERR_NO_OD 0x08000023u         ///< no object dictionary is present
#define CO_SDO_ERR_NO_DATA 0x08000024u       ///< no data available
/// \}

/// \name Buffer for each SDO server that CO_NODE_SPEC.SdoBuf has to provide, CO_SDO_BUF_SEG segments of 7 bytes.
/// Expedited and segmented transfers do not use it. SdoBuf may be null: block transfers are then refused with
/// CO_SDO_ERR_CMD, and clients fall back to segments.
/// \{
#define CO_SDO_BUF_BYTE (CO_SDO_BUF_SEG * 7)  ///< bytes of the buffer of one server
/// Defines the static array \a name, for all SDO servers, for CO_NODE_SPEC.SdoBuf, and its length in bytes, \a name
/// Len, for CO_NODE_EXT.SdoBufLen.
#define CO_SDO_BUFFER(name)                         \
  enum { name##Len = CO_SSDO_N * CO_SDO_BUF_BYTE }; \
  static uint8_t name[name##Len]
/// \}

/// \name Values for the COB-ID entries 1200h…12FFh. [CiA 301, 7.5.2.33]
/// \a valid: 1 = the SDO exists, \a dynamic: 1 = assigned dynamically, \a id: CAN-ID
/// \{
#define CO_SDO_ID_OFF 0x80000000u  ///< bit 31: the SDO does not exist
/// Value with an 11-bit CAN-ID.
#define CO_COBID_SDO_STD(valid, dynamic, id) \
  ((((uint32_t)(id)) & 0x7FFu) | ((((uint32_t)(dynamic)) & 1u) << 30) | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// Value with a 29-bit CAN-ID.
#define CO_COBID_SDO_EXT(valid, dynamic, id)                                               \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((((uint32_t)(dynamic)) & 1u) << 30) | \
   ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// Default COB-ID of requests to the first server (1200h sub 1), to be used with flag N.
#define CO_COBID_SDO_REQUEST() 0x600u
/// Default COB-ID of responses of the first server (1200h sub 2), to be used with flag N.
#define CO_COBID_SDO_RESPONSE() 0x580u
/// \}

#ifdef __cplusplus
extern "C" {
#endif

/// Data of a transfer, which SDO servers and clients have in common. Private.
typedef struct CO_SDO_FLOW_T {
  uint8_t State;  ///< state of the protocol; 0: no transfer is open
  uint8_t Flags;  ///< flags of the transfer
  uint8_t Idle;   ///< parts of the time-out without a frame of the transfer
#if USE_SDO_BLOCK
  uint8_t Heard;    ///< block received: highest sequence number so far; 0: none
  uint8_t BlkSize;  ///< segments of the current block
  uint8_t Seq;      ///< last segment of the block that was sent, or received in sequence
  uint8_t AckSeq;   ///< block received: last ackseq sent
  uint8_t AckSize;  ///< block received: blksize of the last acknowledge; 0: none was sent yet
  uint16_t Crc;     ///< block transfer: CRC of the data so far
  uint16_t Fill;    ///< block transfer: bytes in the buffer
#endif
  uint32_t Size;  ///< bytes that the transfer will have, or its maximum
  uint32_t Num;   ///< bytes transferred so far; block sent: bytes acknowledged
} CO_SDO_FLOW;

/// \name 1200h…12FFh sub 1 and 2, COB-IDs of SDO servers and clients
/// [CiA 301, 7.5.2.33-34] Data: a uint32_t, or the value itself (flag D); flag N: the CAN-ID is relative to the node-
/// ID. A change is possible only from or to "not valid" (bit 31); other changes are refused with CO_ERR_OBJ_RANGE, and
/// so are CAN-IDs that CiA 301 reserves (a client may use those of the default SDO of other nodes). A change takes
/// effect after the response of the transfer that made it.
/// \{

extern const CO_OBJ_TYPE COTSdoId;  ///< functions of CO_TSDO_ID

#define CO_TSDO_ID ((const CO_OBJ_TYPE*)&COTSdoId)  ///< type of 1200h…12FFh, sub 1 and 2
/// \}

#ifdef __cplusplus
}
#endif

#endif
