// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo.h
/// Process data objects. [CiA 301, 7.2.2] They are configured by 1400h…, 1600h… (RPDOs) and 1800h…, 1A00h… (TPDOs), in
/// the table or by the network. A mapping is resolved when the PDO is switched on: no lookups and no checks are needed
/// when a PDO is received or sent.
///
/// Objects of 1 to 8 bytes of every type can be mapped. If all objects of a PDO are plain numbers of 1, 2 or 4 bytes in
/// variables, aligned in the frame as in memory, they are copied directly, adjacent ones together; otherwise the Read
/// and Write functions of their types are called. Each number of up to 4 bytes is stored in one access.
/// CO_NODE_EXT.OdLock and OdUnlock keep larger values, and objects that belong together, consistent; the lock is held
/// while the objects of one PDO, or those of all RPDOs of one SYNC, are copied:
///   - interrupt and loop: the stack runs in the loop, the application's interrupt reads mapped objects. OdLock
///     disables the interrupt, OdUnlock enables it.
///   - two threads: both lock a mutex, the stack by OdLock and OdUnlock, the application around its own accesses. The
///     stack calls the functions and callbacks of this file without the lock, except the Read and Write functions of
///     types.
///
/// Multiplex PDOs, with CO_MPDO_N above 0 [CiA 301, 7.2.3]: each frame contains the multiplexer and the value of one
/// object of up to 4 bytes. Sub 0 of the mapping selects the kind. They are event-driven and have no remote requests.
///   - FFh, destination addressing: the frame names an object of the consumer, or of all consumers. It is sent by
///     COTPdoSendTo(), and written to objects that an RPDO could map (flags P and W). If there is no such object, EMCY
///     8230h is sent, once until an object is written again. Frames for other nodes are ignored.
///   - FEh, source addressing: the frame names an object of the producer. The object scanner list (co_pdo_types.h)
///     contains the objects of the one TPDO of this kind. COTPdoTrigObj() or flag A sends one of them; a request, the
///     event timer or the start (CO_TPDO_ON_START) sends all of them in the order of the list, an inhibit time apart,
///     each with its value at the time of transmission. The object dispatching list (co_pdo_types.h) contains the
///     objects that RPDOs of this kind write; other objects are ignored.
/// COPdoTransmit(), COPdoReceive() and COPdoUpdate() are called for each frame. CORPdoObjWasReceived() reports the
/// object that a multiplex PDO has written last.
///
/// A TPDO that is triggered by the SYNC, a timer or a remote request is not sent if one of its objects cannot be read:
/// the node's error is then the result of the type. A TPDO that is still in the transmit queue is replaced by a newer
/// one, which is not counted as dropped.
///
/// Context: the loop.
#ifndef CO_PDO_H_
#define CO_PDO_H_

#include "co_cfg.h"
#include "co_err.h"
#include "co_if.h"
#include "co_obj.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Values for 1400h… and 1800h…, sub 1
/// \a valid: 1 = the PDO exists, \a id: CAN-ID
/// \{
#define CO_RPDO_COBID_OFF 0x80000000u     ///< bit 31: the PDO does not exist
#define CO_RPDO_COBID_EXT 0x20000000u     ///< bit 29: 29-bit CAN-ID
#define CO_TPDO_COBID_OFF 0x80000000u     ///< bit 31: the PDO does not exist
#define CO_TPDO_COBID_REMOTE 0x40000000u  ///< bit 30: no remote requests
#define CO_TPDO_COBID_EXT 0x20000000u     ///< bit 29: 29-bit CAN-ID
/// RPDO with an 11-bit CAN-ID.
#define CO_COBID_RPDO_STD(valid, id) ((((uint32_t)(id)) & 0x7FFu) | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// RPDO with a 29-bit CAN-ID.
#define CO_COBID_RPDO_EXT(valid, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// TPDO with an 11-bit CAN-ID, without remote requests.
#define CO_COBID_TPDO_STD(valid, id) \
  ((((uint32_t)(id)) & 0x7FFu) | 0x40000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// TPDO with a 29-bit CAN-ID, without remote requests.
#define CO_COBID_TPDO_EXT(valid, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x60000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
#define CO_COBID_RPDO_BASE 0x200u  ///< first four RPDOs; consecutive ones differ by CO_COBID_RPDO_INC
#define CO_COBID_RPDO_INC 0x100u   ///< difference of the CAN-IDs of consecutive RPDOs
#define CO_COBID_TPDO_BASE 0x180u  ///< first four TPDOs; consecutive ones differ by CO_COBID_TPDO_INC
#define CO_COBID_TPDO_INC 0x100u   ///< difference of the CAN-IDs of consecutive TPDOs
/// COB-IDs of the pre-defined connection set, for entries with flag N. [CiA 301, 7.3.5] \a n: 0…3
#define CO_COBID_RPDO_DEFAULT(n) (CO_COBID_RPDO_BASE + (uint32_t)(n)*CO_COBID_RPDO_INC)
/// TPDO \a n of the pre-defined connection set, without remote requests.
#define CO_COBID_TPDO_DEFAULT(n) (0x40000000u + CO_COBID_TPDO_BASE + (uint32_t)(n)*CO_COBID_TPDO_INC)
/// \}

/// Maximum number of objects of a PDO: 8, with USE_PDO_BITS 64.
#if USE_PDO_BITS
#define CO_PDO_MAP_N 64
#else
#define CO_PDO_MAP_N 8
#endif

struct CO_NODE_T;

/// Resolved mapping of a PDO. Invariants (mapping.cpp, is_consistent()):
/// - a PDO without a valid mapping does not exist: Length is 0;
/// - Length is at most 64 bits, and the sum of the lengths in Step;
/// - Entry is FFFFh behind the last mapped object.
typedef struct CO_PDO_MAP_T {
  uint8_t Flags;  ///< flags of the PDO
#if CO_MPDO_N > 0
  uint8_t Mode;  ///< FEh, FFh: multiplex PDO with source or destination addressing; 0: not multiplexed
#endif
  uint8_t Length;                         ///< length in bytes, with USE_PDO_BITS in bits; 0: the PDO does not exist
  uint8_t Span;                           ///< all entries are less than 2^Span entries behind Entry[0], modulo 2^16
  uint8_t Transferred[CO_PDO_MAP_N / 8];  ///< a bit for each object: sent or received since the application has read it
  /// Length of each copy, in units of Length; 0: copied with the previous object. An additional bit marks a copy that
  /// is not aligned in the frame. Bit 7 of the first element: each object is accessed by its type.
  uint8_t Step[CO_PDO_MAP_N];
  uint16_t Entry[CO_PDO_MAP_N];  ///< numbers of the entries in the dictionary; FFFFh: none, or a static data type
} CO_PDO_MAP;

/// Times of an event-driven TPDO.
typedef struct CO_TPDO_TIMES_T {
  uint32_t Inhibit;  ///< ticks, 0: none
  uint32_t Event;    ///< ticks, 0: none
} CO_TPDO_TIMES;

/// A PDO. The application must not access its members; it refers to a PDO by its number in node.RPdo or node.TPdo.
typedef struct CO_PDO_T {
  struct CO_NODE_T* Node;  ///< owner
  uint16_t Number;         ///< position in node.RPdo or node.TPdo
  uint8_t Type;            ///< transmission type
  union {
    uint8_t Faults;  ///< RPDO: faults that are raised
    uint8_t Count;   ///< TPDO: SYNCs since the last transmission, or the SYNC start value until it is reached
  };
  CO_PDO_MAP Map;  ///< mapping and flags
  union {
    uint32_t Deadline;    ///< RPDO: event time in ticks, 0: none
    uint32_t Identifier;  ///< TPDO: identifier of its frames
  };
  union {
    CO_TPDO_TIMES Time;  ///< event-driven TPDO
    /// Synchronous RPDO: data until the SYNC; synchronous TPDO: data of the last SYNC, for remote requests.
    uint8_t Data[8];
  } Own;           ///< selected by Type
  CO_TMR_MEM Tmr;  ///< RPDO: deadline; TPDO: inhibit time, then the rest of the event time
} CO_PDO;

typedef CO_PDO CO_RPDO;  ///< element of node.RPdo
typedef CO_PDO CO_TPDO;  ///< element of node.TPdo

#if CO_MPDO_N > 0
/// \cond internal
typedef struct CO_MPDO_BLOCK_T {  ///< an entry of the object dispatching list
  uint32_t Producer;              ///< CO_DEV() of its first object in the producer, and the producer's node-ID
  uint16_t Entry;                 ///< number of the first object in this node's dictionary
  uint8_t Num;                    ///< number of objects
} CO_MPDO_BLOCK;

typedef struct CO_MPDO_T {         ///< the resolved lists
  CO_MPDO_BLOCK Block[CO_MPDO_N];  ///< object dispatching list
  uint16_t BlockNum;
  uint16_t ScanNum;
  uint16_t Scan[CO_MPDO_N];                  ///< entries of the object scanner list: numbers in the dictionary
  uint8_t Waiting[(CO_MPDO_N + 7) / 8];      ///< a bit for each object of Scan: transmission is pending
  uint8_t Transferred[(CO_MPDO_N + 7) / 8];  ///< a bit for each object of Scan: sent since the application has read it
  uint16_t NextObject;                       ///< round-robin index: the next object of Scan to be sent
  uint16_t Producer;                         ///< number of the TPDO, from 1; 0: none
} CO_MPDO;
/// \endcond
#endif

/// Requests the transmission of TPDO \a num, 0…CO_TPDO_N-1. [CiA 301, 7.2.2.5] The PDO is sent at once, when its
/// inhibit time has elapsed, or with the next SYNC (type 0), with the values at the time of transmission. On any error
/// nothing is sent, now or later. If an object cannot be read, the result is that of its type's Read function.
/// \retval CO_ERR_NONE              the PDO is sent, or will be sent
/// \retval CO_ERR_BAD_ARG           \a node is null
/// \retval CO_ERR_TPDO_NUM_TRIGGER  there is no such number
/// \retval CO_ERR_NMT_MODE          the node is not in Operational
/// \retval CO_ERR_TPDO_COM_OBJ      the PDO does not exist
/// \retval CO_ERR_TPDO_EVENT        the transmission type (1…240, 252, 253) is not event-driven, or the PDO is sent by
///                                  COTPdoSendTo()
/// \retval CO_ERR_TPDO_OBJ_TRIGGER  the object scanner list is empty
/// \retval CO_ERR_IF_CAN_SEND       the transmit queue is full
CO_ERR COTPdoRequest(struct CO_NODE_T* node, uint16_t num);

/// Sends \a value to the object \a key, CO_DEV(index, sub-index), of up to 4 bytes, of node \a node_id (1…127; 0: all
/// nodes). \a num is a TPDO with destination addressing (sub 0 of its mapping is FFh). The first byte on the bus is
/// bits 7…0 of \a value. [CiA 301, 7.2.3] On an error the value is not sent later.
/// \retval CO_ERR_NONE              the frame was given to the driver or to the transmit queue
/// \retval CO_ERR_BAD_ARG           \a node is null, or \a node_id is above 127
/// \retval CO_ERR_TPDO_NUM_TRIGGER  there is no such number
/// \retval CO_ERR_NMT_MODE          the node is not in Operational
/// \retval CO_ERR_TPDO_COM_OBJ      the PDO does not exist
/// \retval CO_ERR_TPDO_MAP_OBJ      the PDO has no destination addressing
/// \retval CO_ERR_TPDO_INHIBIT      the inhibit time of the PDO has not elapsed
/// \retval CO_ERR_IF_CAN_SEND       the transmit queue is full
CO_ERR COTPdoSendTo(struct CO_NODE_T* node, uint16_t num, uint8_t node_id, uint32_t key, uint32_t value)
    CO_NEEDS(CO_MPDO_N);

/// \name Received and sent PDOs
/// Return whether a PDO, or an object in a PDO, was received or sent since the last call (or since the PDO was switched
/// on). PDOs and their objects are tracked independently. Received means written to the objects: for a synchronous RPDO
/// at the SYNC. Sent means given to the driver or to the transmit queue. False if the PDO or object does not exist.
/// \{
bool CORPdoWasReceived(struct CO_NODE_T* node, uint16_t num);          ///< RPDO \a num, 0…CO_RPDO_N-1
bool COTPdoWasSent(struct CO_NODE_T* node, uint16_t num);              ///< TPDO \a num, 0…CO_TPDO_N-1
bool CORPdoObjWasReceived(struct CO_NODE_T* node, const CO_OBJ* obj);  ///< \a obj in any RPDO
bool COTPdoObjWasSent(struct CO_NODE_T* node, const CO_OBJ* obj);      ///< \a obj in any TPDO
/// \}

/// \name As in CANopen-Stack
/// Requests whose errors are only the node's error, and callbacks: functions that the application may define (see
/// co_nmt.h); the defaults do nothing. CO_CALLBACKS (co_callbacks.h) has functions of one node for the same events.
/// \{

/// Requests the transmission of TPDO \a num of \a tpdo (node.TPdo) like COTPdoRequest(), but reports errors as the
/// node's error (CONodeGetErr()). \a num out of range: CO_ERR_TPDO_NUM_TRIGGER.
void COTPdoTrigPdo(CO_TPDO* tpdo, uint16_t num);

/// Like COTPdoTrigPdo(), for all TPDOs of \a tpdo (node.TPdo) that map \a obj. If no TPDO maps it, or it is not an
/// entry of the node's dictionary, the node's error is CO_ERR_TPDO_OBJ_TRIGGER.
void COTPdoTrigObj(CO_TPDO* tpdo, CO_OBJ* obj);

/// Called before a TPDO is sent; may change \a frm.
void COPdoTransmit(CO_IF_FRM* frm);

/// Called when an RPDO of at least the mapped length has arrived. The default returns 0.
/// \retval 0      the stack writes the mapped objects
/// \retval other  the application has processed the frame; the stack writes nothing
int16_t COPdoReceive(CO_IF_FRM* frm);

/// Called after the objects of a synchronous RPDO were written, besides COPdoUpdate().
void COPdoSyncUpdate(CO_RPDO* pdo);
/// Called after the objects of any RPDO were written.
void COPdoUpdate(CO_RPDO* pdo);

/// Replaces the Write functions of mapped objects of more than 4 bytes, if the application defines it; there is no
/// default. \a pos: position of the first byte in frm->Data, \a size: bytes.
void CORpdoWriteData(CO_IF_FRM* frm, uint8_t pos, uint8_t size, CO_OBJ* obj);
/// Replaces the Read functions of mapped objects of more than 4 bytes, like CORpdoWriteData().
void COTpdoReadData(CO_IF_FRM* frm, uint8_t pos, uint8_t size, CO_OBJ* obj);
/// \}

#ifdef __cplusplus
}
#endif

#endif
