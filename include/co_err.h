// SPDX-License-Identifier: Apache-2.0
/// \file co_err.h
/// Error codes, and the last error of a node. Functions return error codes; the node also stores the last one.
#ifndef CO_ERR_H_
#define CO_ERR_H_

#include "co_types.h"

#ifdef __cplusplus
extern "C" {
#endif

#ifndef CO_ERR_BASE
/// Value of the first error code. Default 0x0100.
#define CO_ERR_BASE 0x0100
#endif

/// All error codes but CO_ERR_NONE: name, number in hexadecimal and decimal (with the default CO_ERR_BASE), meaning.
///
/// The numbers are part of the interface: a new code gets the next number at the end. Some codes are never returned by
/// the stack; they exist for firmware that refers to them.
// clang-format off
#define CO_ERR_LIST(X)                                                                                                 \
  X(CO_ERR_BAD_ARG, 0x100, 256, "an argument is null, out of range or of the wrong length")                            \
  X(CO_ERR_OBJ_NOT_FOUND, 0x101, 257, "no object has this index and sub-index")                                        \
  X(CO_ERR_OBJ_READ, 0x102, 258, "the object could not be read")                                                       \
  X(CO_ERR_OBJ_WRITE, 0x103, 259, "the object could not be written")                                                   \
  X(CO_ERR_OBJ_SIZE, 0x104, 260, "the object has another length")                                                      \
  X(CO_ERR_OBJ_INIT, 0x105, 261, "the Init function of an object type failed; the node runs")                          \
  X(CO_ERR_OBJ_MAP_LEN, 0x106, 262, "the PDO mapping is empty, has a gap or is too long (SDO abort 0604 0042h)")       \
  X(CO_ERR_OBJ_MAP_TYPE, 0x107, 263, "the object cannot be mapped to the PDO (SDO abort 0604 0041h)")                  \
  X(CO_ERR_OBJ_ACC, 0x108, 264, "the object cannot be read, or cannot be written")                                     \
  X(CO_ERR_OBJ_RANGE, 0x109, 265, "the value is not allowed (SDO abort 0609 0030h)")                                   \
  X(CO_ERR_OBJ_INCOMPATIBLE, 0x10A, 266, "the value contradicts another setting (SDO abort 0604 0043h)")               \
  X(CO_ERR_DICT_INIT, 0x10B, 267, "the dictionary is refused; CODictGetFault() returns the fault")                     \
  X(CO_ERR_PARA_IDX, 0x10C, 268, "wrong index of a parameter group")                                                   \
  X(CO_ERR_PARA_STORE, 0x10D, 269, "a parameter group does not fit into the non-volatile memory")                      \
  X(CO_ERR_PARA_RESTORE, 0x10E, 270, "COParaDefault() could not set the default values of a parameter group")          \
  X(CO_ERR_PARA_LOAD, 0x10F, 271, "a stored parameter group is damaged or unreadable; it has its default values")      \
  X(CO_ERR_LSS_STORE, 0x110, 272, "COLssStore() could not store node-ID and bit rate")                                 \
  X(CO_ERR_LSS_LOAD, 0x111, 273, "COLssLoad() could not load node-ID and bit rate")                                    \
  X(CO_ERR_CFG_1001_0, 0x112, 274, "the mandatory object 1001h:0 (error register) is missing; the node runs")          \
  X(CO_ERR_CFG_1003_0, 0x113, 275, "object 1003h:0 (number of errors) is missing or wrong")                            \
  X(CO_ERR_CFG_1003_1, 0x114, 276, "object 1003h:1 (last error) is missing or wrong")                                  \
  X(CO_ERR_CFG_1005_0, 0x115, 277, "object 1005h:0 (COB-ID SYNC) is missing or wrong")                                 \
  X(CO_ERR_CFG_1006_0, 0x116, 278, "object 1006h:0 (communication cycle period) is missing or wrong")                  \
  X(CO_ERR_CFG_1010_0, 0x117, 279, "object 1010h:0 (number of parameter groups to store) is missing or wrong")         \
  X(CO_ERR_CFG_1011_0, 0x118, 280, "object 1011h:0 (number of parameter groups to restore) is missing or wrong")       \
  X(CO_ERR_CFG_1014_0, 0x119, 281, "object 1014h:0 (COB-ID EMCY) is missing, but there is a CO_NODE_SPEC.EmcyCode")    \
  X(CO_ERR_CFG_1017_0, 0x11A, 282, "object 1017h:0 (producer heartbeat time) is missing or wrong")                     \
  X(CO_ERR_CFG_1016, 0x11B, 283, "object 1016h (consumer heartbeat time) is missing or wrong")                         \
  X(CO_ERR_CFG_1018, 0x11C, 284, "the mandatory object 1018h:1 (vendor-ID) is missing; the node runs")                 \
  X(CO_ERR_TMR_NO_ACT, 0x11D, 285, "no timer is free; CO_NODE_SPEC.TmrNum is the number of timers of the application") \
  X(CO_ERR_TMR_INSERT, 0x11E, 286, "the timer could not be inserted")                                                  \
  X(CO_ERR_TMR_CREATE, 0x11F, 287, "the timer could not be created")                                                   \
  X(CO_ERR_TMR_DELETE, 0x120, 288, "the timer could not be deleted")                                                   \
  X(CO_ERR_NMT_INIT, 0x121, 289, "the NMT state machine could not be initialised")                                     \
  X(CO_ERR_NMT_APP_RESET, 0x122, 290, "NMT reset node failed")                                                         \
  X(CO_ERR_NMT_COM_RESET, 0x123, 291, "NMT reset communication failed")                                                \
  X(CO_ERR_NMT_MODE, 0x124, 292, "not possible in this NMT state")                                                     \
  X(CO_ERR_EMCY_BAD_ROOT, 0x125, 293, "CO_NODE_SPEC.EmcyCode is null: there are no errors of the application")         \
  X(CO_ERR_TPDO_COM_OBJ, 0x126, 294, "a TPDO is off, or its COB-ID or transmission type is not allowed")               \
  X(CO_ERR_TPDO_MAP_OBJ, 0x127, 295,                                                                                   \
    "a TPDO maps no object, more than 64 bits, or an object that is missing, of other length, or without flag R")      \
  X(CO_ERR_TPDO_OBJ_TRIGGER, 0x128, 296, "no TPDO maps the object")                                                    \
  X(CO_ERR_TPDO_NUM_TRIGGER, 0x129, 297, "no TPDO has this number")                                                    \
  X(CO_ERR_TPDO_INHIBIT, 0x12A, 298, "the inhibit time of the TPDO has not elapsed")                                   \
  X(CO_ERR_TPDO_EVENT, 0x12B, 299, "the TPDO is not event-driven")                                                     \
  X(CO_ERR_RPDO_COM_OBJ, 0x12C, 300, "the COB-ID or transmission type of an RPDO is not allowed")                      \
  X(CO_ERR_RPDO_MAP_OBJ, 0x12D, 301,                                                                                   \
    "an RPDO maps no object, more than 64 bits, or an object that is missing, of other length, or without flag W")     \
  X(CO_ERR_SDO_SILENT, 0x12E, 302, "the SDO server does not answer")                                                   \
  X(CO_ERR_SDO_OFF, 0x12F, 303, "the SDO client is off: its COB-IDs are not valid")                                    \
  X(CO_ERR_SDO_BUSY, 0x130, 304, "the SDO client is busy with another transfer")                                       \
  X(CO_ERR_SDO_ABORT, 0x131, 305, "the SDO transfer was aborted")                                                      \
  X(CO_ERR_SDO_READ, 0x132, 306, "an SDO upload failed for a hardware error (SDO abort 0606 0000h)")                   \
  X(CO_ERR_SDO_WRITE, 0x133, 307, "an SDO download failed for a hardware error (SDO abort 0606 0000h)")                \
  X(CO_ERR_SYNC_MSG, 0x134, 308, "the SYNC could not be sent")                                                         \
  X(CO_ERR_SYNC_RES, 0x135, 309, "a TPDO or RPDO could not be registered for the SYNC")                                \
  X(CO_ERR_IF_CAN_INIT, 0x136, 310, "the CAN driver could not be initialised")                                         \
  X(CO_ERR_IF_CAN_ENABLE, 0x137, 311, "the CAN driver could not set the bit rate")                                     \
  X(CO_ERR_IF_CAN_FLUSH_RX, 0x138, 312, "the CAN driver could not discard the received frames")                        \
  X(CO_ERR_IF_CAN_FLUSH_TX, 0x139, 313, "the CAN driver could not discard the frames to be sent")                      \
  X(CO_ERR_IF_CAN_RESET, 0x13A, 314, "the CAN driver could not be reset")                                              \
  X(CO_ERR_IF_CAN_CLOSE, 0x13B, 315, "the CAN driver could not be closed")                                             \
  X(CO_ERR_IF_CAN_READ, 0x13C, 316, "Read of the CAN driver returned an error")                                        \
  X(CO_ERR_IF_CAN_SEND, 0x13D, 317, "Send of the CAN driver returned an error, or the frame could not be queued")      \
  X(CO_ERR_IF_TIMER_INIT, 0x13E, 318, "the timer driver could not be initialised")                                     \
  X(CO_ERR_IF_TIMER_UPDATE, 0x13F, 319, "the timer driver could not be updated")                                       \
  X(CO_ERR_IF_TIMER_RELOAD, 0x140, 320, "the timer driver could not set its time")                                     \
  X(CO_ERR_IF_TIMER_DELAY, 0x141, 321, "the timer driver could not return the time that is left")                      \
  X(CO_ERR_IF_TIMER_STOP, 0x142, 322, "the timer driver could not be stopped")                                         \
  X(CO_ERR_IF_TIMER_START, 0x143, 323, "the timer driver could not be started")                                        \
  X(CO_ERR_IF_NVM_INIT, 0x144, 324, "the non-volatile memory could not be initialised")                                \
  X(CO_ERR_IF_NVM_READ, 0x145, 325, "the non-volatile memory could not be read (SDO abort 0606 0000h)")                \
  X(CO_ERR_IF_NVM_WRITE, 0x146, 326, "the non-volatile memory could not be written (SDO abort 0606 0000h)")            \
  X(CO_ERR_SIG_INIT, 0x147, 327, "the signal could not be initialised")                                                \
  X(CO_ERR_SIG_CREATE, 0x148, 328, "the signal could not be created")                                                  \
  X(CO_ERR_MSG_INIT, 0x149, 329, "the message could not be initialised")                                               \
  X(CO_ERR_MSG_CREATE, 0x14A, 330, "the message could not be created")                                                 \
  X(CO_ERR_MSG_READ, 0x14B, 331, "the message could not be read")                                                      \
  X(CO_ERR_TYPE_INIT, 0x14C, 332, "an object type is not allowed at this index or sub-index, or its data is wrong")    \
  X(CO_ERR_TYPE_RD, 0x14D, 333, "a type function could not return the value (SDO abort 0800 0020h)")                   \
  X(CO_ERR_TYPE_WR, 0x14E, 334, "a type function could not store the value (SDO abort 0800 0020h)")                    \
  X(CO_ERR_TYPE_RESET, 0x14F, 335, "a type function could not reset the object")                                       \
  X(CO_ERR_OBJ_STATE, 0x150, 336, "not possible in the present device state (SDO abort 0800 0022h)")                   \
  X(CO_ERR_OBJ_NO_DATA, 0x151, 337, "no data available (SDO abort 0800 0024h)")                                        \
  X(CO_ERR_LSS_BUSY, 0x152, 338, "the LSS master is busy with another service")                                        \
  X(CO_ERR_LSS_NO_STORE, 0x153, 339, "node-ID and bit rate cannot be stored")                                          \
  X(CO_ERR_TYPE_AGAIN, 0x154, 340, "a Reset function has not reached the position yet; call it again (co_obj.h)")      \
  X(CO_ERR_NODE_EXT, 0x155, 341, "CONodeInitEx(): CO_NODE_EXT.Size is less than sizeof(CO_NODE_EXT)")                  \
  X(CO_ERR_NODE_CAN, 0x156, 342, "CONodeInit(): there is no CAN driver")                                               \
  X(CO_ERR_NODE_TIMER, 0x157, 343, "CONodeInit(): there is no timer driver")                                           \
  X(CO_ERR_NODE_TMR_FREQ, 0x158, 344, "CONodeInit(): CO_NODE_SPEC.TmrFreq is 0")                                       \
  X(CO_ERR_NODE_ID, 0x159, 345, "CONodeInit(): CO_NODE_SPEC.NodeId is not 1...127 (CO_LSS_NO_NODE_ID needs USE_LSS)")  \
  X(CO_ERR_NODE_DICT, 0x15A, 346, "CONodeInit(): CO_NODE_SPEC.Dict is null, or DictLen is 0")                          \
  X(CO_ERR_PARA_OVERLAP, 0x15B, 347, "a parameter group overlaps one with a lower sub-index of 1010h; it is not used") \
  X(CO_ERR_OBJ_RANGE_LOW, 0x15C, 348, "the value is too low (SDO abort 0609 0032h)")                                   \
  X(CO_ERR_NODE_SDO_BUF, 0x15D, 349, "CONodeInit(): CO_NODE_EXT.SdoBufLen is less than CO_SSDO_N * CO_SDO_BUF_BYTE")   \
  X(CO_ERR_NODE_ID_TWICE, 0x15E, 350, "another node on the bus sends the heartbeat of this node-ID")                   \
  X(CO_ERR_DICT_BUSY, 0x15F, 351, "CODictInit() in a callback or type function: call it in the loop")
// clang-format on

/// \cond internal
#define CO_ERR_ENUMERATOR(name, number, decimal, text) name = CO_ERR_BASE - 0x100 + (number),
#define CO_ERR_NUMBERS(name, number, decimal, text) {number, decimal},
#define CO_ERR_NAME_AND_NUL(name, number, decimal, text) #name "\0"
#define CO_ERR_TEXT_AND_NUL(name, number, decimal, text) text "\0"
/// \endcond

/// Error codes, see CO_ERR_LIST.
typedef enum CO_ERR_T {
  CO_ERR_NONE = 0,  ///< success
  CO_ERR_LIST(CO_ERR_ENUMERATOR)
} CO_ERR;

struct CO_NODE_T;

/// \name The last error of a node
/// Context: the loop.
/// \{

/// Returns the last error and clears it. COErrName() and COErrText() return its name and its meaning,
/// CONodeGetErrKey() the object that it is about.
/// \retval CO_ERR_NONE     no error since the last call
/// \retval CO_ERR_BAD_ARG  \a node is null
CO_ERR CONodeGetErr(struct CO_NODE_T* node);

/// Returns the key of the object that the last error is about: the error that CONodeGetErr() returned last or, if there
/// is a newer one, will return. It may be called before CONodeGetErr() or after it. CO_GET_IDX() and CO_GET_SUB()
/// return index and sub-index; the flags are 0. The object is
/// - CO_ERR_DICT_INIT: the entry that CODictGetFault() names;
/// - CO_ERR_OBJ_INIT: the first entry whose Init function failed;
/// - CO_ERR_RPDO_COM_OBJ, CO_ERR_TPDO_COM_OBJ: sub-index 1 (COB-ID) or 2 (transmission type) of 1400h… or 1800h…;
/// - CO_ERR_RPDO_MAP_OBJ, CO_ERR_TPDO_MAP_OBJ: the entry of 1600h… or 1A00h… that is wrong, or the first one behind 64
///   bits; sub-index 0: there are no entries, too many, or the PDO cannot be a multiplex PDO;
/// - CO_ERR_PARA_… and an error of a group that is stored autonomously: the sub-index of 1010h;
/// - CO_ERR_CFG_…, CO_ERR_OBJ_RANGE_LOW: the object that is missing or has a wrong value;
/// - CO_ERR_SDO_READ, CO_ERR_SDO_WRITE: the object of the transfer;
/// - an error of a type function that a PDO, 1001h or 1003h has called: the object;
/// - COTPdoTrigObj(), OD_requestTPDO(): the object; COTPdoTrigPdo(): the TPDO, sub-index 0 of 1800h….
/// \retval 0  the error is about no object, CONodeGetErr() returned CO_ERR_NONE, or \a node is null
uint32_t CONodeGetErrKey(const struct CO_NODE_T* node);

/// Bytes that the longest text of CONodeGetErrText() needs, with its NUL.
#define CO_NODE_ERR_TEXT 400

/// Like CONodeGetErr(), and writes name, object and meaning of the error to \a text, with the fault of the dictionary
/// if there is one: "CO_ERR_TPDO_MAP_OBJ, object 1A00h:02: …". For CO_ERR_NONE the text is "no error", and what is
/// missing: CONodeStart(), a bit rate, COTmrService() or COTmrProcess() for a timer that has elapsed, 1017h. Text
/// beyond \a size bytes is cut off; it always ends with a NUL. Names and meanings take about 8 KB of flash, only in a
/// program that calls this function, COErrName(), COErrText() or those of co_dict.h. With USE_DICT_CHECK 0 each call
/// returns CO_ERR_DICT_INIT while entries are in the wrong order, also if the node runs.
///
/// \retval CO_ERR_NONE       no error since the last call
/// \retval CO_ERR_DICT_INIT  the dictionary is refused, or its entries are in the wrong order
/// \retval CO_ERR_BAD_ARG    an argument is null, or \a size is 0
CO_ERR CONodeGetErrText(struct CO_NODE_T* node, char* text, uint32_t size);
/// \}

/// Returns the name of an error code, for messages: "CO_ERR_TPDO_MAP_OBJ"; "unknown error" for other numbers. Never
/// null. The names (about 2 KB) are linked only into a program that calls this function; likewise the texts of
/// COErrText().
const char* COErrName(CO_ERR err);

/// Returns the meaning of an error code as in CO_ERR_LIST: one line without a full stop; "unknown error" for other
/// numbers. Never null. About 5 KB, see COErrName().
const char* COErrText(CO_ERR err);

#ifdef __cplusplus
}
#endif

#endif
