// SPDX-License-Identifier: Apache-2.0
/// \file co_dict.h
/// The object dictionary: a table of CO_OBJ, sorted by index and sub-index, and its lookup functions. [CiA 301, 7.4]
///
/// Context: the loop (see co_obj.h).
#ifndef CO_DICT_H_
#define CO_DICT_H_

#include "co_cfg.h"
#include "co_nmt.h"
#include "co_obj.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Faults of a dictionary: name, number, meaning. CO_OD_CHECK() (lexican/dictionary.hpp) rejects all but
/// CO_DICT_PARA_OVERLAP at compile time. At run time only a fault that breaks the search or memory safety stops the
/// node (CO_INVALID, CO_ERR_DICT_INIT). Any other fault affects its entry only: the node runs, its error is
/// CO_ERR_OBJ_INIT, and CODictGetFault() returns the entry. With USE_DICT_CHECK 0 nothing is checked at run time,
/// except that CODictGetFault() finds CO_DICT_NOT_ASCENDING. CO_DICT_DIRECT_ADDRESS, CO_DICT_DIRECT_CONST,
/// CO_DICT_NOT_MAPPABLE, CO_DICT_MISSING, CO_DICT_MAP_TARGET and CO_DICT_MAP_LENGTH are detected at compile time only,
/// and so is CO_DICT_WRONG_PLACE of objects without a type of their own, such as 1000h.
///
/// CO_DICT_NO_DATA: SDO transfers of the entry are aborted with 0800 0020h, API functions return an error, and a PDO
/// that maps the entry does not exist; this also holds with USE_DICT_CHECK 0. CO_DICT_RESERVED_INDEX of a static data
/// type does not stop the node.
// clang-format off
#define CO_DICT_FAULT_LIST(X)                                                                                          \
  X(CO_DICT_NOT_ASCENDING, 1, "the key is not greater than the key before it: sort the table by index and sub-index")  \
  X(CO_DICT_NO_TYPE, 2, "Type is null, or an OD_TYPE in front of an OD_TYPE (co_od.h)")                                \
  X(CO_DICT_NO_DATA, 3, "Data is null, but the type needs the address of a variable; the node runs")                   \
  X(CO_DICT_DIRECT_TYPE, 4, "flag D with a type that needs an address, or that does not fit into a pointer")           \
  X(CO_DICT_NODEID_TYPE, 5, "flag N with a type that has no values relative to the node-ID; the node runs")            \
  X(CO_DICT_WRONG_PLACE, 6, "this object has another type or length, see docs/cookbook.md")                            \
  X(CO_DICT_NOT_CONFIGURED, 7, "the number of the service is beyond the configuration (CO_SSDO_N, CO_TPDO_N, ...)")    \
  X(CO_DICT_DIRECT_ADDRESS, 8, "flag D with an address, or no flag D with a value")                                    \
  X(CO_DICT_DIRECT_CONST, 9, "flags D and W in a table in read-only memory")                                           \
  X(CO_DICT_RESERVED_INDEX, 10, "index 0000h; or a static data type (index 0001h to 001Fh) with data")                 \
  X(CO_DICT_NOT_MAPPABLE, 11, "a PDO of the table maps this entry, which has no flag P")                               \
  X(CO_DICT_PARA_OVERLAP, 12, "the parameter group overlaps one with a lower sub-index; the node runs without it")      \
  X(CO_DICT_MISSING, 13, "this mandatory object is missing: 1000h, 1001h, 1018h:00 or 1018h:01")                       \
  X(CO_DICT_MAP_TARGET, 14, "this mapping names an object that the table does not have")                               \
  X(CO_DICT_MAP_LENGTH, 15, "this mapping names another length than that of the object, or more than 64 bits")
// clang-format on

/// \cond internal
#define CO_DICT_FAULT_ENUMERATOR(name, number, text) name = (number),
#define CO_DICT_FAULT_NUMBERS(name, number, text) number,
#define CO_DICT_FAULT_NAME_AND_NUL(name, number, text) #name "\0"
#define CO_DICT_FAULT_TEXT_AND_NUL(name, number, text) text "\0"
/// \endcond

/// Faults of a dictionary, see CO_DICT_FAULT_LIST.
typedef enum CO_DICT_FAULT_T {
  CO_DICT_OK = 0,  ///< no fault
  CO_DICT_FAULT_LIST(CO_DICT_FAULT_ENUMERATOR)
} CO_DICT_FAULT;

/// The object dictionary of a node: &node.Dict. The application must not access the members.
typedef struct CO_DICT_T {
  struct CO_OBJ_T* Root;  ///< first entry
#if USE_FAST_PATHS
  struct CO_OBJ_T* Split;  ///< first entry of the upper half, for the binary search
  struct CO_OBJ_T* Last;   ///< last entry
  struct CO_OBJ_T*
      Next;  ///< entry behind the one found last: the next sub-index is found without a search; null: no entries
#endif
  struct CO_OBJ_T* End;  ///< end mark with a type (CO_OBJ_DICT_DEFAULTS()), or null
  uint16_t Num;          ///< entries in use
#if USE_FAST_PATHS
  uint8_t Steps;  ///< steps of the binary search in either half
#endif
#if USE_DICT_CHECK
  uint8_t Fault;      ///< CO_DICT_FAULT of CODictInit() or of a type's Init function
  uint32_t FaultKey;  ///< key of the entry with that fault
#endif
  struct CO_NODE_T* Node;  ///< owner
} CO_DICT;

/// \name Power-on values [CiA 301, 7.3.2.2.1]
/// Variables that no parameter group stores (co_para.h) have their default values after CONodeInit() and after NMT
/// resets if the end mark of the table lists them:
///
///     static struct { uint32_t SyncId; uint16_t Heartbeat; } Com;   // 1005h, 1017h
///     static struct { int16_t Setpoint; } App;                      // 2100h
///     static const struct … ComDefault = {0x80, 1000};
///     static const CO_DEFAULTS Defaults[] = {CO_DEFAULTS_OF(Com, ComDefault, CO_RESET_COM),
///                                            CO_DEFAULTS_ZERO(App, CO_RESET_NODE), CO_DEFAULTS_END};
///     …
///     CO_OBJ_DICT_DEFAULTS(Defaults)};   // in place of CO_OBJ_DICT_ENDMARK
///
/// The values are copied before parameter groups are loaded and before the Init functions of the entries run, so every
/// service uses them. The end mark must be among the entries that DictLen counts. Memory of any kind can be listed: a
/// string is reset completely if both its CO_OBJ_STR_RW and its bytes are listed. The list must not contain 1001h and
/// 1003h, which the stack writes, nor variables of a group that is stored autonomously (CO_PARA__A_): a reset would
/// store their default values over changes that are not stored yet.
/// \{

/// A block of variables and its default values.
typedef struct CO_DEFAULTS_T {
  void* Start;               ///< the variables
  const void* Default;       ///< their default values, or null: all bytes are 0
  uint32_t Size;             ///< bytes of the block; 0: end of the list
  enum CO_NMT_RESET_T Type;  ///< CO_RESET_COM: both NMT resets; CO_RESET_NODE: reset node only
} CO_DEFAULTS;

/// Initialises a CO_DEFAULTS: \a variables gets the value of \a defaults, a variable of the same type. \a type:
/// CO_RESET_COM or CO_RESET_NODE.
#define CO_DEFAULTS_OF(variables, defaults, type) \
  { &(variables), &(defaults), sizeof(variables), (type) }
/// Initialises a CO_DEFAULTS: all bytes of \a variables become 0. \a type as in CO_DEFAULTS_OF().
#define CO_DEFAULTS_ZERO(variables, type) \
  { &(variables), 0, sizeof(variables), (type) }
/// Initialises the last CO_DEFAULTS of a list.
#define CO_DEFAULTS_END \
  { 0, 0, 0, CO_RESET_INVALID }

/// End mark of a table: \a list is an array of CO_DEFAULTS.
#define CO_OBJ_DICT_DEFAULTS(list) \
  { CO_DEFAULTS_KEY, CO_TDEFAULTS, (CO_DATA)(&(list)[0]) }

/// Key of an end mark with a type. An end mark with key 0 has no type: its other members are not read.
#define CO_DEFAULTS_KEY 0xFFu

/// Type of the end mark CO_OBJ_DICT_DEFAULTS(). The application may use its own type in an end mark with the key
/// CO_DEFAULTS_KEY: the Reset function is then called as Reset(end mark, node, CO_RESET_NODE or CO_RESET_COM).
/// CONodeInit() calls it with CO_RESET_NODE.
extern const CO_OBJ_TYPE COTDefaults;
#define CO_TDEFAULTS ((const CO_OBJ_TYPE*)&COTDefaults)  ///< type of the end mark
/// \}

/// Finds an entry by index and sub-index (CO_DEV(); flags of \a key are ignored).
/// \retval null  there is no such entry, or \a cod is null
CO_OBJ* CODictFind(CO_DICT* cod, uint32_t key);

/// \name Values of one, two and four bytes
/// Find the entry and read or write its value in the byte order of the CPU; a stream is accessed from its beginning.
/// Access rights of the network are not checked. They return the result of the type function, or:
/// \retval CO_ERR_BAD_ARG        an argument is null
/// \retval CO_ERR_OBJ_NOT_FOUND  there is no such entry
/// \retval CO_ERR_OBJ_SIZE       the object has another length
/// \retval CO_ERR_OBJ_ACC        the type has no Read or Write function
/// \{
CO_ERR CODictRdByte(CO_DICT* cod, uint32_t key, uint8_t* val);   ///< reads 8 bits
CO_ERR CODictRdWord(CO_DICT* cod, uint32_t key, uint16_t* val);  ///< reads 16 bits
CO_ERR CODictRdLong(CO_DICT* cod, uint32_t key, uint32_t* val);  ///< reads 32 bits
CO_ERR CODictWrByte(CO_DICT* cod, uint32_t key, uint8_t val);    ///< writes 8 bits
CO_ERR CODictWrWord(CO_DICT* cod, uint32_t key, uint16_t val);   ///< writes 16 bits
CO_ERR CODictWrLong(CO_DICT* cod, uint32_t key, uint32_t val);   ///< writes 32 bits
/// \}

/// Finds a stream or value and reads \a len bytes of it from its beginning into \a buf. A value is in the byte order of
/// the CPU. A stream that is shorter than \a len leaves the rest of \a buf unchanged. Returns the result of the type
/// function, or:
/// \retval CO_ERR_BAD_ARG        an argument is null, or a value has another length
/// \retval CO_ERR_OBJ_NOT_FOUND  there is no such entry
/// \retval CO_ERR_OBJ_ACC        the type has no Read function
CO_ERR CODictRdBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len);

/// Finds a stream or value and writes \a len bytes from \a buf to it, from its beginning. Returns the result of the
/// type function, or:
/// \retval CO_ERR_BAD_ARG        an argument is null, or a value has another length
/// \retval CO_ERR_OBJ_NOT_FOUND  there is no such entry
/// \retval CO_ERR_OBJ_ACC        the type has no Write function
CO_ERR CODictWrBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len);

/// Makes \a root the table of the dictionary. The table has \a max entries, or ends at the first entry with key 0; an
/// empty table is allowed. Call it again in the loop, or in an action of a timer of the application, after entries were
/// added to or removed from a table in RAM. The Init functions of added entries are not called: call COObjInit(). An
/// SDO transfer whose entry was moved is aborted at its next frame. The caller owns the table, which must live as long
/// as the node.
///
/// \retval 0…32767  number of entries (32767 if there are more)
/// \retval -1       an argument is null, \a max is 0, or the table has a structural fault, which CODictGetFault()
///                  returns: lookups then find no entry; or the call was in a callback or type function (node error
///                  CO_ERR_DICT_BUSY): the table is unchanged
int16_t CODictInit(CO_DICT* cod, struct CO_NODE_T* node, CO_OBJ* root, uint16_t max);

/// Calls the Init function of every entry, in the order of the table.
/// \retval CO_ERR_NONE     all Init functions succeeded
/// \retval CO_ERR_BAD_ARG  an argument is null
/// \retval other           last error of an Init function
CO_ERR CODictObjInit(CO_DICT* cod, struct CO_NODE_T* node);

/// Returns the first fault that CODictInit() or the Init function of a basic type has found; a fault that stops the
/// node has precedence. \a key (may be null) receives the key of the entry. May also be called after CONodeInit() has
/// failed with CO_ERR_DICT_INIT.
/// \retval CO_DICT_OK  no fault. With USE_DICT_CHECK 0 this function itself checks the order of the table, nothing else
/// \retval other       see CO_DICT_FAULT_LIST
CO_DICT_FAULT CODictGetFault(const CO_DICT* cod, uint32_t* key);

/// Returns the name of a fault, for messages: "CO_DICT_NO_TYPE"; "unknown fault" for other numbers. Never null. The
/// names are linked only into a program that calls this function; likewise the texts of CODictFaultText().
const char* CODictFaultName(CO_DICT_FAULT fault);

/// Returns the meaning of a fault as in CO_DICT_FAULT_LIST: one line without a full stop; "unknown fault" for other
/// numbers. Never null.
const char* CODictFaultText(CO_DICT_FAULT fault);

/// \name 1002h, manufacturer status register
/// \{

/// Sets the manufacturer status register, 1002h (a CO_TUNSIGNED32, not flag D), to \a status. A change triggers the
/// event-driven TPDOs that map it, with or without flag A. [CiA 301, 7.5.2.3]
/// \retval CO_ERR_NONE           1002h has the value
/// \retval CO_ERR_BAD_ARG        \a node is null or was never initialised
/// \retval CO_ERR_OBJ_NOT_FOUND  there is no 1002h
/// \retval CO_ERR_OBJ_ACC        1002h holds its value in the table (flag D), or is in read-only memory
/// \retval CO_ERR_OBJ_SIZE       1002h is not a number of 32 bits
CO_ERR CONodeSetStatus(struct CO_NODE_T* node, uint32_t status);

/// Returns the manufacturer status register, 1002h; 0 if it cannot be read, or \a node is null.
uint32_t CONodeGetStatus(struct CO_NODE_T* node);
/// \}

#ifdef __cplusplus
}
#endif

#endif
