// SPDX-License-Identifier: Apache-2.0
/// \file co_emcy.h
/// Emergencies: EMCY producer with error register (1001h) and history (1003h), and EMCY consumer (1028h). [CiA
/// 301, 7.2.7]
///
/// Errors are those of the application (COEmcySet()) and those that the stack detects: lost frames (8110h), error
/// passive (8120h), a missing node or NMT master (8130h), recovered from bus-off (8140h), own CAN-ID in use by another
/// node (8150h), PDO too short (8210h) or too long (8220h), no object for an MPDO (8230h), SYNC with wrong length
/// (8240h), PDO missing (8250h); SRDOs (co_srdo.h): faulty configuration (6300h), any other fault (8200h).
///
/// An error that occurs is entered in 1003h, sets its bit and the generic bit in 1001h, and is sent: error code, 1001h
/// at that moment, five bytes. An error that is resolved is sent as code 0000h with the remaining bits of 1001h. Errors
/// that occur while the NMT state does not allow EMCY, or while 1014h is missing or not valid, are not sent, then or
/// later.
///
/// Errors of the stack have 0 in the first two of the five bytes, and a node-ID, the number of a PDO, or 0 in the
/// third; those of SRDOs have an index in the third and fourth, and a sub-index or a state in the fifth. 8110h and
/// 8150h are resolved when they have not occurred again for one second, and are sent once in that time. At bus-off
/// nothing can be sent: after recovery the node sends 8140h, and 0000h at once.
///
/// Inhibit time: 1015h (a plain CO_TUNSIGNED16, x 100 µs) is read at each message, so a new value applies from the next
/// message on. Messages that wait for the inhibit time, or for the transmit queue, are stored in a queue of
/// CO_EMCY_QUEUE_N messages. If it is full, a new message replaces the newest one in it, which is counted as dropped:
/// the first messages are kept, and the last message always reports the present state. CO_EMCY_QUEUE_N 0 omits queue
/// and inhibit time.
///
/// Messages are sent where the API call that has caused them ends, before event-driven TPDOs. COEmcySet(), COEmcyClr()
/// and COEmcyReset() send them at once.
///
/// 1001h is written when it changes, before the message is sent, by the Write function of its entry: its variable must
/// be in RAM. An entry that holds the value itself (flag D) is not written, because its table may be in read-only
/// memory.
///
/// Resets: "reset node" resolves all errors and empties 1003h. "Reset communication" resolves the errors of the stack;
/// 1003h and the errors of the application remain, because the application continues to run. No EMCY is sent for
/// resolved errors in either case.
///
/// Context: the loop. Null pointers: CONodeFatalError(), unless a description says otherwise.
#ifndef CO_EMCY_H_
#define CO_EMCY_H_

#include "co_cfg.h"
#include "co_obj.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/faults.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Values for 1014h and 1028h
/// \a valid: 1 = the EMCY exists, \a id: CAN-ID
/// \{
#define CO_EMCY_COBID_OFF 0x80000000u   ///< bit 31: the EMCY does not exist
#define CO_EMCY_COBID_EXT 0x20000000u   ///< bit 29: 29-bit CAN-ID
#define CO_EMCY_COBID_MASK 0x1FFFFFFFu  ///< bits 0…28: CAN-ID
/// Value with an 11-bit CAN-ID.
#define CO_COBID_EMCY_STD(valid, id) ((((uint32_t)(id)) & 0x7FFu) | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// Value with a 29-bit CAN-ID.
#define CO_COBID_EMCY_EXT(valid, id) \
  ((((uint32_t)(id)) & 0x1FFFFFFFu) | 0x20000000u | ((1u - (((uint32_t)(valid)) & 1u)) << 31))
/// \}

/// \name Bits of the error register (1001h), for CO_EMCY_TBL.Reg. [CiA 301, 7.5.2.2]
/// \{
enum {
  CO_EMCY_REG_GENERAL = 0,       ///< generic error: set with each of the others
  CO_EMCY_REG_CURRENT = 1,       ///< current
  CO_EMCY_REG_VOLTAGE = 2,       ///< voltage
  CO_EMCY_REG_TEMP = 3,          ///< temperature
  CO_EMCY_REG_COM = 4,           ///< communication
  CO_EMCY_REG_PROFILE = 5,       ///< device profile
  CO_EMCY_REG_MANUFACTURER = 7,  ///< manufacturer
  CO_EMCY_REG_NUM = 8,           ///< number of bits
};
/// \}

/// \name Error codes. [CiA 301, 7.2.7.1 table 26]
/// \{
enum {
  CO_EMCY_CODE_NO_ERR = 0x0000,                    ///< error reset, no error
  CO_EMCY_CODE_GEN_ERR = 0x1000,                   ///< generic error
  CO_EMCY_CODE_CUR_ERR = 0x2000,                   ///< current
  CO_EMCY_CODE_CUR_INPUT_ERR = 0x2100,             ///< current, input side of the device
  CO_EMCY_CODE_CUR_INTERN_ERR = 0x2200,            ///< current inside the device
  CO_EMCY_CODE_CUR_OUTPUT_ERR = 0x2300,            ///< current, output side of the device
  CO_EMCY_CODE_VOL_ERR = 0x3000,                   ///< voltage
  CO_EMCY_CODE_VOL_INPUT_ERR = 0x3100,             ///< mains voltage
  CO_EMCY_CODE_VOL_INTERN_ERR = 0x3200,            ///< voltage inside the device
  CO_EMCY_CODE_VOL_OUTPUT_ERR = 0x3300,            ///< output voltage
  CO_EMCY_CODE_TEMP_ERR = 0x4000,                  ///< temperature
  CO_EMCY_CODE_TEMP_AMBIENT_ERR = 0x4100,          ///< ambient temperature
  CO_EMCY_CODE_TEMP_DEVICE_ERR = 0x4200,           ///< device temperature
  CO_EMCY_CODE_HW_ERR = 0x5000,                    ///< device hardware
  CO_EMCY_CODE_SW_ERR = 0x6000,                    ///< device software
  CO_EMCY_CODE_SW_INTERNAL_ERR = 0x6100,           ///< internal software
  CO_EMCY_CODE_SW_USER_ERR = 0x6200,               ///< user software
  CO_EMCY_CODE_SW_DATASET_ERR = 0x6300,            ///< data set
  CO_EMCY_CODE_ADD_MODULES_ERR = 0x7000,           ///< additional modules
  CO_EMCY_CODE_MON_ERR = 0x8000,                   ///< monitoring
  CO_EMCY_CODE_MON_COM_ERR = 0x8100,               ///< communication
  CO_EMCY_CODE_MON_COM_OVERRUN_ERR = 0x8110,       ///< CAN overrun: received frames were lost
  CO_EMCY_CODE_MON_COM_PASSIVE_ERR = 0x8120,       ///< CAN controller is error passive
  CO_EMCY_CODE_MON_COM_HEARTBEAT_ERR = 0x8130,     ///< life guard error or heartbeat error
  CO_EMCY_CODE_MON_COM_RECOVER_ERR = 0x8140,       ///< recovered from bus-off
  CO_EMCY_CODE_MON_COM_COLLISION_ERR = 0x8150,     ///< CAN-ID collision
  CO_EMCY_CODE_MON_PROT_ERR = 0x8200,              ///< protocol error
  CO_EMCY_CODE_MON_PROT_PDO_IGN_ERR = 0x8210,      ///< PDO not processed: too short
  CO_EMCY_CODE_MON_PROT_PDO_LEN_ERR = 0x8220,      ///< PDO length exceeded
  CO_EMCY_CODE_MON_PROT_DAM_ERR = 0x8230,          ///< MPDO with destination addressing not processed: no such object
  CO_EMCY_CODE_MON_PROT_SYNC_LEN_ERR = 0x8240,     ///< unexpected data length of SYNC
  CO_EMCY_CODE_MON_PROT_PDO_TIMEOUT_ERR = 0x8250,  ///< RPDO timeout
  CO_EMCY_CODE_EXT_ERR = 0x9000,                   ///< external error
  CO_EMCY_CODE_ADD_FUNC_ERR = 0xF000,              ///< additional functions
  CO_EMCY_CODE_DEV_ERR = 0xFF00,                   ///< device-specific
};
/// \}

struct CO_NODE_T;

/// An error of the application. CO_NODE_SPEC.EmcyCode is a table of them, and the index in it is the error's
/// identifier. The table has CO_EMCY_N entries, or CO_NODE_EXT.EmcyNum.
typedef struct CO_EMCY_TBL_T {
  uint8_t Reg;    ///< CO_EMCY_REG_…; with any other number the error sets only the generic bit
  uint16_t Code;  ///< CO_EMCY_CODE_…, or of a device profile
} CO_EMCY_TBL;

/// Manufacturer-specific data of an error.
typedef struct CO_EMCY_USR_T {
  uint16_t Hist;    ///< bits 31…16 in 1003h. CiA's conformance test requires the first two bytes of Emcy here
  uint8_t Emcy[5];  ///< the five bytes of the message
} CO_EMCY_USR;

/// Size of a bit array with a bit for each error of the application, in bytes.
#define CO_EMCY_STORAGE (1 + (CO_EMCY_N - 1) / 8)

/// \cond internal
#define CO_EMCY_HOLD_N 2  // kinds of these that may occur with every frame (8110h, 8150h)

typedef struct CO_EMCY_HIST_T {                         // ring of entries of 1003h
  uint8_t Found;                                        // entries counted while their types are initialised
  uint8_t Max;                                          // number of entries
  uint8_t Num;                                          // number of entries in use
  uint8_t Off;                                          // sub-index of the newest entry
  void (*Add)(struct CO_NODE_T* node, uint32_t entry);  // adds an entry, set by the type of 1003h; null: no history
} CO_EMCY_HIST;

#if CO_RPDO_N > 255
typedef uint16_t CO_EMCY_COUNT;  // number of nodes, PDOs or SRDOs that have an error
#else
typedef uint8_t CO_EMCY_COUNT;
#endif

typedef struct CO_EMCY_MSG_T {  // bytes of a message, the first one lowest
  uint32_t Low;
  uint32_t High;
} CO_EMCY_MSG;
/// \endcond

/// Emergencies of a node: &node.Emcy. The application must not access the members.
typedef struct CO_EMCY_T {
  struct CO_NODE_T* Node;                    ///< owner
  const CO_EMCY_TBL* Root;                   ///< CO_NODE_SPEC.EmcyCode
  uint8_t Register;                          ///< error register
  uint8_t Waiting;                           ///< messages in the queue, oldest first
  uint16_t Faults;                           ///< number of unresolved occurrences of all errors of the stack
  uint8_t Err[CO_EMCY_STORAGE];              ///< errors of the application: bit 0 of byte 0 is identifier 0
  CO_EMCY_COUNT Fault[CO_EMCY_FAULT_N];      ///< number of unresolved occurrences of each error of the stack
  CO_EMCY_HIST Hist;                         ///< 1003h
  CO_OBJ* RegisterEntry;                     ///< 1001h; null: there is none that is written
  CO_OBJ* IdEntry;                           ///< 1014h; null: there is none
  void (*ShowBits)(struct CO_NODE_T* node);  ///< triggers the TPDOs of error status bits; null: there are none
  CO_TMR_MEM Hold[CO_EMCY_HOLD_N];           ///< times until 8110h and 8150h are resolved
#if CO_EMCY_QUEUE_N > 0
  CO_OBJ* InhibitEntry;                ///< 1015h; null: there is none
  CO_TMR_MEM Tmr;                      ///< inhibit time
  CO_EMCY_MSG Queue[CO_EMCY_QUEUE_N];  ///< messages that wait for the inhibit time or the transmit queue
#endif
} CO_EMCY;

/// Sets error \a err (index in CO_NODE_SPEC.EmcyCode) of the application. \a usr: manufacturer-specific data, or null:
/// all 0. Has no effect while the error is set. Errors are reported by CONodeGetErr():
/// - CO_ERR_EMCY_BAD_ROOT: CO_NODE_SPEC.EmcyCode is null;
/// - CO_ERR_BAD_ARG: there is no such error;
/// - the result of the type of 1001h or 1003h if the object could not be written.
void COEmcySet(CO_EMCY* emcy, uint8_t err, const CO_EMCY_USR* usr) CO_NEEDS(USE_EMCY);

/// Clears error \a err of the application. Has no effect if it is not set. Node error CO_ERR_BAD_ARG: there is no such
/// error.
void COEmcyClr(CO_EMCY* emcy, uint8_t err) CO_NEEDS(USE_EMCY);

/// Returns whether error \a err of the application is set.
/// \retval 1   the error is set
/// \retval 0   the error is not set
/// \retval -1  there is no such error, or \a emcy is null or belongs to no node
int16_t COEmcyGet(CO_EMCY* emcy, uint8_t err) CO_NEEDS(USE_EMCY);

/// Returns the number of errors of the application that are set.
/// \retval -1  \a emcy is null
int16_t COEmcyCnt(CO_EMCY* emcy) CO_NEEDS(USE_EMCY);

/// Clears all errors of the application, with messages as in COEmcyClr() if \a silent is 0. Errors of the stack remain.
void COEmcyReset(CO_EMCY* emcy, uint8_t silent) CO_NEEDS(USE_EMCY);

/// Empties 1003h, as writing 0 to its sub-index 0 does.
void COEmcyHistReset(CO_EMCY* emcy) CO_NEEDS(USE_EMCY);

/// \name Error status bits
/// An object of any index that shows the state of each error as an octet string: bit n of the string (bit n % 8 of byte
/// n / 8) is 1 while error n of the application is set (COEmcySet()). Two more bytes can show the errors that the stack
/// detects. The network reads the object by any SDO transfer; only the application changes the bits, by COEmcySet(),
/// COEmcyClr() and COEmcyReset(): writes are refused (0601 0002h). A string of up to 8 bytes can be mapped into TPDOs,
/// and each change of a bit triggers the event-driven ones. In a transfer of several segments each byte has the value
/// at the time of its segment.
///
///     static CO_EMCY_BITS ErrorBits = {0, 4, 0};  // errors 0...31
///     {CO_KEY(0x2100, 0, CO_OBJ____PR_), CO_TEMCY_BITS, (CO_DATA)(&ErrorBits)},
/// \{

/// An object that shows error status bits, in RAM.
typedef struct CO_EMCY_BITS_T {
  uint32_t Offset;  ///< position of the next access
  /// Bytes with errors of the application: 1...255, 0: as many as the table of errors needs (CO_NODE_EXT.EmcyNum, or
  /// CO_EMCY_N). Bits without an error are 0.
  uint8_t Size;
  uint8_t Stack;  ///< 1: two bytes with the errors of the stack follow (CO_EMCY_BIT_...); 0: none
} CO_EMCY_BITS;

enum {
  CO_EMCY_BIT_OVERRUN = 0,              ///< 8110h: received frames were lost
  CO_EMCY_BIT_COLLISION = 1,            ///< 8150h: CAN-ID collision
  CO_EMCY_BIT_PASSIVE = 2,              ///< 8120h: error passive
  CO_EMCY_BIT_HEARTBEAT = 3,            ///< 8130h: a node is missing
  CO_EMCY_BIT_LIFE_GUARD = 4,           ///< 8130h: the NMT master is missing
  CO_EMCY_BIT_BUS_OFF = 5,              ///< 8140h: bus-off, until the recovery is reported
  CO_EMCY_BIT_PDO_SHORT = 6,            ///< 8210h: PDO too short
  CO_EMCY_BIT_PDO_LONG = 7,             ///< 8220h: PDO too long
  CO_EMCY_BIT_PDO_UNKNOWN = 8,          ///< 8230h: no object for an MPDO
  CO_EMCY_BIT_SYNC_LENGTH = 9,          ///< 8240h: SYNC with wrong length
  CO_EMCY_BIT_PDO_TIMEOUT = 10,         ///< 8250h: RPDO missing
  CO_EMCY_BIT_SRDO_CONFIGURATION = 11,  ///< 6300h: configuration of an SRDO
  CO_EMCY_BIT_SRDO = 12,                ///< 8200h: an SRDO has failed
};

extern const CO_OBJ_TYPE COTEmcyBits CO_NEEDS(USE_EMCY);  ///< functions of CO_TEMCY_BITS

#define CO_TEMCY_BITS ((const CO_OBJ_TYPE*)&COTEmcyBits)  ///< OCTET_STRING; Data: a CO_EMCY_BITS
/// \}

/// \name Callbacks of the application
/// Ordinary functions to be defined by the application (see co_nmt.h); the defaults do nothing.
/// \{

/// Called when an EMCY message of node \a nodeId, which has an entry in 1028h, was received in an NMT state that allows
/// EMCY. \a code: error code (0: an error is resolved), \a reg: error register of that node, \a msef:
/// manufacturer-specific bytes.
void COEmcyReceived(struct CO_NODE_T* node, uint8_t nodeId, uint16_t code, uint8_t reg, const uint8_t msef[5]);
/// \}

/// \name 1014h, COB-ID EMCY
/// [CiA 301, 7.5.2.17] Data: a uint32_t, or the value itself (flag D); with flag N the CAN-ID is relative to the node-
/// ID, the flags of the COB-ID are not. Bit 31 set: no EMCY is sent. Bit 29 set: 29-bit CAN-ID. While bit 31 is 0 the
/// other bits cannot be changed, unless the same write sets bit 31. Always refused are restricted CAN-IDs, bit 30, and
/// a CAN-ID that does not fit the frame format (0609 0030h). A write takes effect at once; queued messages are
/// discarded when bit 31 is set, and counted as dropped.
/// \{

extern const CO_OBJ_TYPE COTEmcyId CO_NEEDS(USE_EMCY);  ///< functions of CO_TEMCY_ID

#define CO_TEMCY_ID ((const CO_OBJ_TYPE*)&COTEmcyId)  ///< type of 1014h
/// \}

/// \name 1003h, pre-defined error field
/// [CiA 301, 7.5.2.4] Sub-index 0: number of errors in the history, Data: a uint8_t, which is not used, or flag D.
/// Writing 0 empties the history; other values are refused (0609 0030h). Sub-indices 1…254 without a gap: the errors, 1
/// is the newest; code in bits 15…0, manufacturer-specific information in bits 31…16. Data: a uint32_t each, not flag
/// D. The variables form a ring: read them through the dictionary. Reading an unused entry returns CO_ERR_TYPE_RD; an
/// SDO client gets 0800 0024h. The errors cannot be written (0601 0002h).
/// \{

extern const CO_OBJ_TYPE COTEmcyHist CO_NEEDS(USE_EMCY);  ///< functions of CO_TEMCY_HIST

#define CO_TEMCY_HIST ((const CO_OBJ_TYPE*)&COTEmcyHist)  ///< type of 1003h, all sub-indices
/// \}

/// \name 1028h, emergency consumer object, sub 1…127
/// The COB-ID of the EMCY messages of the node with that node-ID; up to CO_EMCY_CONS_N. [CiA 301, 7.5.2.30] Sub 0 is a
/// plain CO_TUNSIGNED8. Data: a uint32_t, or the value itself (flag D). Bit 31 set: messages of the node are ignored.
/// While bit 31 is 0 the other bits cannot be changed, unless the same write sets bit 31. Restricted CAN-IDs, and those
/// that do not fit the frame format, are refused (0609 0030h). A write takes effect at once.
/// \{

extern const CO_OBJ_TYPE COTEmcyCons CO_NEEDS(CO_EMCY_CONS_N);  ///< functions of CO_TEMCY_CONS

#define CO_TEMCY_CONS ((const CO_OBJ_TYPE*)&COTEmcyCons)  ///< type of 1028h, sub 1…127
/// \}

#ifdef __cplusplus
}
#endif

#endif
