// SPDX-License-Identifier: Apache-2.0
/// \file co_od.h
/// OD access interface in the style of CANopenNode (USE_OD, co_cfg.h): reads and writes variables of any length in
/// pieces, replaces the functions of an object by functions of the application (extensions), and reports which objects
/// were received or sent by PDO. docs/od-access.md explains its use with examples. Names, signatures and results are
/// those of the interface of CANopenNode.
///
/// The dictionary remains the sorted table of CO_OBJ. OD_find() searches an array of OD_entry_t in the memory of the
/// application, with one entry for each index; OD_init() fills it from the table:
///
///     static OD_entry_t List[OD_LIST_N(40)];
///     static OD_t Od;
///     OD_init(&Od, List, OD_LIST_N(40), &Node, Table, TableLen);   // before CONodeInitEx()
///     static const CO_NODE_EXT Ext = { .Size = sizeof(Ext), .Od = &Od };
///     CONodeInitEx(&Node, &Spec, &Ext);
///
/// An object can be extended if its entries in the table have extensible types:
///
///     { CO_KEY(0x2100, 1, CO_OBJ____PRW), OD_TUNSIGNED32, (CO_DATA)(&Speed) },
///
/// To make all entries of a table extensible, `#define OD_ALL` before this file is included there. Entries that are not
/// extensible cost nothing.
///
/// Context: the loop, like all of the stack (co_core.h). Where several threads use the node (CO_NODE_EXT.Enter): any of
/// them, between CO_LOCK_OD() and CO_UNLOCK_OD(). The functions that read and write values need an initialised node,
/// unless the stream is plain memory; the others do not.
#ifndef CO_OD_H_
#define CO_OD_H_

#include "co_cfg.h"
#include "co_domain.h"
#include "co_number.h"
#include "co_obj.h"
#include "co_para.h"
#include "co_string.h"
#include "co_time_of_day.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CO_NODE_T;

/// \name Numbers
/// An application that already has these types defines CO_OD_OWN_TYPES, and then provides all of them.
/// \{
#ifndef CO_OD_OWN_TYPES
typedef uint32_t OD_size_t;  ///< bytes: a length, or a position in a variable
typedef uint8_t OD_attr_t;   ///< bits ODA_…
typedef bool bool_t;         ///< false or true
typedef float float32_t;     ///< REAL32
typedef double float64_t;    ///< REAL64
#endif
/// \}

/// Bytes of flags in an extension, 0…32. n bytes hold the flags of sub-indexes 0…8n-1.
#ifndef OD_FLAGS_PDO_SIZE
#define OD_FLAGS_PDO_SIZE 4
#endif
#if OD_FLAGS_PDO_SIZE < 0 || OD_FLAGS_PDO_SIZE > 32
#error "OD_FLAGS_PDO_SIZE: 0...32 bytes"
#endif

/// Qualifier for definitions of constant objects.
#ifndef CO_PROGMEM
#define CO_PROGMEM const
#endif

/// \name Attributes of a variable
/// Derived from the flags of the entry and from its type. They apply to the network only: no function of this file
/// checks them, except OD_mappable(). The attributes of safety-relevant data objects (SRDO) need CO_SRDO_N above 0: an
/// entry that a PDO can map can also be mapped into an SRDO of the same direction.
/// \{

/// Bits of OD_attr_t.
typedef enum OD_attributes_T {
  ODA_SDO_R = 0x01,                    ///< flag R
  ODA_SDO_W = 0x02,                    ///< flag W
  ODA_SDO_RW = ODA_SDO_R | ODA_SDO_W,  ///< flags R and W
  ODA_TPDO = 0x04,                     ///< flags P and R
  ODA_RPDO = 0x08,                     ///< flags P and W
  ODA_TRPDO = ODA_TPDO | ODA_RPDO,     ///< flags P, R and W
  ODA_TSRDO = 0x10,                    ///< transmit SRDO: flags P and R, and CO_SRDO_N
  ODA_RSRDO = 0x20,                    ///< receive SRDO: flags P and W, and CO_SRDO_N
  ODA_TRSRDO = ODA_TSRDO | ODA_RSRDO,  ///< both: flags P, R and W, and CO_SRDO_N
  ODA_MB = 0x40,                       ///< a number of more than one byte: CPU order here, little-endian on the bus
  ODA_STR = 0x80                       ///< text: a shorter value may be written, the first zero ends it
} OD_attributes_t;
/// \}

/// Results. Each result from ODR_OUT_OF_MEM on corresponds to an SDO abort code (OD_getSDOabCode()).
typedef enum ODR_T {
  ODR_PARTIAL = -1,         ///< there is more data: call again
  ODR_OK = 0,               ///< success
  ODR_OUT_OF_MEM = 1,       ///< 0504 0005h
  ODR_UNSUPP_ACCESS = 2,    ///< 0601 0000h: the extension has no such function, or the object cannot be extended
  ODR_WRITEONLY = 3,        ///< 0601 0001h
  ODR_READONLY = 4,         ///< 0601 0002h
  ODR_IDX_NOT_EXIST = 5,    ///< 0602 0000h
  ODR_NO_MAP = 6,           ///< 0604 0041h
  ODR_MAP_LEN = 7,          ///< 0604 0042h
  ODR_PAR_INCOMPAT = 8,     ///< 0604 0043h
  ODR_DEV_INCOMPAT = 9,     ///< 0604 0047h: also a null argument
  ODR_HW = 10,              ///< 0606 0000h
  ODR_TYPE_MISMATCH = 11,   ///< 0607 0010h
  ODR_DATA_LONG = 12,       ///< 0607 0012h
  ODR_DATA_SHORT = 13,      ///< 0607 0013h
  ODR_SUB_NOT_EXIST = 14,   ///< 0609 0011h: also a variable that has no memory and no extension
  ODR_INVALID_VALUE = 15,   ///< 0609 0030h
  ODR_VALUE_HIGH = 16,      ///< 0609 0031h
  ODR_VALUE_LOW = 17,       ///< 0609 0032h
  ODR_MAX_LESS_MIN = 18,    ///< 0609 0036h
  ODR_NO_RESOURCE = 19,     ///< 060A 0023h
  ODR_GENERAL = 20,         ///< 0800 0000h
  ODR_DATA_TRANSF = 21,     ///< 0800 0020h
  ODR_DATA_LOC_CTRL = 22,   ///< 0800 0021h
  ODR_DATA_DEV_STATE = 23,  ///< 0800 0022h: also a stream type of the application that an SDO transfer has open
  ODR_OD_MISSING = 24,      ///< 0800 0023h
  ODR_NO_DATA = 25,         ///< 0800 0024h
  ODR_COUNT = 26,           ///< number of results from ODR_OK on
  /// \cond internal
  ODR_ANY_NUMBER = 0x7FFFFFFF  // makes the enumeration wide enough for any result of a function of the application
  /// \endcond
} ODR_t;

/// Returns the SDO abort code of a result: 0 for ODR_OK, 0604 0047h for any number that is no result. [CiA
/// 301, 7.2.4.3.17]
uint32_t OD_getSDOabCode(ODR_t returnCode) CO_NEEDS(USE_OD);

/// State of an access: the variable and the position in it. Every SDO channel, every PDO and every OD_IO_t of the
/// application has its own stream.
typedef struct OD_stream_T {
  void* dataOrig;  ///< memory of the variable; null: it has none, or only its type knows the address
  void* object;    ///< OD_extension_t.object; null for original functions
  /// Bytes of the variable; 0: not known yet. In a write: set to the total when the last piece arrives.
  OD_size_t dataLength;
  OD_size_t dataOffset;  ///< bytes transferred so far; 0: start of an access. Maintained by the read or write function
  OD_attr_t attribute;   ///< ODA_…
  uint16_t index;        ///< index of the variable
  uint8_t subIndex;      ///< sub-index of the variable
  /// \cond internal
  struct CO_OBJ_T* Entry;  // null: plain memory at dataOrig
  struct CO_NODE_T* Owner;
  /// \endcond
} OD_stream_t;

/// \name Functions that read and write
/// \a buf has any alignment; numbers in it are in the byte order of the CPU. Both functions may be called for SDO, PDO
/// and the application. CO_LOCK_OD() is held during the call; they must not lock it themselves.
///
/// Read fills \a buf with up to \a count bytes and sets \a countRead to their number. It returns ODR_OK if these were
/// the last bytes, so that the next call starts a new access (dataOffset 0); or ODR_PARTIAL, only if \a buf is full, if
/// there are more.
///
/// Write consumes all \a count bytes of \a buf and sets \a countWritten to \a count. It returns ODR_OK if the variable
/// is complete (dataOffset 0), or ODR_PARTIAL if more bytes are needed. Otherwise it consumes nothing and returns the
/// error. It has to check the data before it changes anything, because bytes of earlier calls stay written. The access
/// ends when dataOffset + \a count is dataLength.
/// \{

/// A read function.
typedef ODR_t (*OD_read_t)(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead);
/// A write function.
typedef ODR_t (*OD_write_t)(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten);
/// \}

/// A variable with its access functions. Keep it for repeated access: OD_getSub() searches the dictionary, a read does
/// not.
///
///     if (OD_getSub(OD_find(&Od, 0x1008), 0, &io, false) == ODR_OK) {
///       r = io.read(&io.stream, name, sizeof name, &n);
///     }
typedef struct OD_IO_T {
  OD_stream_t stream;  ///< first argument of read and write
  ODR_t (*read)(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead);  ///< reads the next bytes
  /// Writes the next bytes.
  ODR_t (*write)(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten);
} OD_IO_t;

/// Functions that replace those of an object. The application owns the extension; it must live as long as it is in use.
/// The stack writes only flagsPDO. OD_readOriginal and OD_writeOriginal may be used here; a null function refuses the
/// access with ODR_UNSUPP_ACCESS.
typedef struct OD_extension_T {
  void* object;  ///< for the application: becomes OD_stream_t.object
  ODR_t (*read)(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead);  ///< null: refuses to read
  /// Null: refuses to write.
  ODR_t (*write)(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten);
#if OD_FLAGS_PDO_SIZE > 0
  uint8_t
      flagsPDO[OD_FLAGS_PDO_SIZE];  ///< a bit for each sub-index: 0: a TPDO was requested and has not been seen sent
#endif
} OD_extension_t;

/// \name Kinds of objects (OD_entry_t.odObjectType)
/// \{

/// Values of OD_entry_t.odObjectType: one kind, and ODT_TABLE.
typedef enum OD_objectTypes_T {
  ODT_VAR = 0x01,        ///< sub-index 0 only
  ODT_ARR = 0x02,        ///< sub-indexes 0…n without gaps, those from 1 on of one type
  ODT_REC = 0x03,        ///< anything else
  ODT_TYPE_MASK = 0x0F,  ///< bits of the kind
  ODT_TABLE = 0x80       ///< odObject is the OD_t: the object is in its table of CO_OBJ. Set by OD_init()
} OD_objectTypes_t;
/// \}

/// An object: 12 bytes on a 32-bit CPU.
typedef struct OD_entry_T {
  uint16_t index;             ///< index of the object
  uint8_t subEntriesCount;    ///< number of sub-indexes, including 0; 255 for 256
  uint8_t odObjectType;       ///< ODT_…
  const void* odObject;       ///< depends on odObjectType
  OD_extension_t* extension;  ///< null: none
} OD_entry_t;

/// State of an SDO transfer of an extended object, or of an access of the application to one by CODict… and COObj…
/// functions.
/// \cond internal
typedef struct OD_TRANSFER_T {
  const struct CO_OBJ_T* Entry;  // null: free
  OD_size_t Offset;              // dataOffset between two calls
  OD_size_t Length;              // dataLength between two calls
  OD_size_t Passed;              // bytes transferred
  OD_size_t Total;               // bytes announced, or CO_OBJ_SIZE_UNKNOWN
  uint8_t State;
  uint8_t KeptByte;  // one byte kept between two calls, for example half of a character
} OD_TRANSFER;
/// \endcond

/// Number of simultaneous accesses to extended streams: one for each SDO server, one for an SDO client that accesses
/// its own node, one for the application through co_dict.h and co_obj.h.
#define OD_TRANSFER_N (CO_SSDO_N + 2)

/// A dictionary. Must be all zero before OD_init(). The application may read size and list.
typedef struct OD_T_ {
  uint16_t size;     ///< objects in list
  OD_entry_t* list;  ///< ascending by index, with an all-zero entry behind the last
  /// \cond internal
  struct CO_NODE_T* Node;
  struct CO_OBJ_T* Table;
  OD_entry_t* Filled;            // the list that holds the extensions
  struct OD_WRITING_T* Writing;  // the write function of an extension that is being executed
  uint16_t TableLen;
  uint16_t Changes;  // number of times that an extension was set or removed
  OD_TRANSFER Transfer[OD_TRANSFER_N];
  /// \endcond
} OD_t;

/// Length of the array that OD_init() needs for \a n indexes.
#define OD_LIST_N(n) ((n) + 1)

/// Fills \a list (\a num entries) with the objects of \a table (\a tableLen entries, sorted as CODictInit() requires)
/// and makes it the list of \a od. \a node need not be initialised yet. Objects that \a od already had keep their
/// extensions, also in another list. Call it again, after CODictInit(), when the table of a running node has changed;
/// an OD_IO_t that was filled before is then invalid.
/// \retval ODR_OK            the list is in use
/// \retval ODR_OUT_OF_MEM    \a num is less than OD_LIST_N(indexes in the table); od->size is the required number of
///                           indexes. No object is found until OD_init() is called with a list that is long enough
/// \retval ODR_DEV_INCOMPAT  an argument is null, or the table is not ascending
ODR_t OD_init(OD_t* od, OD_entry_t* list, uint16_t num, struct CO_NODE_T* node, struct CO_OBJ_T* table,
              uint16_t tableLen) CO_NEEDS(USE_OD);

/// Finds the object with this index by binary search.
/// \retval null  there is no such object, or \a od is null or empty
OD_entry_t* OD_find(OD_t* od, uint16_t index) CO_NEEDS(USE_OD);

/// Fills \a io for access to a variable from its beginning. \a odOrig true: uses the original functions even if the
/// object is extended. For an object that is not extended, or whose entry is not extensible (see OD_TYPE), the
/// functions are OD_readOriginal() and OD_writeOriginal(), and stream.object is null.
///
/// stream.dataLength is the length of a number; the capacity of a writable string; the length of the text for
/// CO_TSTRING; the size of a domain; for types of the application the result of Size, 0 for CO_OBJ_SIZE_UNKNOWN.
/// \retval ODR_IDX_NOT_EXIST  \a entry is null or empty
/// \retval ODR_SUB_NOT_EXIST  there is no such sub-index
/// \retval ODR_DEV_INCOMPAT   \a io is null, or odObjectType is unknown
ODR_t OD_getSub(const OD_entry_t* entry, uint8_t subIndex, OD_IO_t* io, bool_t odOrig) CO_NEEDS(USE_OD);

/// Returns the index of an object; 0 if \a entry is null.
uint16_t OD_getIndex(const OD_entry_t* entry) CO_NEEDS(USE_OD);

/// Returns whether the variable may be mapped into a TPDO or an RPDO; false if \a stream is null.
bool_t OD_mappable(const OD_stream_t* stream) CO_NEEDS(USE_OD);

/// Restarts the access: the next call begins at offset 0. Needed only to abandon an access that returned ODR_PARTIAL. A
/// null \a stream is allowed.
void OD_rwRestart(OD_stream_t* stream) CO_NEEDS(USE_OD);

/// \name Original functions
/// Access by the original type of the object, or to the plain memory of a stream without entry.
///
/// A number is written with each piece that arrives: the other bytes keep their values, and the type checks the value
/// each time. To write a shorter string, reduce dataLength beforehand. Bytes behind the end of a text are read as 0; a
/// read of an OCTET_STRING ends with ODR_OK and fewer bytes. A result of the type is converted to the ODR_t with the
/// same abort code; ODR_GENERAL if there is none.
///
/// A stream type of the application can be accessed by one user at a time. A stream that cannot be repositioned
/// (CO_OBJ_TYPE_EX without Reset) and a value of more than 8 bytes can be transferred in a single call only. Begin and
/// End are not called. The Write function of a type receives copies of up to 32 bytes, one after the other: if it
/// refuses one, the previous ones stay written.
/// \retval ODR_DEV_INCOMPAT    an argument is null, dataOffset is behind the end, or a write before CONodeInit()
/// \retval ODR_SUB_NOT_EXIST   the variable has no memory
/// \retval ODR_DATA_LONG       there are more bytes than the variable can hold; nothing of this call is written
/// \retval ODR_DATA_DEV_STATE  the stream is open in an SDO transfer
/// \retval ODR_UNSUPP_ACCESS   second call for an object that can be transferred in a single call only
/// \{

/// Original read function.
ODR_t OD_readOriginal(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead) CO_NEEDS(USE_OD);
/// Original write function.
ODR_t OD_writeOriginal(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten) CO_NEEDS(USE_OD);
/// \}

/// Sets the extension of an object for SDO, PDO and application, from the next access on; null removes it. Open
/// accesses end: an SDO transfer of the object is aborted (0800 0022h) at its next frame, or at once if a function of
/// the object's extension or type calls OD_extension_init(); the End function of a CO_OBJ_TYPE_EX behind the extension
/// is called once. COObj…Cont() of an access that was started before returns CO_ERR_OBJ_STATE. An OD_IO_t keeps the
/// functions that it was filled with: call OD_getSub() again.
///
/// With flag A, a write sends the TPDOs that map the object, once, when the write is complete: for a number whose write
/// function has called the original function, only if the value has changed; otherwise after each accepted write.
///
/// Extensions that consist of the original functions are accepted for any object.
/// \retval ODR_IDX_NOT_EXIST  \a entry is null
/// \retval ODR_UNSUPP_ACCESS  no entry of the object is extensible (see OD_TYPE), so the extension would have no effect
///                            on the network
ODR_t OD_extension_init(OD_entry_t* entry, OD_extension_t* extension) CO_NEEDS(USE_OD);

/// \name Values of a known length
/// Call OD_getSub(), then one read or write of \a len bytes. Access rights of the network are not checked. For each C
/// type there is a pair of functions with the width of the type: OD_get_i8(entry, subIndex, &value, odOrig) and
/// OD_set_i8(entry, subIndex, value, odOrig), likewise i16, i32, i64, u8, u16, u32, u64, f32, f64, and r32 and r64, the
/// names of f32 and f64 in the draft of 2020. All return the errors of OD_getSub() and of the read or write, or:
/// \retval ODR_DEV_INCOMPAT   \a val is null, or an extension has accepted fewer bytes and returned ODR_OK
/// \retval ODR_TYPE_MISMATCH  the variable has another length; nothing is read or written
/// \{

/// Reads a value of \a len bytes into \a val.
ODR_t OD_get_value(const OD_entry_t* entry, uint8_t subIndex, void* val, OD_size_t len, bool_t odOrig) CO_NEEDS(USE_OD);
/// Writes a value of \a len bytes from \a val.
ODR_t OD_set_value(const OD_entry_t* entry, uint8_t subIndex, void* val, OD_size_t len, bool_t odOrig) CO_NEEDS(USE_OD);

/// \cond internal
#if USE_OD
#define OD_GET_SET(name, type, pointer)                                                                      \
  static inline ODR_t OD_get_##name(const OD_entry_t* entry, uint8_t subIndex, pointer val, bool_t odOrig) { \
    return OD_get_value(entry, subIndex, val, (OD_size_t)sizeof(type), odOrig);                              \
  }                                                                                                          \
  static inline ODR_t OD_set_##name(const OD_entry_t* entry, uint8_t subIndex, type val, bool_t odOrig) {    \
    return OD_set_value(entry, subIndex, &val, (OD_size_t)sizeof(type), odOrig);                             \
  }
#else
#define OD_GET_SET(name, type, pointer)                                                                        \
  ODR_t OD_get_##name(const OD_entry_t* entry, uint8_t subIndex, pointer val, bool_t odOrig) CO_NEEDS(USE_OD); \
  ODR_t OD_set_##name(const OD_entry_t* entry, uint8_t subIndex, type val, bool_t odOrig) CO_NEEDS(USE_OD);
#endif
/// \endcond

OD_GET_SET(i8, int8_t, int8_t*)
OD_GET_SET(i16, int16_t, int16_t*)
OD_GET_SET(i32, int32_t, int32_t*)
OD_GET_SET(i64, int64_t, int64_t*)
OD_GET_SET(u8, uint8_t, uint8_t*)
OD_GET_SET(u16, uint16_t, uint16_t*)
OD_GET_SET(u32, uint32_t, uint32_t*)
OD_GET_SET(u64, uint64_t, uint64_t*)
OD_GET_SET(f32, float32_t, float32_t*)
OD_GET_SET(f64, float64_t, float64_t*)
OD_GET_SET(r32, float32_t, float32_t*)
OD_GET_SET(r64, float64_t, float64_t*)
#undef OD_GET_SET
/// \}

/// Returns the address of a variable's original memory, also if the object is extended. \a len: expected length in
/// bytes, 0: not checked. Returns null on error and stores the reason in \a err (may be null): the errors of
/// OD_getSub(), or those below.
///
/// Values with flag N are stored without the node-ID; values with flag D are in the table, which may be read-only
/// memory; numbers of 3, 5, 6 and 7 bytes are in a wider variable. A change through the address does not trigger TPDOs
/// (flag A).
/// \retval ODR_DEV_INCOMPAT   the variable has no memory, or its length is unknown
/// \retval ODR_TYPE_MISMATCH  the variable has another length
void* OD_getPtr(const OD_entry_t* entry, uint8_t subIndex, OD_size_t len, ODR_t* err) CO_NEEDS(USE_OD);

/// \name PDO flags
/// They need no extension. The flags are those of CORPdoObjWasReceived() and COTPdoObjWasSent() (co_pdo.h); these
/// functions read them without clearing them. Use only one of the two interfaces for an object.
/// \{

/// Requests the transmission of every TPDO of type 0, 254 or 255 that maps the variable: at once, when its inhibit time
/// has elapsed, or with the next SYNC (type 0). The reason why a TPDO is not sent is the node's error
/// (COTPdoRequest()).
void OD_requestTPDO(OD_entry_t* entry, uint8_t subIndex) CO_NEEDS(USE_OD);

/// Returns whether a TPDO with the variable was sent since OD_requestTPDO(); false if no TPDO maps the variable.
bool_t OD_TPDOtransmitted(OD_entry_t* entry, uint8_t subIndex) CO_NEEDS(USE_OD);

/// PDO flags of a variable. Bit 0: written by an RPDO; bit n: sent by TPDO n (from 1), since the bit was cleared.
typedef uint32_t OD_flagsPDO_t;

/// Returns the PDO flags of the variable; 0 if no PDO maps it.
OD_flagsPDO_t OD_getFlagsPDO(const OD_entry_t* entry, uint8_t subIndex) CO_NEEDS(USE_OD);

/// Clears the bits that are set in \a flags. Requests the transmission of the TPDOs among them that map the variable,
/// like OD_requestTPDO().
void OD_clearFlagsPDO(const OD_entry_t* entry, uint8_t subIndex, OD_flagsPDO_t flags) CO_NEEDS(USE_OD);
/// \}

/// \name Parameter groups by name
/// A group is a CO_PARA (co_para.h) whose Ident points to its name; its number is its sub-index of 1010h and 1011h. As
/// described in co_para.h, stores are atomic (power-fail safe) with a driver that has a Shape function.
///
///     static const CO_PARA Comm = OD_GROUP("PERSIST_COMM", OD_PERSIST_COMM, OD_PERSIST_COMM_default, 0, CO_RESET_COM,
///                                          CO_PARA___E);
///     { CO_KEY(0x1010, 2, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Comm) },
///     { CO_KEY(0x1011, 2, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&Comm) },
///
/// The memory itself is stored: extensions are not called.
/// \{

/// Initialises a CO_PARA. \a name: a string; \a variable: the group's memory; \a defaults: a variable of the same type;
/// \a offset: in the non-volatile memory; \a reset: CO_RESET_COM or CO_RESET_NODE; \a value: CO_PARA_…
#define OD_GROUP(name, variable, defaults, offset, reset, value)                                                \
  {                                                                                                             \
    (offset), (uint32_t)sizeof(variable), (uint8_t*)&(variable), (uint8_t*)&(defaults), (reset), (void*)(name), \
        (value), 0, 0                                                                                           \
  }

/// Returns the sub-index of 1010h of the group with this name, 1…127; 0: there is none. Reads Ident of all groups of
/// 1010h as a string: an application that calls OD_findStorageGroup() or OD_getStorageName() must set the Ident of each
/// group to a NUL-terminated string or null.
uint8_t OD_findStorageGroup(const OD_t* od, const char* name) CO_NEEDS(USE_OD) CO_NEEDS(USE_PARA);

/// Returns the sub-index of 1010h of the group that contains the variable's original memory; 0: the variable is not
/// stored.
uint8_t OD_getStorageGroup(const OD_entry_t* entry, uint8_t subIndex) CO_NEEDS(USE_OD) CO_NEEDS(USE_PARA);

/// Returns the name of a group; null: there is no such group, or it has no name.
const char* OD_getStorageName(const OD_t* od, uint8_t group) CO_NEEDS(USE_OD) CO_NEEDS(USE_PARA);

/// Stores the group, like "save" of the network. If 1010h has more than one sub-index, group 1 selects all groups.
/// \retval ODR_OK              the group is stored
/// \retval ODR_SUB_NOT_EXIST   there is no such group
/// \retval ODR_HW              the memory does not hold the values; the old ones stay
/// \retval ODR_DATA_TRANSF     the group is not stored on command
/// \retval ODR_OD_MISSING      the node does not use this dictionary
ODR_t OD_storeGroup(const OD_t* od, uint8_t group) CO_NEEDS(USE_OD) CO_NEEDS(USE_PARA);
/// Restores the default values of the group at the reset of its type, like "load" of the network. Group 1 is that of
/// OD_storeGroup().
/// \retval ODR_OK              the group will be restored
/// \retval ODR_SUB_NOT_EXIST   there is no such group
/// \retval ODR_HW              the memory could not be changed
/// \retval ODR_DATA_TRANSF     the group is not restored on command
/// \retval ODR_OD_MISSING      the node does not use this dictionary
ODR_t OD_restoreGroup(const OD_t* od, uint8_t group) CO_NEEDS(USE_OD) CO_NEEDS(USE_PARA);
/// \}

/// \name Locks
/// All three names are one lock, the node lock (CO_NODE_EXT.Enter and Leave, see co_real_time.h), so they cannot be
/// taken in a wrong order. Each thread holds it around every call of the stack that does not lock it itself, and around
/// accesses to objects. Calls do not nest. Functions that the stack calls (read and write functions, callbacks, types,
/// timer actions, drivers) run with the lock held and must not lock it.
///
/// Without Enter and Leave there is one context, and the lock is CO_NODE_EXT.OdLock and OdUnlock: for accesses of the
/// loop that must be consistent for interrupts and for threads that access only variables. In this case calls may nest.
///
/// Call it after CONodeInit() only. It is not needed while there is one thread, nor for variables that only one context
/// accesses. \a node: a CO_NODE*; examples for CANopenNode use CANmodule.
/// \{
#ifndef CO_LOCK_OD
#define CO_LOCK_OD(node) OD_lock(node)      ///< locks, for access to objects
#define CO_UNLOCK_OD(node) OD_unlock(node)  ///< unlocks
#endif
#ifndef CO_LOCK_CAN_SEND
#define CO_LOCK_CAN_SEND(node) OD_lock(node)      ///< locks, for frames of the application
#define CO_UNLOCK_CAN_SEND(node) OD_unlock(node)  ///< unlocks
#endif
#ifndef CO_LOCK_EMCY
#define CO_LOCK_EMCY(node) OD_lock(node)      ///< locks, for emergencies
#define CO_UNLOCK_EMCY(node) OD_unlock(node)  ///< unlocks
#endif

/// Takes the lock. A null \a node calls CONodeFatalError().
void OD_lock(struct CO_NODE_T* node) CO_NEEDS(USE_OD);
/// Releases the lock. With OdLock: then sends the TPDOs that were triggered while it was held. A null \a node calls
/// CONodeFatalError().
void OD_unlock(struct CO_NODE_T* node) CO_NEEDS(USE_OD);
/// \}

/// \name Types of entries that can be extended
/// An OD_TYPE replaces the type of an entry and refers to it as the original type; the entry keeps its Data.
/// OD_TUNSIGNED32 replaces CO_TUNSIGNED32. Without an extension it behaves like the original type, apart from the time
/// of the check. With an extension, the application's functions serve SDO, PDO, CODict… and COObj…: a number in one
/// call, a stream in the pieces that arrive; their results are converted to abort codes. Numbers of such types are not
/// copied directly in PDOs, and BOOLEAN is mapped as a byte.
/// \{

/// Behaviour of an entry without an extension.
typedef enum OD_WITHOUT_T {
  OD_ORIGINAL = 0,  ///< the entry behaves like its original type
  OD_DISABLED = 1   ///< the entry can be neither read nor written: 0601 0001h, 0601 0002h
} OD_WITHOUT;

/// A type of extensible entries, initialised by OD_VALUE() or OD_STREAM(). It must live as long as the dictionary.
typedef struct OD_TYPE_T {
  CO_OBJ_TYPE_EX Ex;            ///< Ex.Type.Init is ODTypeInit, which identifies an OD_TYPE
  const CO_OBJ_TYPE* Original;  ///< null: no memory
  OD_WITHOUT Without;           ///< behaviour without an extension
} OD_TYPE;

/// Initialise an OD_TYPE for an original type of the application. OD_VALUE is for a type without Reset function, of up
/// to 8 bytes; OD_STREAM for a type with Reset function. \a original: address of the type, whose functions are called
/// with the entry (whose Type is the OD_TYPE). Not allowed are CO_TPARA_…, because the stack recognises their entries
/// by their type, and an OD_TYPE. In a file with OD_ALL every CO_T… is an OD_TYPE; use &COTInt32 and so on there. An
/// OD_TYPE as \a original does not compile in C++; in C the node does not start (CO_DICT_NO_TYPE).
///
///     static const OD_TYPE FileType = OD_STREAM(&File.Type, OD_DISABLED);
///     { CO_KEY(0x2200, 0, CO_OBJ_____RW), &FileType.Ex.Type, (CO_DATA)(&file) },
#define OD_VALUE(original, without) \
  { {{ODValueSize, ODTypeInit, ODValueRead, ODValueWrite, 0}, 0, 0, 0}, OD_BEHIND(original), (without) }
/// Initialises an OD_TYPE for a type with Reset function, see OD_VALUE().
#define OD_STREAM(original, without)                                            \
  {                                                                             \
    {{ODStreamSize, ODTypeInit, ODStreamRead, ODStreamWrite, COObjTypeExReset}, \
     ODStreamReset,                                                             \
     ODStreamBegin,                                                             \
     ODStreamEnd},                                                              \
        OD_BEHIND(original), (without)                                          \
  }

/// \cond internal
uint32_t ODValueSize(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t width) CO_NEEDS(USE_OD);
uint32_t ODStreamSize(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t width) CO_NEEDS(USE_OD);
CO_ERR ODTypeInit(struct CO_OBJ_T* obj, struct CO_NODE_T* node) CO_NEEDS(USE_OD);
CO_ERR ODValueRead(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size) CO_NEEDS(USE_OD);
CO_ERR ODValueWrite(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size) CO_NEEDS(USE_OD);
CO_ERR ODStreamRead(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size) CO_NEEDS(USE_OD);
CO_ERR ODStreamWrite(struct CO_OBJ_T* obj, struct CO_NODE_T* node, void* buffer, uint32_t size) CO_NEEDS(USE_OD);
CO_ERR ODStreamReset(struct CO_OBJ_T* obj, struct CO_NODE_T* node, uint32_t position) CO_NEEDS(USE_OD);
CO_ERR ODStreamBegin(struct CO_OBJ_T* obj, struct CO_NODE_T* node, CO_OBJ_TRANSFER transfer, uint32_t size)
    CO_NEEDS(USE_OD);
CO_ERR ODStreamEnd(struct CO_OBJ_T* obj, struct CO_NODE_T* node, CO_OBJ_TRANSFER transfer, uint32_t abort)
    CO_NEEDS(USE_OD);

CO_NEEDS(USE_OD) extern const OD_TYPE ODTInt8, ODTInt16, ODTInt32, ODTInt64, ODTBoolean, ODTReal32, ODTReal64;
CO_NEEDS(USE_OD) extern const OD_TYPE ODTTimeOfDay;
CO_NEEDS(USE_OD) extern const OD_TYPE ODTUnsigned24, ODTUnsigned40, ODTUnsigned48, ODTUnsigned56;
CO_NEEDS(USE_OD) extern const OD_TYPE ODTSigned24, ODTSigned40, ODTSigned48, ODTSigned56;
CO_NEEDS(USE_OD) extern const OD_TYPE ODTString, ODTVisibleString, ODTOctetString, ODTUnicodeString, ODTDomain;
CO_NEEDS(USE_OD) extern const OD_TYPE ODTNumber, ODTStream;
/// \endcond

#define OD_TUNSIGNED8 (&ODTInt8.Ex.Type)                ///< replaces CO_TUNSIGNED8
#define OD_TUNSIGNED16 (&ODTInt16.Ex.Type)              ///< replaces CO_TUNSIGNED16
#define OD_TUNSIGNED24 (&ODTUnsigned24.Ex.Type)         ///< replaces CO_TUNSIGNED24
#define OD_TUNSIGNED32 (&ODTInt32.Ex.Type)              ///< replaces CO_TUNSIGNED32
#define OD_TUNSIGNED40 (&ODTUnsigned40.Ex.Type)         ///< replaces CO_TUNSIGNED40
#define OD_TUNSIGNED48 (&ODTUnsigned48.Ex.Type)         ///< replaces CO_TUNSIGNED48
#define OD_TUNSIGNED56 (&ODTUnsigned56.Ex.Type)         ///< replaces CO_TUNSIGNED56
#define OD_TUNSIGNED64 (&ODTInt64.Ex.Type)              ///< replaces CO_TUNSIGNED64
#define OD_TSIGNED8 (&ODTInt8.Ex.Type)                  ///< replaces CO_TSIGNED8
#define OD_TSIGNED16 (&ODTInt16.Ex.Type)                ///< replaces CO_TSIGNED16
#define OD_TSIGNED24 (&ODTSigned24.Ex.Type)             ///< replaces CO_TSIGNED24
#define OD_TSIGNED32 (&ODTInt32.Ex.Type)                ///< replaces CO_TSIGNED32
#define OD_TSIGNED40 (&ODTSigned40.Ex.Type)             ///< replaces CO_TSIGNED40
#define OD_TSIGNED48 (&ODTSigned48.Ex.Type)             ///< replaces CO_TSIGNED48
#define OD_TSIGNED56 (&ODTSigned56.Ex.Type)             ///< replaces CO_TSIGNED56
#define OD_TSIGNED64 (&ODTInt64.Ex.Type)                ///< replaces CO_TSIGNED64
#define OD_TBOOLEAN (&ODTBoolean.Ex.Type)               ///< replaces CO_TBOOLEAN
#define OD_TREAL32 (&ODTReal32.Ex.Type)                 ///< replaces CO_TREAL32
#define OD_TREAL64 (&ODTReal64.Ex.Type)                 ///< replaces CO_TREAL64
#define OD_TTIME_OF_DAY (&ODTTimeOfDay.Ex.Type)         ///< replaces CO_TTIME_OF_DAY
#define OD_TTIME_DIFFERENCE (&ODTTimeOfDay.Ex.Type)     ///< replaces CO_TTIME_DIFFERENCE
#define OD_TSTRING (&ODTString.Ex.Type)                 ///< replaces CO_TSTRING
#define OD_TVISIBLE_STRING (&ODTVisibleString.Ex.Type)  ///< replaces CO_TVISIBLE_STRING
#define OD_TOCTET_STRING (&ODTOctetString.Ex.Type)      ///< replaces CO_TOCTET_STRING
#define OD_TUNICODE_STRING (&ODTUnicodeString.Ex.Type)  ///< replaces CO_TUNICODE_STRING
#define OD_TDOMAIN (&ODTDomain.Ex.Type)                 ///< replaces CO_TDOMAIN
/// \cond internal
#if defined(__cplusplus) && USE_OD
inline void OD_TYPE_in_front_of_an_OD_TYPE(void) {}  // not constexpr, so that a call of it is a compile error

constexpr const CO_OBJ_TYPE* OD_BEHIND(const CO_OBJ_TYPE* original) {
  if (!__builtin_is_constant_evaluated()) {
    return original;
  }
  const CO_OBJ_TYPE* const all[] = {
      OD_TUNSIGNED8,    OD_TUNSIGNED16,     OD_TUNSIGNED32, OD_TUNSIGNED64,  OD_TBOOLEAN,    OD_TREAL32,
      OD_TREAL64,       OD_TUNSIGNED24,     OD_TUNSIGNED40, OD_TUNSIGNED48,  OD_TUNSIGNED56, OD_TSIGNED24,
      OD_TSIGNED40,     OD_TSIGNED48,       OD_TSIGNED56,   OD_TTIME_OF_DAY, OD_TSTRING,     OD_TVISIBLE_STRING,
      OD_TOCTET_STRING, OD_TUNICODE_STRING, OD_TDOMAIN};
  for (const CO_OBJ_TYPE* const type : all) {
    if (__builtin_constant_p(original == type) && original == type) {  // gcc 11 cannot prove that others differ
      OD_TYPE_in_front_of_an_OD_TYPE();
    }
  }
  return original;
}
#else
#define OD_BEHIND(original) (original)
#endif
/// \endcond

/// A number that only the extension provides; Data: its length in bytes, 1…8. Not accessible without an extension.
#define OD_TNUMBER (&ODTNumber.Ex.Type)
/// Bytes that only the extension provides; Data: their number, 0: not known in advance. Not accessible without an
/// extension.
#define OD_TSTREAM (&ODTStream.Ex.Type)
/// \}

/// \name Objects in plain memory
/// For dictionaries that are defined, like those of CANopenNode, as an array of OD_entry_t that refers to these
/// structures. The functions above find, read and write them. They are not accessible from the network, which uses the
/// table of CO_OBJ.
/// \{

/// An object with sub-index 0 only (ODT_VAR).
typedef struct OD_obj_var_T {
  union {
    void* dataOrig;  ///< null: no memory
    void* data;      ///< alias of dataOrig
  };
  OD_attr_t attribute;   ///< ODA_…
  OD_size_t dataLength;  ///< bytes of the variable
} OD_obj_var_t;

/// An array (ODT_ARR).
typedef struct OD_obj_array_T {
  uint8_t* dataOrig0;           ///< sub-index 0
  void* dataOrig;               ///< sub-index 1; null: no memory
  OD_attr_t attribute0;         ///< ODA_… of sub-index 0
  OD_attr_t attribute;          ///< ODA_… of the elements
  OD_size_t dataElementLength;  ///< bytes of each element
  OD_size_t dataElementSizeof;  ///< distance of two elements in bytes
} OD_obj_array_t;

/// A sub-index of a record (ODT_REC), which is an array of these.
typedef struct OD_obj_record_T {
  union {
    void* dataOrig;  ///< null: no memory
    void* data;      ///< alias of dataOrig
  };
  uint8_t subIndex;      ///< ascending, gaps are allowed
  OD_attr_t attribute;   ///< ODA_…
  OD_size_t dataLength;  ///< bytes of the variable
} OD_obj_record_t;
/// \}

/// Indexes of the communication profile [CiA 301, 7.5.2], and of safety-relevant PDOs (1300h…13FFh) [EN 50325-5].
typedef enum OD_ObjDicId_30x_T {
  OD_H1000_DEV_TYPE = 0x1000,            ///< device type
  OD_H1001_ERR_REG = 0x1001,             ///< error register
  OD_H1002_MANUF_STATUS_REG = 0x1002,    ///< manufacturer status register
  OD_H1003_PREDEF_ERR_FIELD = 0x1003,    ///< pre-defined error field
  OD_H1005_COBID_SYNC = 0x1005,          ///< COB-ID SYNC
  OD_H1006_COMM_CYCL_PERIOD = 0x1006,    ///< communication cycle period
  OD_H1007_SYNC_WINDOW_LEN = 0x1007,     ///< synchronous window length
  OD_H1008_MANUF_DEV_NAME = 0x1008,      ///< manufacturer device name
  OD_H1009_MANUF_HW_VERSION = 0x1009,    ///< manufacturer hardware version
  OD_H100A_MANUF_SW_VERSION = 0x100A,    ///< manufacturer software version
  OD_H100C_GUARD_TIME = 0x100C,          ///< guard time
  OD_H100D_LIFETIME_FACTOR = 0x100D,     ///< life time factor
  OD_H1010_STORE_PARAM_FUNC = 0x1010,    ///< store parameters
  OD_H1011_REST_PARAM_FUNC = 0x1011,     ///< restore default parameters
  OD_H1012_COBID_TIME = 0x1012,          ///< COB-ID time stamp
  OD_H1013_HIGH_RES_TIMESTAMP = 0x1013,  ///< high resolution time stamp
  OD_H1014_COBID_EMERGENCY = 0x1014,     ///< COB-ID EMCY
  OD_H1015_INHIBIT_TIME_MSG = 0x1015,    ///< inhibit time EMCY
  OD_H1016_CONSUMER_HB_TIME = 0x1016,    ///< consumer heartbeat time
  OD_H1017_PRODUCER_HB_TIME = 0x1017,    ///< producer heartbeat time
  OD_H1018_IDENTITY_OBJECT = 0x1018,     ///< identity object
  OD_H1019_SYNC_CNT_OVERFLOW = 0x1019,   ///< synchronous counter overflow value
  OD_H1020_VERIFY_CONFIG = 0x1020,       ///< verify configuration
  OD_H1021_STORE_EDS = 0x1021,           ///< store EDS
  OD_H1022_STORE_FORMAT = 0x1022,        ///< store format
  OD_H1023_OS_CMD = 0x1023,              ///< OS command
  OD_H1024_OS_CMD_MODE = 0x1024,         ///< OS command mode
  OD_H1025_OS_DBG_INTERFACE = 0x1025,    ///< OS debugger interface
  OD_H1026_OS_PROMPT = 0x1026,           ///< OS prompt
  OD_H1027_MODULE_LIST = 0x1027,         ///< module list
  OD_H1028_EMCY_CONSUMER = 0x1028,       ///< emergency consumer object
  OD_H1029_ERR_BEHAVIOR = 0x1029,        ///< error behaviour object
  OD_H1200_SDO_SERVER_1_PARAM = 0x1200,  ///< parameters of SDO server 1
  OD_H1280_SDO_CLIENT_1_PARAM = 0x1280,  ///< parameters of SDO client 1
  OD_H1300_GFC_PARAM = 0x1300,           ///< global fail-safe command parameter
  OD_H1301_SRDO_1_PARAM = 0x1301,        ///< communication parameters of SRDO 1
  OD_H1381_SRDO_1_MAPPING = 0x1381,      ///< mapping of SRDO 1
  OD_H13FE_SRDO_VALID = 0x13FE,          ///< safety configuration valid
  OD_H13FF_SRDO_CHECKSUM = 0x13FF,       ///< safety configuration checksum
  OD_H1400_RXPDO_1_PARAM = 0x1400,       ///< communication parameters of RPDO 1
  OD_H1600_RXPDO_1_MAPPING = 0x1600,     ///< mapping of RPDO 1
  OD_H1800_TXPDO_1_PARAM = 0x1800,       ///< communication parameters of TPDO 1
  OD_H1A00_TXPDO_1_MAPPING = 0x1A00      ///< mapping of TPDO 1
} OD_ObjDicId_30x_t;

#ifdef __cplusplus
}
#endif

#endif

// Evaluated at each inclusion: with OD_ALL, all entries of the table that follows are extensible.
#ifdef OD_ALL
#undef CO_TUNSIGNED8
#undef CO_TUNSIGNED16
#undef CO_TUNSIGNED24
#undef CO_TUNSIGNED32
#undef CO_TUNSIGNED40
#undef CO_TUNSIGNED48
#undef CO_TUNSIGNED56
#undef CO_TUNSIGNED64
#undef CO_TSIGNED8
#undef CO_TSIGNED16
#undef CO_TSIGNED24
#undef CO_TSIGNED32
#undef CO_TSIGNED40
#undef CO_TSIGNED48
#undef CO_TSIGNED56
#undef CO_TSIGNED64
#undef CO_TBOOLEAN
#undef CO_TREAL32
#undef CO_TREAL64
#undef CO_TTIME_OF_DAY
#undef CO_TTIME_DIFFERENCE
#undef CO_TSTRING
#undef CO_TVISIBLE_STRING
#undef CO_TOCTET_STRING
#undef CO_TUNICODE_STRING
#undef CO_TDOMAIN
#define CO_TUNSIGNED8 OD_TUNSIGNED8
#define CO_TUNSIGNED16 OD_TUNSIGNED16
#define CO_TUNSIGNED24 OD_TUNSIGNED24
#define CO_TUNSIGNED32 OD_TUNSIGNED32
#define CO_TUNSIGNED40 OD_TUNSIGNED40
#define CO_TUNSIGNED48 OD_TUNSIGNED48
#define CO_TUNSIGNED56 OD_TUNSIGNED56
#define CO_TUNSIGNED64 OD_TUNSIGNED64
#define CO_TSIGNED8 OD_TSIGNED8
#define CO_TSIGNED16 OD_TSIGNED16
#define CO_TSIGNED24 OD_TSIGNED24
#define CO_TSIGNED32 OD_TSIGNED32
#define CO_TSIGNED40 OD_TSIGNED40
#define CO_TSIGNED48 OD_TSIGNED48
#define CO_TSIGNED56 OD_TSIGNED56
#define CO_TSIGNED64 OD_TSIGNED64
#define CO_TBOOLEAN OD_TBOOLEAN
#define CO_TREAL32 OD_TREAL32
#define CO_TREAL64 OD_TREAL64
#define CO_TTIME_OF_DAY OD_TTIME_OF_DAY
#define CO_TTIME_DIFFERENCE OD_TTIME_DIFFERENCE
#define CO_TSTRING OD_TSTRING
#define CO_TVISIBLE_STRING OD_TVISIBLE_STRING
#define CO_TOCTET_STRING OD_TOCTET_STRING
#define CO_TUNICODE_STRING OD_TUNICODE_STRING
#define CO_TDOMAIN OD_TDOMAIN
#endif
