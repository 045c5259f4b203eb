// SPDX-License-Identifier: Apache-2.0
/// \file co_pdo_types.h
/// Types of the entries that configure PDOs: 1400h…, 1600h…, 1800h…, 1A00h…, and the lists of multiplex PDOs. [CiA 301,
/// 7.5.2.35-40]
#ifndef CO_PDO_TYPES_H_
#define CO_PDO_TYPES_H_

#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name 1400h…, 1800h…, sub 1: COB-ID of a PDO
/// [CiA 301, 7.5.2.35, 37] Data: a uint32_t, or the value itself (flag D); with flag N the CAN-ID is relative to the
/// node-ID, the flags of the COB-ID are not. Bit 31 set: the PDO does not exist. Bit 30 set: no remote requests (TPDO;
/// reserved in RPDOs, ignored). Bit 29 set: 29-bit CAN-ID. While the PDO exists, bits 0 to 29 cannot be changed; a
/// CAN-ID that CiA 301 restricts, one that does not fit the frame format, and a PDO without mapping are refused (0609
/// 0030h). A write takes effect at once.
/// \{

extern const CO_OBJ_TYPE COTPdoId;  ///< functions of CO_TPDO_ID

/// Type of 1400h… and 1800h…, sub 1, for RPDOs and TPDOs.
#define CO_TPDO_ID ((const CO_OBJ_TYPE*)&COTPdoId)
/// \}

/// \name 1400h…, 1800h…, sub 2: transmission type
/// [CiA 301, 7.5.2.35, 37] Data: a uint8_t, or the value itself (flag D). RPDO: 0…240 synchronous, 254 and 255
/// event-driven. TPDO: 0 with the SYNC after an event, 1…240 with every n-th SYNC, 252 and 253 on remote request
/// (USE_PDO_RTR), sampled at the SYNC or at the request, 254 and 255 event-driven. Other values are refused (0609
/// 0030h); while a multiplex PDO exists (co_pdo.h), all but 254 and 255 are. May be written at any time and takes
/// effect at once.
/// \{

extern const CO_OBJ_TYPE COTPdoType;  ///< functions of CO_TPDO_TYPE

/// Type of 1400h… and 1800h…, sub 2, for RPDOs and TPDOs.
#define CO_TPDO_TYPE ((const CO_OBJ_TYPE*)&COTPdoType)
/// \}

/// \name 1800h…, sub 3: inhibit time
/// [CiA 301, 7.5.2.37] Data: a uint16_t in units of 100 µs, or the value itself (flag D); 0: none. Minimum time between
/// two transmissions of an event-driven TPDO. A change while the PDO exists is refused (0609 0030h). With a plain
/// CO_TUNSIGNED16 instead, a change takes effect when the PDO is switched on. An RPDO (1400h…) may have the entry,
/// which has no effect.
/// \{

extern const CO_OBJ_TYPE COTPdoInhibit;  ///< functions of CO_TPDO_INHIBIT

#define CO_TPDO_INHIBIT ((const CO_OBJ_TYPE*)&COTPdoInhibit)  ///< type of 1800h…, sub 3
/// \}

/// \name 1400h…, 1800h…, sub 5: event timer
/// [CiA 301, 7.5.2.35, 37] Data: a uint16_t in ms, or the value itself (flag D); 0: off. TPDO: an event-driven TPDO is
/// sent when this time has elapsed since its last transmission. RPDO: maximum time between two receptions, from the
/// first one on; if it elapses, the node reports 8250h. A write takes effect at once.
/// \{

extern const CO_OBJ_TYPE COTPdoEvent;  ///< functions of CO_TPDO_EVENT

/// Type of 1400h… and 1800h…, sub 5, for RPDOs and TPDOs.
#define CO_TPDO_EVENT ((const CO_OBJ_TYPE*)&COTPdoEvent)
/// \}

/// \name 1800h…, sub 6: SYNC start value
/// [CiA 301, 7.5.2.37] Data: a uint8_t, or the value itself (flag D). If it is not 0 and SYNC has a counter (1019h),
/// the SYNC with this counter value is the first that the TPDO counts. Values above 240, and a change while the PDO
/// exists, are refused (0609 0030h).
/// \{

extern const CO_OBJ_TYPE COTPdoStart;  ///< functions of CO_TPDO_START

#define CO_TPDO_START ((const CO_OBJ_TYPE*)&COTPdoStart)  ///< type of 1800h…, sub 6
/// \}

/// \name 1600h…, 1A00h…, sub 0: number of mapped objects
/// [CiA 301, 7.5.2.36, 38] Data: a uint8_t, or the value itself (flag D). Refused: while the PDO exists (0601 0000h);
/// more objects than CO_PDO_MAP_N, or more than 64 bits (0604 0042h); an entry without a mappable object (0604 0041h).
/// After a refused write the number is 0. Objects without flag P, which the table may map (CO_TPDO_MAP), are refused
/// unless the number is the one that sub 0 already has.
///
/// With CO_MPDO_N above 0: FEh and FFh make it a multiplex PDO with source or destination addressing (co_pdo.h).
/// Refused: if the transmission type is not 254 or 255 (0604 0043h); FEh, if the dictionary has no object scanner or
/// dispatching list (0604 0042h), or if there is another TPDO of that kind (0604 0043h).
/// \{

extern const CO_OBJ_TYPE COTPdoNum;  ///< functions of CO_TPDO_NUM

/// Type of 1600h… and 1A00h…, sub 0, for RPDOs and TPDOs.
#define CO_TPDO_NUM ((const CO_OBJ_TYPE*)&COTPdoNum)
/// \}

/// \name 1600h…, 1A00h…, sub 1…: a mapped object
/// CO_LINK(index, sub-index, bits). [CiA 301, 7.5.2.36, 38] Data: a uint32_t, or the value itself (flag D). Refused:
/// while the PDO exists, and while sub 0 is not 0 (0601 0000h); an index without object (0602 0000h); an object without
/// flag P, without flag W (RPDO) or R (TPDO), or of another length (0604 0041h).
///
/// The mapping in the table may also contain objects without flag P: the PDO works, also after resets and when its
/// COB-ID switches it off and on. CO_OD_CHECK() rejects such an object (CO_DICT_NOT_MAPPABLE) if the mapping is a
/// constant (flag D): add flag P, or do not use the check. If the mapping entries have another type that the network
/// may write (CO_TUNSIGNED32), flag P is not checked at all. An RPDO may map the static data types 0001h…0007h, which
/// need no entry in the dictionary, to skip their bits. [CiA 301, 7.4.1]
/// \{

extern const CO_OBJ_TYPE COTPdoMap;  ///< functions of CO_TPDO_MAP

/// Type of 1600h… and 1A00h…, sub 1…, for RPDOs and TPDOs.
#define CO_TPDO_MAP ((const CO_OBJ_TYPE*)&COTPdoMap)
/// \}

/// \name 1FA0h…1FCFh, sub 1…254: object scanner list
/// With CO_MPDO_N above 0. [CiA 301, 7.5.2.39] It contains the objects of the one TPDO that is a multiplex PDO with
/// source addressing (co_pdo.h). Data: a uint32_t, CO_MPDO_SCAN(), or the value itself (flag D); 0: the entry is not
/// used. The list begins with 1FA0h sub 1 and continues with all entries in the dictionary; sub 0 is a plain
/// CO_TUNSIGNED8.
///
/// Refused: an index without object (0602 0000h); an object that could not be mapped into a TPDO, or has more than 4
/// bytes (0604 0041h); more than CO_MPDO_N objects (0604 0042h); a block beyond sub-index 255 (0609 0030h). A
/// change takes effect at once and discards pending transmissions; with a plain CO_TUNSIGNED32, it takes effect when
/// the PDO is switched on.
/// \{

extern const CO_OBJ_TYPE COTPdoScan CO_NEEDS(CO_MPDO_N);  ///< functions of CO_TPDO_SCAN

#define CO_TPDO_SCAN ((const CO_OBJ_TYPE*)&COTPdoScan)  ///< type of 1FA0h…1FCFh, sub 1…254

/// Value of an entry: \a block objects with consecutive sub-indices (0 and 1: one), from \a idx, \a sub on.
#define CO_MPDO_SCAN(block, idx, sub) \
  ((((uint32_t)(block)&0xFFu) << 24) | (((uint32_t)(idx)&0xFFFFu) << 8) | ((uint32_t)(sub)&0xFFu))
/// \}

/// \name 1FD0h…1FFFh, sub 1…254: object dispatching list
/// With CO_MPDO_N above 0. [CiA 301, 7.5.2.40] It defines which object of this node is written when an object of
/// another node is received in a multiplex PDO with source addressing (co_pdo.h). The first matching entry is used.
/// Data: a uint64_t, CO_MPDO_DISPATCH(); 0: the entry is not used. The list begins with 1FD0h sub 1 and continues with
/// all entries in the dictionary; sub 0 is a plain CO_TUNSIGNED8.
///
/// Refused: an index without object (0602 0000h); an object of this node that could not be mapped into an RPDO, or has
/// more than 4 bytes (0604 0041h); more than CO_MPDO_N entries (0604 0042h); a node-ID outside 1…127, a block
/// beyond sub-index 255 (0609 0030h). A change takes effect at once; with a plain CO_TUNSIGNED64, when an RPDO that
/// uses the list is switched on.
/// \{

extern const CO_OBJ_TYPE COTPdoDispatch CO_NEEDS(CO_MPDO_N);  ///< functions of CO_TPDO_DISPATCH

#define CO_TPDO_DISPATCH ((const CO_OBJ_TYPE*)&COTPdoDispatch)  ///< type of 1FD0h…1FFFh, sub 1…254

/// Value of an entry: \a block objects with consecutive sub-indices (0 and 1: one), from \a idx, \a sub on in this
/// node, and from \a from_idx, \a from_sub on in node \a node_id.
#define CO_MPDO_DISPATCH(block, idx, sub, from_idx, from_sub, node_id)                                       \
  ((((uint64_t)(block)&0xFFu) << 56) | (((uint64_t)(idx)&0xFFFFu) << 40) | (((uint64_t)(sub)&0xFFu) << 32) | \
   (((uint64_t)(from_idx)&0xFFFFu) << 16) | (((uint64_t)(from_sub)&0xFFu) << 8) | ((uint64_t)(node_id)&0xFFu))
/// \}

#ifdef __cplusplus
}
#endif

#endif
