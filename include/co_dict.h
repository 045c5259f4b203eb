// SPDX-License-Identifier: Apache-2.0
/// \file co_dict.h
/// The object dictionary: a table of CO_OBJ, sorted by index and sub-index, and its look-up. [301:7.4]
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

/// Faults of a dictionary: name, number, meaning. CO_OD_CHECK() (co/dictionary.hpp) refuses all of them at compile
/// time. At run time a fault stops the node (CO_INVALID, CO_ERR_DICT_INIT) only if it breaks the search or memory
/// safety; any other concerns its entry alone: the node runs, its error is CO_ERR_OBJ_INIT, and CODictGetFault() names
/// the entry. Without USE_DICT_CHECK nothing is checked at run time. CO_DICT_DIRECT_ADDRESS, CO_DICT_DIRECT_CONST and
/// CO_DICT_NOT_MAPPABLE are found at compile time only.
///
/// CO_DICT_NO_DATA: SDO transfers of the entry are aborted with 0800 0020h, functions of the API return an error, and a
/// PDO that maps it does not exist. That holds without USE_DICT_CHECK, too. CO_DICT_RESERVED_INDEX of a static data
/// type lets the node run.
// clang-format off
#define CO_DICT_FAULT_LIST(X)                                                                                          \
  X(CO_DICT_NOT_ASCENDING, 1, "the key is not greater than the key before it: sort the table by index and sub-index")  \
  X(CO_DICT_NO_TYPE, 2, "Type is null, or an OD_TYPE in front of an OD_TYPE (co_od.h)")                                \
  X(CO_DICT_NO_DATA, 3, "Data is null, but the type needs the address of a variable; the node runs")                   \
  X(CO_DICT_DIRECT_TYPE, 4, "flag D with a type that needs an address, or that does not fit into a pointer")           \
  X(CO_DICT_NODEID_TYPE, 5, "flag N with a type that has no values relative to the node-ID; the node runs")            \
  X(CO_DICT_WRONG_PLACE, 6, "this object has another type, see docs/cookbook.md")                                      \
  X(CO_DICT_NOT_CONFIGURED, 7, "the number of the service is beyond the configuration (CO_SSDO_N, CO_TPDO_N, ...)")    \
  X(CO_DICT_DIRECT_ADDRESS, 8, "flag D with an address, or no flag D with a value")                                    \
  X(CO_DICT_DIRECT_CONST, 9, "flags D and W in a table in read-only memory")                                           \
  X(CO_DICT_RESERVED_INDEX, 10, "index 0000h; or a static data type (index 0001h to 001Fh) with data")                 \
  X(CO_DICT_NOT_MAPPABLE, 11, "a PDO of the table maps this entry, which has no flag P")                               \
  X(CO_DICT_PARA_OVERLAP, 12, "the parameter group overlaps one with a lower sub-index; the node runs without it")
// clang-format on

/// \cond internal
#define CO_DICT_FAULT_ENUMERATOR(name, number, text) name = (number),
#define CO_DICT_FAULT_NUMBERS(name, number, text) number,
#define CO_DICT_FAULT_NAME_AND_NUL(name, number, text) #name "\0"
#define CO_DICT_FAULT_TEXT_AND_NUL(name, number, text) text "\0"
/// \endcond

typedef enum CO_DICT_FAULT_T {
  CO_DICT_OK = 0,  ///< no fault
  CO_DICT_FAULT_LIST(CO_DICT_FAULT_ENUMERATOR)
} CO_DICT_FAULT;

typedef struct CO_DICT_T {
  struct CO_OBJ_T* Root;  ///< first entry
#if USE_FAST_PATHS
  struct CO_OBJ_T* Split;  ///< first entry of the upper half of a search
  struct CO_OBJ_T* Last;   ///< last entry
  struct CO_OBJ_T*
      Next;  ///< entry behind the one found last: the next sub-index is found without a search; null: no entries
#endif
  struct CO_OBJ_T* End;  ///< end mark with a type (CO_OBJ_DICT_DEFAULTS()), or null
  uint16_t Num;          ///< entries in use
#if USE_FAST_PATHS
  uint8_t Steps;  ///< halvings that a search needs in either half
#endif
#if USE_DICT_CHECK
  uint8_t Fault;      ///< CO_DICT_FAULT of CODictInit() or of a type's Init function
  uint32_t FaultKey;  ///< key of the entry with that fault
#endif
  struct CO_NODE_T* Node;  ///< owner
} CO_DICT;

/// \name Power-on values [301:7.3.2.2.1]
/// Variables that no parameter group stores (co_para.h) have their default values after CONodeInit() and after NMT
/// resets if the end mark of the table names them:
///
///     static struct { uint32_t SyncId; uint16_t Heartbeat; } Com;   // 1005h, 1017h
///     static struct { int16_t Setpoint; } App;                      // 2100h
///     static const struct … ComDefault = {0x80, 1000};
///     static const CO_DEFAULTS Defaults[] = {CO_DEFAULTS_OF(Com, ComDefault, CO_RESET_COM),
///                                            CO_DEFAULTS_ZERO(App, CO_RESET_NODE), CO_DEFAULTS_END};
///     …
///     CO_OBJ_DICT_DEFAULTS(Defaults)};   // in place of CO_OBJ_DICT_ENDMARK
///
/// The values are copied before parameter groups are loaded and before the Init functions of the entries run. So every
/// service uses them. The end mark must be among the entries that DictLen counts. Memory of any kind can be named: a
/// string is reset completely if its CO_OBJ_STR_RW and its bytes are. Not to be named: 1001h and 1003h, which the stack
/// writes, and variables of a group that is stored autonomously (CO_PARA__A_): a reset would store their default values
/// over changes that are not stored yet.
/// \{

/// Variables that get their default values together.
typedef struct CO_DEFAULTS_T {
  void* Start;               ///< the variables
  const void* Default;       ///< their default values, or null: all bytes are 0
  uint32_t Size;             ///< bytes; 0 ends the list
  enum CO_NMT_RESET_T Type;  ///< CO_RESET_COM: reset by both NMT resets; CO_RESET_NODE: by reset node
} CO_DEFAULTS;

#define CO_DEFAULTS_OF(variables, defaults, type) \
  { &(variables), &(defaults), sizeof(variables), (type) }
#define CO_DEFAULTS_ZERO(variables, type) \
  { &(variables), 0, sizeof(variables), (type) }
#define CO_DEFAULTS_END \
  { 0, 0, 0, CO_RESET_INVALID }

/// End mark of a table: \a list is an array of CO_DEFAULTS.
#define CO_OBJ_DICT_DEFAULTS(list) \
  { CO_DEFAULTS_KEY, CO_TDEFAULTS, (CO_DATA)(&(list)[0]) }

/// Key of that end mark. With the key 0 an end mark has no type: its other members are not read.
#define CO_DEFAULTS_KEY 0xFFu

/// Type of that end mark. An end mark with the key CO_DEFAULTS_KEY may have a type of the application in its place:
/// Reset(end mark, node, CO_RESET_NODE or CO_RESET_COM) is called then. CONodeInit() calls it with
/// CO_RESET_NODE.
extern const CO_OBJ_TYPE COTDefaults;
#define CO_TDEFAULTS ((const CO_OBJ_TYPE*)&COTDefaults)
/// \}

/// Finds an entry by index and sub-index (CO_DEV(); flags of \a key are ignored).
/// Returns the entry; null if there is none or \a cod is null.
CO_OBJ* CODictFind(CO_DICT* cod, uint32_t key);

/// \name Values of one, two and four bytes
/// Find the entry and read or write it in the byte order of the CPU, without the network's access rights; a stream from
/// its beginning.
/// CO_ERR_BAD_ARG: an argument is null; CO_ERR_OBJ_NOT_FOUND: no such entry; CO_ERR_OBJ_SIZE: the object has another
/// length; CO_ERR_OBJ_ACC: the type cannot be read or written; else what the type function returns.
/// \{
CO_ERR CODictRdByte(CO_DICT* cod, uint32_t key, uint8_t* val);
CO_ERR CODictRdWord(CO_DICT* cod, uint32_t key, uint16_t* val);
CO_ERR CODictRdLong(CO_DICT* cod, uint32_t key, uint32_t* val);
CO_ERR CODictWrByte(CO_DICT* cod, uint32_t key, uint8_t val);
CO_ERR CODictWrWord(CO_DICT* cod, uint32_t key, uint16_t val);
CO_ERR CODictWrLong(CO_DICT* cod, uint32_t key, uint32_t val);
/// \}

/// Finds a stream or value and reads \a len bytes of it from its beginning into \a buf (any length; a stream shorter
/// than \a len leaves the rest of \a buf as it is). A value lies there in the byte order of the CPU. Errors as
/// CODictRdByte(), except CO_ERR_OBJ_SIZE: a value of another length answers CO_ERR_BAD_ARG.
CO_ERR CODictRdBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len);

/// Finds a stream or value and writes \a len bytes from \a buf to it, from its beginning. Errors as CODictRdBuffer().
CO_ERR CODictWrBuffer(CO_DICT* cod, uint32_t key, uint8_t* buf, uint32_t len);

/// Takes the table \a root of \a max entries, which ends there or at the first entry with key 0, into use. CONodeInit()
/// does it; call it again (in the loop context) after entries were added to or taken from a table in RAM.
/// Init functions of added entries are not run: COObjInit() does that. An SDO transfer whose entry was moved is aborted
/// at its next frame. The table stays the caller's and must live as long as the node. An empty table is legal. Not to
/// be called from a type function.
///
/// Returns the number of entries (32767 if there are more); -1: an argument is null, \a max is 0, or the table has a
/// structural fault, which CODictGetFault() names. Nothing is found then.
int16_t CODictInit(CO_DICT* cod, struct CO_NODE_T* node, CO_OBJ* root, uint16_t max);

/// Runs the Init function of every entry, from the first to the last. Returns the last error, or CO_ERR_NONE.
CO_ERR CODictObjInit(CO_DICT* cod, struct CO_NODE_T* node);

/// Returns the first fault that CODictInit() or the Init function of a basic type has found; a fault that stops the
/// node comes before all others. \a key (may be null) receives the key of the entry. Also legal after a CONodeInit()
/// that ended with CO_ERR_DICT_INIT. Without USE_DICT_CHECK: CO_DICT_OK.
CO_DICT_FAULT CODictGetFault(const CO_DICT* cod, uint32_t* key);

/// Returns the name of a fault, for messages: "CO_DICT_NO_TYPE"; "unknown fault" for other numbers. Never null. The
/// names are in the program only if it calls this function; likewise the texts of CODictFaultText().
const char* CODictFaultName(CO_DICT_FAULT fault);

/// Returns the meaning of a fault, as CO_DICT_FAULT_LIST has it: one line without a full stop; "unknown fault" for
/// other numbers. Never null.
const char* CODictFaultText(CO_DICT_FAULT fault);

#ifdef __cplusplus
}
#endif

#endif
