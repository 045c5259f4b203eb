// SPDX-License-Identifier: Apache-2.0
/// \file co_obj.h
/// An entry of the object dictionary, its type (the table of functions that implements it), and the functions that
/// access one entry. [CiA 301, 7.4]
///
/// Context: every function of this file is called from the context that also calls CONodeProcess() and COTmrProcess()
/// (the loop, or one task). None may be called from an interrupt.
#ifndef CO_OBJ_H_
#define CO_OBJ_H_

#include "co_err.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#if defined(__cplusplus) && !defined(CO_DATA_INTEGER)
#include "lexican/detail/data.hpp"
#endif

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;
struct CO_OBJ_T;

/// \name Keys: index in bits 31…16, sub-index in bits 15…8, flags in bits 7…0.
/// All of these are constant expressions.
/// \{

/// Key of a dictionary entry with its flags.
#define CO_KEY(idx, sub, flags)                                                            \
  ((uint32_t)(((((uint32_t)(idx)) & 0xFFFFu) << 16) | ((((uint32_t)(sub)) & 0xFFu) << 8) | \
              (((uint32_t)(flags)) & 0xFFu)))
/// Key for the lookup of an entry: index and sub-index, no flags.
#define CO_DEV(idx, sub) CO_KEY(idx, sub, 0)
/// PDO mapping value: index, sub-index and length in bits. [CiA 301, 7.5.2.36]
#define CO_LINK(idx, sub, bits) CO_KEY(idx, sub, bits)

#define CO_GET_DEV(key) ((uint32_t)((key)&0xFFFFFF00u))                ///< a key without its flags
#define CO_GET_IDX(key) ((uint16_t)(((uint32_t)(key)) >> 16))          ///< index of a key
#define CO_GET_SUB(key) ((uint8_t)((((uint32_t)(key)) >> 8) & 0xFFu))  ///< sub-index of a key
/// \}

/// \name Flags of an entry
/// The letters of the names are D N A P R W in this order; an underscore means that the flag is not set. Read and write
/// rights apply to the network only, not to the application.
/// \{
#define CO_OBJ_______ 0x00u  ///< no access right for the network
#define CO_OBJ______W 0x01u  ///< W: the network may write, and the object may be mapped into an RPDO
#define CO_OBJ_____R_ 0x02u  ///< R: the network may read, and the object may be mapped into a TPDO
#define CO_OBJ____P__ 0x04u  ///< P: the object may be mapped into a PDO
#define CO_OBJ___A___ 0x08u  ///< A: a change of the value triggers the TPDOs that map it
#define CO_OBJ__N____ 0x40u  ///< N: relative to the node-ID (basic integers): added on read, subtracted on write
#define CO_OBJ_D_____ 0x80u  ///< D: Data holds the value itself; a table with writable values must be in RAM

#define CO_OBJ_T0 0x08u  ///< free for user types (shares the bit of A)
#define CO_OBJ_T1 0x10u  ///< free for user types
#define CO_OBJ_T2 0x20u  ///< free for user types
#define CO_OBJ_T3 0x40u  ///< free for user types (shares the bit of N)

#define CO_OBJ_____RW (CO_OBJ_____R_ | CO_OBJ______W)  ///< read and write
#define CO_OBJ____PR_ (CO_OBJ____P__ | CO_OBJ_____R_)  ///< read, mappable into TPDOs
#define CO_OBJ____P_W (CO_OBJ____P__ | CO_OBJ______W)  ///< write, mappable into RPDOs
#define CO_OBJ____PRW (CO_OBJ____P__ | CO_OBJ_____RW)  ///< read and write, mappable
#define CO_OBJ___APR_ (CO_OBJ___A___ | CO_OBJ____PR_)  ///< read, mappable into TPDOs, which a change triggers
#define CO_OBJ___AP_W (CO_OBJ___A___ | CO_OBJ____P_W)  ///< write, mappable into RPDOs, with flag A
#define CO_OBJ___APRW (CO_OBJ___A___ | CO_OBJ____PRW)  ///< read and write, mappable, a change triggers TPDOs
#define CO_OBJ__N__R_ (CO_OBJ__N____ | CO_OBJ_____R_)  ///< read, relative to the node-ID
#define CO_OBJ__N___W (CO_OBJ__N____ | CO_OBJ______W)  ///< write, relative to the node-ID
#define CO_OBJ__N__RW (CO_OBJ__N____ | CO_OBJ_____RW)  ///< read and write, relative to the node-ID
#define CO_OBJ__N_PR_ (CO_OBJ__N____ | CO_OBJ____PR_)  ///< read, mappable into TPDOs, relative to the node-ID
#define CO_OBJ__N_P_W (CO_OBJ__N____ | CO_OBJ____P_W)  ///< write, mappable into RPDOs, relative to the node-ID
#define CO_OBJ__N_PRW (CO_OBJ__N____ | CO_OBJ____PRW)  ///< read and write, mappable, relative to the node-ID
#define CO_OBJ_D___R_ (CO_OBJ_D_____ | CO_OBJ_____R_)  ///< read, value in Data
#define CO_OBJ_D____W (CO_OBJ_D_____ | CO_OBJ______W)  ///< write, value in Data
#define CO_OBJ_D___RW (CO_OBJ_D_____ | CO_OBJ_____RW)  ///< read and write, value in Data
#define CO_OBJ_DN__R_ (CO_OBJ_D_____ | CO_OBJ__N__R_)  ///< read, value in Data, relative to the node-ID
#define CO_OBJ_DN___W (CO_OBJ_D_____ | CO_OBJ__N___W)  ///< write, value in Data, relative to the node-ID
#define CO_OBJ_DN__RW (CO_OBJ_D_____ | CO_OBJ__N__RW)  ///< read and write, value in Data, relative to the node-ID

/// Tests of flags: the result is not 0 if the flag is set (it need not be 1).
#define CO_IS_WRITE(key) ((uint32_t)((key)&CO_OBJ______W))
#define CO_IS_READ(key) ((uint32_t)((key)&CO_OBJ_____R_))    ///< flag R
#define CO_IS_PDOMAP(key) ((uint32_t)((key)&CO_OBJ____P__))  ///< flag P
#define CO_IS_ASYNC(key) ((uint32_t)((key)&CO_OBJ___A___))   ///< flag A
#define CO_IS_NODEID(key) ((uint32_t)((key)&CO_OBJ__N____))  ///< flag N
#define CO_IS_DIRECT(key) ((uint32_t)((key)&CO_OBJ_D_____))  ///< flag D
/// \}

/// End mark of a dictionary table. Not needed if the table has exactly DictLen entries. CO_OBJ_DICT_DEFAULTS()
/// (co_dict.h) is an end mark that also resets variables to their default values at power-on and by NMT resets.
#define CO_OBJ_DICT_ENDMARK \
  { 0, (CO_OBJ_TYPE*)0, 0 }

/// \name Functions of an object type
/// A null Init or Reset means success without any action; a null Read or Write means that the access is refused; a null
/// Size means that every SDO transfer of the object is refused.
///
/// A type *with* a Reset function is a stream of bytes: Reset(0) starts an access, and reads and writes continue from
/// there in pieces of at most 7 bytes in a segmented and CO_SDO_BUF_BYTE bytes in a block transfer. A Read or Write of
/// length 0 follows Reset and opens the access. A stream is written as the data arrive: an aborted transfer leaves the
/// bytes that were already written. Streams are bytes in the order of the bus.
///
/// A type *without* a Reset function is a value. Up to 8 bytes are read and written as a whole, and written when all
/// bytes have arrived; values of 2 to 8 bytes are numbers in the byte order of the CPU. A longer value is read and
/// written in pieces like a stream; the call with length 0 marks the start of an access. A block upload may have to
/// repeat segments, which requires a Reset function: a value of more than CO_SDO_BUF_BYTE bytes is refused (0504
/// 0001h), and clients read it by a segmented upload.
/// \{

/// Returns the length of the object in bytes; 0: error, or an empty stream. \a width: the length of the access, 0 if
/// unknown. A type with variable length returns \a width if that length is possible, otherwise the nearest possible
/// length.
typedef uint32_t (*CO_OBJ_SIZE_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t width);
/// Initialises the object. Called once for each entry in CONodeInit() and in every NMT reset.
typedef CO_ERR (*CO_OBJ_INIT_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node);
/// Reads \a size bytes into \a buffer (any alignment).
typedef CO_ERR (*CO_OBJ_READ_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size);
/// Writes \a size bytes from \a buffer (any alignment).
typedef CO_ERR (*CO_OBJ_WRITE_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size);
/// Sets the position in the stream to byte \a para.
typedef CO_ERR (*CO_OBJ_RESET_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t para);

/// An object type: its functions, each of which may be null. Constant; it must live as long as the dictionary.
typedef struct CO_OBJ_TYPE_T {
  CO_OBJ_SIZE_FUNC Size;    ///< returns the length
  CO_OBJ_INIT_FUNC Init;    ///< initialises the object
  CO_OBJ_READ_FUNC Read;    ///< reads the value, or the next bytes of a stream
  CO_OBJ_WRITE_FUNC Write;  ///< writes the value, or the next bytes of a stream
  CO_OBJ_RESET_FUNC Reset;  ///< sets the position; not null: the type is a stream
} CO_OBJ_TYPE;
/// \}

/// \name Types with transfer functions (USE_OBJ_EX, co_cfg.h)
/// A CO_OBJ_TYPE_EX is a stream type with functions that are called at the begin and at the end of each transfer, for
/// example for a file, a firmware image or a queue of records. Dictionary entries refer to its first member, whose
/// Reset function is COObjTypeExReset().
///
///     const CO_OBJ_TYPE_EX Image = {{size, 0, read, write, COObjTypeExReset}, seek, begin, end};
///     ... {CO_KEY(0x1F50, 1, CO_OBJ______W), &Image.Type, (CO_DATA)(&image)} ...
///
/// An SDO transfer calls Begin, Reset(0), Read or Write of length 0, Read or Write for each piece, and End: exactly
/// once for each Begin that succeeded. A piece has at most 7 bytes in a segmented and CO_SDO_BUF_BYTE bytes in a block
/// transfer. A block download of up to CO_SDO_BUF_BYTE bytes is written in one piece, after its CRC and length were
/// checked. A longer one is written in pieces before that check, so End may have to undo it. After a lost frame of a
/// block upload, Reset may be called with any position that was already read. If setting the position takes longer than
/// one call of CONodeProcess() may last, Reset returns CO_ERR_TYPE_AGAIN and is called again in the next one. CODict…
/// and COObj… functions of the application call neither Begin nor End; neither is End called for an entry that
/// CODictInit() has moved.
/// \{

/// Result of Size for width 0 while the length of an upload is not known. Once a Read has reached the end (it has
/// filled less than its buffer), Size must return the length of the object; it may do so earlier.
#define CO_OBJ_SIZE_UNKNOWN 0xFFFFFFFFu

/// Direction of an SDO transfer.
typedef enum CO_OBJ_TRANSFER_T {
  CO_OBJ_UPLOAD = 0,  ///< the object is read
  CO_OBJ_DOWNLOAD     ///< the object is written
} CO_OBJ_TRANSFER;

/// Called at the begin of a transfer. \a size: bytes of the transfer, or CO_OBJ_SIZE_UNKNOWN. An error refuses the
/// transfer; COObjTypeUserSDOAbort() sets the abort code.
typedef CO_ERR (*CO_OBJ_BEGIN_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, CO_OBJ_TRANSFER transfer,
                                    uint32_t size);
/// Called at the end of a transfer. \a abort 0: all bytes were transferred; an error returned for a download is
/// converted to the abort code of its last response. Otherwise \a abort is the abort code of the client or the server
/// (CO_SDO_ERR_TOS_STATE: ended by the NMT state or by a new request of the client), and the result is ignored.
typedef CO_ERR (*CO_OBJ_END_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, CO_OBJ_TRANSFER transfer,
                                  uint32_t abort);

/// An object type with functions for the begin and the end of a transfer.
typedef struct CO_OBJ_TYPE_EX_T {
  CO_OBJ_TYPE Type;         ///< Type.Reset: COObjTypeExReset
  CO_OBJ_RESET_FUNC Reset;  ///< sets the position; null: block uploads of long objects are refused
  CO_OBJ_BEGIN_FUNC Begin;  ///< may be null
  CO_OBJ_END_FUNC End;      ///< may be null
} CO_OBJ_TYPE_EX;

/// Calls the Reset function of the CO_OBJ_TYPE_EX whose first member is \a obj->Type. The stack recognises a
/// CO_OBJ_TYPE_EX by this function. Returns the result of that function, or:
/// \retval CO_ERR_NONE     also if the type has no such function
/// \retval CO_ERR_BAD_ARG  an argument is null
CO_ERR COObjTypeExReset(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t para) CO_NEEDS(USE_OBJ_EX);
/// \}

#if !defined(__cplusplus) || defined(CO_DATA_INTEGER)
/// Address of the object's data, or the value itself (flag D). In C++ it is a class of the same size and layout
/// (lexican/detail/data.hpp) that converts to and from addresses and integers, so that tables can be checked at compile
/// time. With CO_DATA_INTEGER defined it is the plain integer in C++, too, without that check.
typedef uintptr_t CO_DATA;
#endif

/// An entry of the object dictionary. Tables are sorted by ascending index and sub-index.
typedef struct CO_OBJ_T {
  uint32_t Key;                      ///< CO_KEY(index, sub-index, flags)
  const struct CO_OBJ_TYPE_T* Type;  ///< type: one of the CO_T… macros or a type of the application
  CO_DATA Data;                      ///< (CO_DATA)(&variable), or (CO_DATA)(value) with flag D
} CO_OBJ;

/// Returns the length of the object in bytes (see CO_OBJ_SIZE_FUNC). \a width: expected length, 0 if unknown.
/// \retval 0  an argument is null, or the type has no Size function
uint32_t COObjGetSize(CO_OBJ* obj, struct CO_NODE_T* node, uint32_t width);

/// Calls the type's Init function and returns its result.
/// \retval CO_ERR_NONE     success, or the type has no Init function
/// \retval CO_ERR_BAD_ARG  an argument is null
CO_ERR COObjInit(CO_OBJ* obj, struct CO_NODE_T* node);

/// Calls the type's Reset function with \a para and returns its result.
/// \retval CO_ERR_NONE     success, or the type has no Reset function
/// \retval CO_ERR_BAD_ARG  an argument is null
CO_ERR COObjReset(CO_OBJ* obj, struct CO_NODE_T* node, uint32_t para);

/// Reads a value of \a width bytes into \a value. Access rights of the network are not checked. Returns the result of
/// the type's Read function, or:
/// \retval CO_ERR_BAD_ARG  an argument is null, or the object has another length
/// \retval CO_ERR_OBJ_ACC  the type has no Read function
CO_ERR COObjRdValue(CO_OBJ* obj, struct CO_NODE_T* node, void* value, uint8_t width);

/// Writes a value of \a width bytes from \a value. Access rights of the network are not checked. Returns the result of
/// the type's Write function, or:
/// \retval CO_ERR_BAD_ARG  an argument is null, the node was never initialised, or the object has another length
/// \retval CO_ERR_OBJ_ACC  the type has no Write function
CO_ERR COObjWrValue(CO_OBJ* obj, struct CO_NODE_T* node, void* value, uint8_t width);

/// Reads a stream from its beginning: calls Reset(0), then reads \a size bytes into \a buffer. Returns the result of
/// the type's functions, or:
/// \retval CO_ERR_BAD_ARG  an argument is null, or a value has another length
/// \retval CO_ERR_OBJ_ACC  the type has no Read function
CO_ERR COObjRdBufStart(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Reads the next \a size bytes of a stream. Returns the result of the type's Read function, or:
/// \retval CO_ERR_BAD_ARG  an argument is null, or a value has another length
/// \retval CO_ERR_OBJ_ACC  the type has no Read function
CO_ERR COObjRdBufCont(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Writes a stream from its beginning: calls Reset(0), then writes \a size bytes from \a buffer. Returns the result of
/// the type's functions, or:
/// \retval CO_ERR_BAD_ARG  an argument is null, the node was never initialised, or a value has another length
/// \retval CO_ERR_OBJ_ACC  the type has no Write function
CO_ERR COObjWrBufStart(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Writes the next \a size bytes of a stream. Returns the result of the type's Write function, or:
/// \retval CO_ERR_BAD_ARG  an argument is null, the node was never initialised, or a value has another length
/// \retval CO_ERR_OBJ_ACC  the type has no Write function
CO_ERR COObjWrBufCont(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Sets the abort code \a abort for the SDO transfer of \a obj that is being processed; 0 clears it. To be called by a
/// type function, which then has to return an error. Applies to every kind of transfer; without a transfer of \a obj it
/// has no effect. [CiA 301, 7.2.4.3.17]
void COObjTypeUserSDOAbort(CO_OBJ* obj, struct CO_NODE_T* node, uint32_t abort);

#ifdef __cplusplus
}
#endif

#endif
