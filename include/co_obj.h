// SPDX-License-Identifier: Apache-2.0
/// \file co_obj.h
/// An entry of the object dictionary, the table of functions that gives it its behaviour, and the functions that
/// reach one entry. [301:7.4]
///
/// Context: every function of this file belongs to the one context that also calls CONodeProcess() and
/// COTmrProcess() (the loop, or one task). None may be called from an interrupt.
#ifndef CO_OBJ_H_
#define CO_OBJ_H_

#include "co_err.h"
#include "co_needs.h"
#include "co_types.h"

#if defined(__cplusplus) && !defined(CO_DATA_INTEGER)
#include "co/data.hpp"
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
/// Key to look an entry up: index and sub-index, no flags.
#define CO_DEV(idx, sub) CO_KEY(idx, sub, 0)
/// PDO mapping value: index, sub-index and length in bits. [301:7.5.2.36]
#define CO_LINK(idx, sub, bits) CO_KEY(idx, sub, bits)

#define CO_GET_DEV(key) ((uint32_t)((key)&0xFFFFFF00u))                ///< a key without its flags
#define CO_GET_IDX(key) ((uint16_t)(((uint32_t)(key)) >> 16))          ///< index of a key
#define CO_GET_SUB(key) ((uint8_t)((((uint32_t)(key)) >> 8) & 0xFFu))  ///< sub-index of a key
/// \}

/// \name Flags of an entry
/// The positions of the names read D N A P R W, an underscore is "off". Read and write rights concern the network
/// only; the application is never limited by them.
/// \{
#define CO_OBJ_______ 0x00u  ///< no right at all for the network
#define CO_OBJ______W 0x01u  ///< W: the network may write, and the object may be mapped into an RPDO
#define CO_OBJ_____R_ 0x02u  ///< R: the network may read, and the object may be mapped into a TPDO
#define CO_OBJ____P__ 0x04u  ///< P: may be mapped into a PDO
#define CO_OBJ___A___ 0x08u  ///< A: a change of the value triggers the TPDOs that map it
#define CO_OBJ__N____ 0x40u  ///< N: relative to the node-ID (basic integers): added on read, taken off on write
#define CO_OBJ_D_____ 0x80u  ///< D: the value itself lies in Data; the table must be in RAM if it is written

#define CO_OBJ_T0 0x08u  ///< free for user types (shares the bit of A)
#define CO_OBJ_T1 0x10u  ///< free for user types
#define CO_OBJ_T2 0x20u  ///< free for user types
#define CO_OBJ_T3 0x40u  ///< free for user types (shares the bit of N)

#define CO_OBJ_____RW (CO_OBJ_____R_ | CO_OBJ______W)
#define CO_OBJ____PR_ (CO_OBJ____P__ | CO_OBJ_____R_)
#define CO_OBJ____P_W (CO_OBJ____P__ | CO_OBJ______W)
#define CO_OBJ____PRW (CO_OBJ____P__ | CO_OBJ_____RW)
#define CO_OBJ___APR_ (CO_OBJ___A___ | CO_OBJ____PR_)
#define CO_OBJ___AP_W (CO_OBJ___A___ | CO_OBJ____P_W)
#define CO_OBJ___APRW (CO_OBJ___A___ | CO_OBJ____PRW)
#define CO_OBJ__N__R_ (CO_OBJ__N____ | CO_OBJ_____R_)
#define CO_OBJ__N___W (CO_OBJ__N____ | CO_OBJ______W)
#define CO_OBJ__N__RW (CO_OBJ__N____ | CO_OBJ_____RW)
#define CO_OBJ__N_PR_ (CO_OBJ__N____ | CO_OBJ____PR_)
#define CO_OBJ__N_P_W (CO_OBJ__N____ | CO_OBJ____P_W)
#define CO_OBJ__N_PRW (CO_OBJ__N____ | CO_OBJ____PRW)
#define CO_OBJ_D___R_ (CO_OBJ_D_____ | CO_OBJ_____R_)
#define CO_OBJ_D____W (CO_OBJ_D_____ | CO_OBJ______W)
#define CO_OBJ_D___RW (CO_OBJ_D_____ | CO_OBJ_____RW)
#define CO_OBJ_DN__R_ (CO_OBJ_D_____ | CO_OBJ__N__R_)
#define CO_OBJ_DN___W (CO_OBJ_D_____ | CO_OBJ__N___W)
#define CO_OBJ_DN__RW (CO_OBJ_D_____ | CO_OBJ__N__RW)

/// Flag tests: not zero if set (not 0 or 1).
#define CO_IS_WRITE(key) ((uint32_t)((key)&CO_OBJ______W))
#define CO_IS_READ(key) ((uint32_t)((key)&CO_OBJ_____R_))
#define CO_IS_PDOMAP(key) ((uint32_t)((key)&CO_OBJ____P__))
#define CO_IS_ASYNC(key) ((uint32_t)((key)&CO_OBJ___A___))
#define CO_IS_NODEID(key) ((uint32_t)((key)&CO_OBJ__N____))
#define CO_IS_DIRECT(key) ((uint32_t)((key)&CO_OBJ_D_____))
/// \}

/// Ends a dictionary table. Tables that are as long as DictLen says need none. CO_OBJ_DICT_DEFAULTS() (co_dict.h) ends
/// a table whose variables get their default values at power-on and by NMT resets.
#define CO_OBJ_DICT_ENDMARK \
  { 0, (CO_OBJ_TYPE*)0, 0 }

/// \name Functions of an object type
/// A null Init or Reset means "nothing to do, success"; a null Read or Write means that the access is refused; a null
/// Size means that every SDO transfer of the object is refused.
///
/// A type *with* a Reset function is a stream of bytes: Reset(0) starts an access, reads and writes go on from there,
/// in pieces of at most 7 bytes in a segmented and CO_SDO_BUF_BYTE bytes in a block transfer; a Read or Write of length
/// 0 follows Reset and opens the access. A type *without* one is a value: up to 8 bytes are always read and written as
/// a whole; a longer one is read and written in pieces like a stream, and knows the start of an access by the call with
/// length 0. A value of up to 8 bytes is written when all of it has arrived. A stream is written as it arrives: a
/// transfer that is aborted leaves what it has written. Values of 2 to 8 bytes are numbers in the byte order of the
/// CPU; streams are bytes in the order of the bus. A block upload may have to go back, which only a Reset function can:
/// a value of more than CO_SDO_BUF_BYTE bytes is refused (0504 0001h), and clients read it in segments.
/// \{

/// Length of the object in bytes. \a width is the length that the access has in mind, 0 if unknown: a type whose
/// length varies answers \a width if that length is possible, else the nearest that is. 0 means error, or an empty
/// stream.
typedef uint32_t (*CO_OBJ_SIZE_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t width);
/// Called once for each entry in CONodeInit() and in every NMT reset.
typedef CO_ERR (*CO_OBJ_INIT_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node);
/// Fills \a buffer (any alignment) with \a size bytes.
typedef CO_ERR (*CO_OBJ_READ_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size);
/// Takes \a size bytes from \a buffer (any alignment).
typedef CO_ERR (*CO_OBJ_WRITE_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size);
/// Sets the position in the stream to \a para.
typedef CO_ERR (*CO_OBJ_RESET_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t para);

typedef struct CO_OBJ_TYPE_T {
  CO_OBJ_SIZE_FUNC Size;
  CO_OBJ_INIT_FUNC Init;
  CO_OBJ_READ_FUNC Read;
  CO_OBJ_WRITE_FUNC Write;
  CO_OBJ_RESET_FUNC Reset;
} CO_OBJ_TYPE;
/// \}

/// \name Types that take part in the whole transfer (USE_OBJ_EX, co_cfg.h)
/// A stream type that needs to know when a transfer begins and how it ends (a file, a firmware image, a queue of
/// records): a CO_OBJ_TYPE_EX, whose first member is the table that entries name and whose Type.Reset is
/// COObjTypeExReset().
///
///     const CO_OBJ_TYPE_EX Image = {{size, 0, read, write, COObjTypeExReset}, seek, begin, end};
///     ... {CO_KEY(0x1F50, 1, CO_OBJ______W), &Image.Type, (CO_DATA)(&image)} ...
///
/// An SDO transfer then calls Begin, Reset(0) and Read or Write of length 0, Read or Write for each piece, and End:
/// exactly once for each Begin that succeeded. A piece has at most 7 bytes in a segmented and CO_SDO_BUF_BYTE bytes in
/// a block transfer; a block download of up to CO_SDO_BUF_BYTE bytes is written after its CRC and length were found
/// right, in one piece. A longer one streams: what was written may still be taken back by End. After a lost frame of a
/// block upload Reset may go back to any position that was already read; while it needs more time for it than a call of
/// CONodeProcess() may take, it answers CO_ERR_TYPE_AGAIN and is called again in the next one. CODict… and COObj…
/// functions of the application call neither Begin nor End, and an entry that CODictInit() has moved is told no End.
/// \{

/// What Size answers to width 0 while the length of an upload is not known. As soon as a Read has reached the end, and
/// has therefore filled less than its buffer or nothing, Size must answer the length of the object; it may do so
/// earlier.
#define CO_OBJ_SIZE_UNKNOWN 0xFFFFFFFFu

typedef enum CO_OBJ_TRANSFER_T {
  CO_OBJ_UPLOAD = 0,  ///< the object is read
  CO_OBJ_DOWNLOAD     ///< the object is written
} CO_OBJ_TRANSFER;

/// \a size: bytes that the transfer will have, or CO_OBJ_SIZE_UNKNOWN. An error refuses the transfer;
/// COObjTypeUserSDOAbort() names the abort code.
typedef CO_ERR (*CO_OBJ_BEGIN_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, CO_OBJ_TRANSFER transfer,
                                    uint32_t size);
/// \a abort 0: all bytes have been transferred; an error returned for a download becomes the abort code of its last
/// answer. Else the transfer was ended by this abort code, of whichever side (CO_SDO_ERR_TOS_STATE: by the NMT state or
/// by a new request of the client), and the result does not matter.
typedef CO_ERR (*CO_OBJ_END_FUNC)(struct CO_OBJ_T* obj, struct CO_NODE_T* node, CO_OBJ_TRANSFER transfer,
                                  uint32_t abort);

typedef struct CO_OBJ_TYPE_EX_T {
  CO_OBJ_TYPE Type;         ///< Type.Reset: COObjTypeExReset
  CO_OBJ_RESET_FUNC Reset;  ///< sets the position; null: long objects are not given to block uploads
  CO_OBJ_BEGIN_FUNC Begin;  ///< may be null
  CO_OBJ_END_FUNC End;      ///< may be null
} CO_OBJ_TYPE_EX;

/// Marks a CO_OBJ_TYPE as the first member of a CO_OBJ_TYPE_EX, and calls that one's Reset function.
CO_ERR COObjTypeExReset(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t para) CO_NEEDS(USE_OBJ_EX);
/// \}

#if !defined(__cplusplus) || defined(CO_DATA_INTEGER)
/// Address of the object's data, or the value itself (flag D). In C++ it is a class of the same size and layout
/// (co/data.hpp) that converts to and from addresses and integers, so that tables can be checked at compile time;
/// define CO_DATA_INTEGER to get the plain integer there, too (and lose that check).
typedef uintptr_t CO_DATA;
#endif

/// An entry of the object dictionary. Tables are sorted by ascending index and sub-index.
typedef struct CO_OBJ_T {
  uint32_t Key;                      ///< CO_KEY(index, sub-index, flags)
  const struct CO_OBJ_TYPE_T* Type;  ///< behaviour, one of the CO_T… macros or the application's own
  CO_DATA Data;                      ///< (CO_DATA)(&variable), or (CO_DATA)(value) with flag D
} CO_OBJ;

/// Length of the object in bytes (see CO_OBJ_SIZE_FUNC). \a width: expected length, 0 if unknown.
/// Returns 0 if an argument is null or the type has no Size function.
uint32_t COObjGetSize(CO_OBJ* obj, struct CO_NODE_T* node, uint32_t width);

/// Runs the type's Init function. CO_ERR_BAD_ARG: an argument is null; CO_ERR_NONE: done, or the type has none.
CO_ERR COObjInit(CO_OBJ* obj, struct CO_NODE_T* node);

/// Runs the type's Reset function with \a para. CO_ERR_BAD_ARG: an argument is null; CO_ERR_NONE: done, or the type
/// has none.
CO_ERR COObjReset(CO_OBJ* obj, struct CO_NODE_T* node, uint32_t para);

/// Reads a value of \a width bytes into \a value, without the network's access rights.
/// CO_ERR_BAD_ARG: an argument is null, or the width is not the object's; CO_ERR_OBJ_ACC: the type cannot be read;
/// else what the type's Read function returns.
CO_ERR COObjRdValue(CO_OBJ* obj, struct CO_NODE_T* node, void* value, uint8_t width);

/// Writes a value of \a width bytes from \a value, without the network's access rights.
/// Errors as COObjRdValue(); CO_ERR_OBJ_ACC: the type cannot be written.
CO_ERR COObjWrValue(CO_OBJ* obj, struct CO_NODE_T* node, void* value, uint8_t width);

/// Starts to read a stream from its beginning: Reset(0), then \a size bytes into \a buffer. Errors as COObjRdValue(),
/// and what the type's Reset function returns.
CO_ERR COObjRdBufStart(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Reads the next \a size bytes of a stream. Errors as COObjRdValue().
CO_ERR COObjRdBufCont(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Starts to write a stream from its beginning: Reset(0), then \a size bytes from \a buffer. Errors as COObjWrValue(),
/// and what the type's Reset function returns.
CO_ERR COObjWrBufStart(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// Writes the next \a size bytes of a stream. Errors as COObjWrValue().
CO_ERR COObjWrBufCont(CO_OBJ* obj, struct CO_NODE_T* node, uint8_t* buffer, uint32_t size);

/// For type functions: answers the SDO transfer that is just being served with the abort code \a abort, if the type
/// function then returns an error. Works in every kind of transfer; without a transfer of \a obj it has no effect.
/// \a abort 0 takes it back. [301:7.2.4.3.17]
void COObjTypeUserSDOAbort(CO_OBJ* obj, struct CO_NODE_T* node, uint32_t abort);

#ifdef __cplusplus
}
#endif

#endif
