// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo.h
/// Process data objects. [301:7.2.2] Configured by 1400h…, 1600h… (RPDOs) and 1800h…, 1A00h… (TPDOs), in the table or
/// by the network. A mapping is resolved when it is switched on: PDOs that pass neither look objects up nor check them.
///
/// Objects of 1 to 8 bytes of every type can be mapped. The objects of a PDO are copied, neighbours together, if all
/// are plain numbers of 1, 2 or 4 bytes in variables, aligned in the frame as in memory; else the Read and Write
/// functions of their types are called. Each number of up to 4 bytes is stored in one access; what belongs together
/// beyond that is protected by CO_NODE_EXT.OdLock and OdUnlock, which are held while the objects of a PDO are copied,
/// and while those of all RPDOs of one SYNC are:
///   - interrupt and loop: the stack in the loop, the application's interrupt reads mapped objects. OdLock keeps the
///     interrupt away, OdUnlock lets it in again.
///   - two threads: both take a mutex, the stack by OdLock and OdUnlock, the application around its own accesses. The
///     functions and callbacks of this file are called by the stack without it, except the Read and Write functions of
///     types.
///
/// Multiplex PDOs, with USE_MPDO [301:7.2.3]: each frame names an object of up to 4 bytes, whose value it has. Sub 0 of
/// the mapping says so; they are event-driven, and know no remote requests.
///   - FFh, destination addressing: the frame names an object of the consumer, or of all consumers. It is sent by
///     COTPdoSendTo(), and written to what an RPDO could map (flags P and W). If there is no such object, EMCY 8230h is
///     sent, once until an object is written again. Frames for other nodes are as if they did not come.
///   - FEh, source addressing: the frame names an object of the producer. The object scanner list (co_pdo_scan.h) says
///     which objects the one TPDO of this kind has: each is sent alone, by COTPdoTrigObj() or flag A, and all of them
///     by a request, an event timer or at the start (CO_TPDO_ON_START), in the order of the list and each with its
///     value of then, an inhibit time apart. The object dispatching list (co_pdo_dispatch.h) says where the RPDOs of
///     this kind write; objects that it does not name are ignored.
/// COPdoTransmit(), COPdoReceive() and COPdoUpdate() are called for each frame. CORPdoObjWasReceived() knows the object
/// that a multiplex PDO has written last.
///
/// A TPDO that the SYNC, a timer or a remote request asks for, and that cannot be read, is not sent: the node's error
/// tells what the type has answered. One that still waits for the controller is replaced by a younger one, which is not
/// counted as dropped.
///
/// Context: the loop.
#ifndef CO_PDO_H_
#define CO_PDO_H_

#include "co_cfg.h"
#include "co_err.h"
#include "co_if.h"
#include "co_needs.h"
#include "co_obj.h"
#include "co_tmr.h"
#include "co_types.h"

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
#define CO_COBID_RPDO_STD(valid, id) ((((uint32_t)(id)) & 0x7FFu) | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
#define CO_COBID_RPDO_EXT(valid, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
#define CO_COBID_TPDO_STD(valid, id) \
  ((((uint32_t)(id)) & 0x7FFu) | 0x40000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
#define CO_COBID_TPDO_EXT(valid, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x60000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
#define CO_COBID_RPDO_BASE 0x200u  ///< of the first four RPDOs; the next lies CO_COBID_RPDO_INC above
#define CO_COBID_RPDO_INC 0x100u
#define CO_COBID_TPDO_BASE 0x180u  ///< of the first four TPDOs; the next lies CO_COBID_TPDO_INC above
#define CO_COBID_TPDO_INC 0x100u
/// Pre-defined connection set, with flag N. [301:7.3.5] \a n: 0…3
#define CO_COBID_RPDO_DEFAULT(n) (CO_COBID_RPDO_BASE + (uint32_t)(n)*CO_COBID_RPDO_INC)
#define CO_COBID_TPDO_DEFAULT(n) (0x40000000u + CO_COBID_TPDO_BASE + (uint32_t)(n)*CO_COBID_TPDO_INC)
/// \}

/// Objects that a PDO can have.
#if USE_PDO_BITS
#define CO_PDO_MAP_N 64
#else
#define CO_PDO_MAP_N 8
#endif

struct CO_NODE_T;

/// What a PDO holds, resolved.
typedef struct CO_PDO_MAP_T {
  uint8_t Flags;  ///< of the PDO
#if USE_MPDO
  uint8_t Mode;  ///< FEh, FFh: it is multiplexed, with source or destination addressing; 0: it is not
#endif
  uint8_t Length;                    ///< bytes, with USE_PDO_BITS bits; 0: the PDO does not exist
  uint8_t Span;                      ///< entries lie less than 2^Span behind Entry[0], modulo 2^16
  uint8_t Passed[CO_PDO_MAP_N / 8];  ///< a bit for each object: sent or received since the application has asked
  uint8_t Step[CO_PDO_MAP_N];  ///< copied in one, in units of Length; 0: with the object before. A bit more: it is not
                               ///< aligned in the frame. Bit 7 of the first: each by its type
  uint16_t Entry[CO_PDO_MAP_N];  ///< numbers of the entries in the dictionary; FFFFh: none, or a static data type
} CO_PDO_MAP;

/// Times of an event-driven TPDO.
typedef struct CO_TPDO_TIMES_T {
  uint32_t Inhibit;  ///< ticks, 0: none
  uint32_t Event;    ///< ticks, 0: none
} CO_TPDO_TIMES;

/// A PDO. The application touches nothing of it, and names it by its place: node.RPdo or node.TPdo, number.
typedef struct CO_PDO_T {
  struct CO_NODE_T* Node;
  uint16_t Next;  ///< RPDO: of those that wait for the SYNC; TPDO: of the synchronous ones
  uint8_t Type;
  uint8_t Count;  ///< TPDO: SYNCs since it was sent; or the SYNC start value that it waits for
  CO_PDO_MAP Map;
  union {
    uint32_t Deadline;    ///< RPDO: ticks, 0: none
    uint32_t Identifier;  ///< TPDO: of its frames
  };
  union {
    CO_TPDO_TIMES Time;  ///< event-driven TPDO
    uint8_t Data[8];     ///< synchronous: RPDO: waits for the SYNC; TPDO: as of the last SYNC, for remote requests
  } Own;                 ///< by Type
  CO_TMR_MEM Tmr;        ///< RPDO: deadline; TPDO: inhibit time, then what is left of the event time
} CO_PDO;

typedef CO_PDO CO_RPDO;
typedef CO_PDO CO_TPDO;

#if USE_MPDO
/// \cond internal
typedef struct CO_MPDO_BLOCK_T {  ///< an entry of the object dispatching list
  uint32_t Producer;              ///< CO_DEV() of its first object, and its node-ID
  uint16_t Entry;                 ///< number of the first object in the own dictionary
  uint8_t Num;                    ///< objects
} CO_MPDO_BLOCK;

typedef struct CO_MPDO_T {                  ///< the lists, resolved
  CO_MPDO_BLOCK Block[CO_MPDO_DISPATCH_N];  ///< dispatching
  uint16_t BlockNum;
  uint16_t ScanNum;
  uint16_t Scan[CO_MPDO_SCAN_N];              ///< numbers of the objects in the dictionary
  uint8_t Waiting[(CO_MPDO_SCAN_N + 7) / 8];  ///< a bit for each of them: it is to be sent
  uint8_t Passed[(CO_MPDO_SCAN_N + 7) / 8];   ///< sent since the application has asked
  uint16_t Turn;                              ///< whose turn it is to be sent
  uint16_t Producer;                          ///< the TPDO, from 1; 0: none
} CO_MPDO;
/// \endcond
#endif

/// Sends TPDO \a num of \a tpdo (node.TPdo), event-driven or with the next SYNC (type 0), as COTPdoRequest() does. What
/// keeps it from being sent is the node's error; \a num out of range: CO_ERR_TPDO_NUM_TRIGGER.
void COTPdoTrigPdo(CO_TPDO* tpdo, uint16_t num);

/// Like COTPdoTrigPdo(), for all TPDOs of \a tpdo (node.TPdo) that map \a obj. If no TPDO maps it, or it is not an
/// entry of the node's dictionary: CO_ERR_TPDO_OBJ_TRIGGER.
void COTPdoTrigObj(CO_TPDO* tpdo, CO_OBJ* obj);

/// An event for TPDO \a num, 0…CO_TPDO_N-1. [301:7.2.2.5] It is sent now, or as soon as its inhibit time has passed, or
/// with the next SYNC (type 0), with the values of then: CO_ERR_NONE. Else nothing is sent, now or later:
/// CO_ERR_TPDO_NUM_TRIGGER: no such number; CO_ERR_NMT_MODE: the node is not in Operational; CO_ERR_TPDO_COM_OBJ: the
/// PDO does not exist; CO_ERR_TPDO_EVENT: its type (1…240, 252, 253) knows no events, or it is sent by COTPdoSendTo();
/// what the type of an object answers that could not be read; CO_ERR_TPDO_OBJ_TRIGGER: its object scanner list is
/// empty; CO_ERR_IF_CAN_SEND: the transmit queue is full. CO_ERR_BAD_ARG: \a node is null.
CO_ERR COTPdoRequest(struct CO_NODE_T* node, uint16_t num);

/// Sends \a value to \a node_id (1…127; 0: to all) by TPDO \a num, which is a multiplex PDO with destination addressing
/// (sub 0 of its mapping is FFh): it is to be written to the object \a key, CO_DEV(index, sub-index), of up to 4 bytes
/// there. The first byte on the bus is that of bits 7…0. [301:7.2.3] Nothing is kept for later: CO_ERR_NONE if it was
/// given to the driver or to the transmit queue, else CO_ERR_BAD_ARG: \a node is null or \a node_id above 127;
/// CO_ERR_TPDO_NUM_TRIGGER: no such number; CO_ERR_NMT_MODE: the node is not in Operational; CO_ERR_TPDO_COM_OBJ: the
/// PDO does not exist; CO_ERR_TPDO_MAP_OBJ: it is of another kind; CO_ERR_TPDO_INHIBIT: its inhibit time has not
/// passed; CO_ERR_IF_CAN_SEND: the transmit queue is full.
CO_ERR COTPdoSendTo(struct CO_NODE_T* node, uint16_t num, uint8_t node_id, uint32_t key, uint32_t value)
    CO_NEEDS(USE_MPDO);

/// \name What has passed
/// True: it has, since the question was asked last (or since the PDO was switched on). A PDO and each of its objects
/// are asked independently. Received means written to the objects: a synchronous RPDO at the SYNC. Sent means given to
/// the driver or to the transmit queue. False also for what does not exist.
/// \{
bool CORPdoWasReceived(struct CO_NODE_T* node, uint16_t num);
bool COTPdoWasSent(struct CO_NODE_T* node, uint16_t num);
bool CORPdoObjWasReceived(struct CO_NODE_T* node, const CO_OBJ* obj);
bool COTPdoObjWasSent(struct CO_NODE_T* node, const CO_OBJ* obj);
/// \}

/// \name Callbacks of the application
/// Ordinary functions to be defined by the application (see co_nmt.h); the defaults do nothing.
/// \{

/// Before a TPDO is sent; \a frm may be changed.
void COPdoTransmit(CO_IF_FRM* frm);

/// An RPDO of at least the mapped length has arrived. Not 0: the application has taken it, nothing is written. Default:
/// 0.
int16_t COPdoReceive(CO_IF_FRM* frm);

/// The objects of an RPDO were written: of a synchronous one (both functions are called), of any one.
void COPdoSyncUpdate(CO_RPDO* pdo);
void COPdoUpdate(CO_RPDO* pdo);

/// Objects of more than 4 bytes: only if the application defines these functions, they are called in place of the
/// type's own. \a pos: first byte in frm->Data, \a size: bytes. There is no default.
void CORpdoWriteData(CO_IF_FRM* frm, uint8_t pos, uint8_t size, CO_OBJ* obj);
void COTpdoReadData(CO_IF_FRM* frm, uint8_t pos, uint8_t size, CO_OBJ* obj);
/// \}

#ifdef __cplusplus
}
#endif

#endif
