// SPDX-License-Identifier: Apache-2.0
/// \file co_para.h
/// Parameter groups: memory that is stored in and loaded from non-volatile memory as a unit. [CiA
/// 301, 7.5.2.13, 7.5.2.14]
///
///     static struct { uint32_t Limit; uint16_t Rate; } Memory;
///     static const struct … Defaults = { 1000, 5 };
///     static const CO_PARA Group = { 0, sizeof(Memory), (uint8_t *)&Memory, (uint8_t *)&Defaults,
///                                    CO_RESET_NODE, NULL, CO_PARA___E };
///     { CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Group) },
///     { CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&Group) },
///
/// The network stores groups by writing "save" (65766173h) to 1010h and restores their default values by writing "load"
/// (64616F6Ch) to 1011h. If sub-index 1 is the only one, it is a group. If there are others (sub-index 0 > 1),
/// sub-index 1 selects all of them: 2 = communication, 3 = application, 4…127 = manufacturer-specific; it then
/// refers to a CO_PARA whose memory is neither stored nor loaded: { 0, 0, NULL, NULL, CO_RESET_NODE, NULL, CO_PARA___E
/// }. A group is loaded, before its values are used, by CONodeInit() and by the NMT reset of its Type: CO_RESET_COM by
/// both resets, CO_RESET_NODE by reset node (and its first ComSize bytes by both). "load" takes effect at that time,
/// too, also if the power was off in between. If nothing was stored, and after "load", a group gets its Default values;
/// without Default its memory is unchanged.
///
/// Stores are atomic (power-fail safe) with a driver that has a Shape function (CO_IF_NVM_DRV_EX): a group holds after
/// a power failure, at whatever moment, exactly its old or exactly its new values. It occupies CO_PARA_SPACE() bytes
/// from Offset on. The checksum of its record covers its sub-index of 1010h, Offset, Size and the version of its layout
/// (Version, or CO_PARA_VERSION() in Value): the record of another group, place, size or version is not loaded. See
/// docs/storage.md. With any other driver the bytes of a group are stored unchanged at Offset, and FFh everywhere means
/// that nothing was stored.
///
/// Stored groups must not overlap in the non-volatile memory. One that overlaps a group with a lower sub-index of 1010h
/// is neither loaded nor stored; it holds its Default values, and the node's error is CO_ERR_PARA_OVERLAP. The
/// variables of groups may overlap.
///
/// The budget limits the stores that the bus can cause: CO_PARA_BUDGET stores in a row and one more each minute
/// (co_cfg.h). It is full after CONodeInit(); NMT resets do not refill it. It counts every write to 1010h or 1011h that
/// changes the memory, also by CODictWrLong() and OD_storeGroup(), every LSS store, and each round of autonomous
/// stores. COParaStore() and COParaRestore() are not limited: the application decides how often it calls them.
///
/// A string (co_string.h) is stored completely only if the group contains both its bytes and its Size.
///
/// Context: the loop. Functions return when the memory has been read or written.
#ifndef CO_PARA_H_
#define CO_PARA_H_

#include "co_nmt.h"
#include "co_obj.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

/// Memory of a parameter group. In C++ it is a class of the same size and layout (lexican/detail/address.hpp) that can
/// be initialised with the address of any object and is used like a uint8_t *; define CO_DATA_INTEGER to get the plain
/// pointer there, too. In C write (uint8_t *)&structure: compilers warn about, or refuse, the address of a structure
/// without the cast.
#if defined(__cplusplus) && !defined(CO_DATA_INTEGER)
#include "lexican/detail/address.hpp"
typedef co::Address CO_PARA_MEM;
#else
typedef uint8_t* CO_PARA_MEM;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// \name CO_PARA.Value
/// \{
#define CO_PARA____ 0u  ///< not stored; with a driver that has a Shape function not loaded, either
#define CO_PARA___E 1u  ///< stored on command
#define CO_PARA__A_ 2u  ///< stored autonomously; only with a driver that has a Shape function
#define CO_PARA__AE 3u  ///< both
/// Layout version \a n, 0…FFFFFFh, to be added to Value. Values stored with another version are not loaded.
#define CO_PARA_VERSION(n) ((uint32_t)(n) << 8)
/// \}

/// Returns the bytes of memory that a group of \a size bytes occupies with a driver that has a Shape function. \a unit:
/// the larger of its ProgramSize and EraseSize; \a program: its ProgramSize. Offset must be a multiple of \a unit.
#define CO_PARA_SPACE(size, unit, program) \
  (2u * CO_PARA_ROUND_UP(CO_PARA_ROUND_UP(20u, program) + CO_PARA_ROUND_UP((uint32_t)(size), program), unit))
#define CO_PARA_ROUND_UP(n, unit) (((n) + (unit)-1u) / (unit) * (unit))  ///< \a n rounded up to a multiple of \a unit

/// A parameter group, constant or in RAM. It must live as long as the node.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): an aggregate, initialised by position
typedef struct CO_PARA_T {
  uint32_t Offset;           ///< start address in the non-volatile memory
  uint32_t Size;             ///< bytes
  CO_PARA_MEM Start;         ///< memory of the parameters
  CO_PARA_MEM Default;       ///< default values, or null
  enum CO_NMT_RESET_T Type;  ///< NMT reset that loads the group
  void* Ident;               ///< for the application; a name or null if it calls OD_findStorageGroup()
  uint32_t Value;            ///< CO_PARA_…, plus CO_PARA_VERSION()
  /// Number of bytes from Start on that hold objects of the communication profile (1000h…1FFFh), in a group with Type
  /// CO_RESET_NODE. Reset communication loads them, or copies their Default, without calling COParaDefault().
#ifdef __cplusplus
  uint32_t ComSize = 0;
  uint32_t Version = 0;  ///< of the layout; 0: the one of CO_PARA_VERSION() in Value
#else
  uint32_t ComSize;
  uint32_t Version;  ///< of the layout; 0: the one of CO_PARA_VERSION() in Value
#endif
} CO_PARA;

/// Functions of CO_TPARA_STORE and CO_TPARA_RESTORE, for 1010h and 1011h: sub-index 0 is an UNSIGNED8, the others refer
/// to a CO_PARA. Reading 1010h returns bits 0 and 1 of CO_PARA.Value (stored on command, autonomously), reading 1011h
/// bit 0. Abort codes:
/// - 0800 0020h: the value is neither "save" nor "load", or the group is not stored on command;
/// - 0606 0000h: the memory does not hold the values and the old ones stay, or the group overlaps another;
/// - 0800 0022h: the budget of stores is used up (CO_PARA_BUDGET).
extern const CO_OBJ_TYPE COTParaStore CO_NEEDS(USE_PARA);
extern const CO_OBJ_TYPE COTParaRestore CO_NEEDS(USE_PARA);  ///< functions of CO_TPARA_RESTORE, see COTParaStore

/// Type of 1020h, sub-index 1 and 2 (date and time of the configuration): an UNSIGNED32 that becomes 0 when the network
/// writes an object of a parameter group, or any string or domain. [CiA 301, 7.5.2.23]
extern const CO_OBJ_TYPE COTVerifyConfig CO_NEEDS(USE_PARA);

#define CO_TPARA_STORE ((const CO_OBJ_TYPE*)&COTParaStore)        ///< type of 1010h, all sub-indices
#define CO_TPARA_RESTORE ((const CO_OBJ_TYPE*)&COTParaRestore)    ///< type of 1011h, all sub-indices
#define CO_TVERIFY_CONFIG ((const CO_OBJ_TYPE*)&COTVerifyConfig)  ///< type of 1020h, sub 1 and 2

/// Stores the group, unless its values are already stored, then executes a reset that was requested meanwhile. Ignores
/// a group that is not stored on command (CO_PARA___E). Not limited by CO_PARA_BUDGET, except in COLssStore().
/// \retval CO_ERR_NONE          the values are stored, or the group is ignored
/// \retval CO_ERR_PARA_STORE    Offset and Size do not fit the memory
/// \retval CO_ERR_PARA_OVERLAP  the group overlaps one with a lower sub-index of 1010h
/// \retval CO_ERR_IF_NVM_WRITE  the memory does not hold the values; the old ones stay
/// \retval CO_ERR_OBJ_STATE     in COLssStore(), which the LSS master has caused: the budget of stores is used up
/// \retval CO_ERR_BAD_ARG       an argument is null
CO_ERR COParaStore(const CO_PARA* pg, struct CO_NODE_T* node) CO_NEEDS(USE_PARA);

/// Restores the default values of the group at the reset of its Type.
/// \retval CO_ERR_NONE          the values will be restored, or the group is ignored
/// \retval CO_ERR_PARA_STORE    Offset and Size do not fit the memory
/// \retval CO_ERR_PARA_OVERLAP  the group overlaps one with a lower sub-index of 1010h
/// \retval CO_ERR_IF_NVM_WRITE  the memory could not be changed; the stored values stay
/// \retval CO_ERR_OBJ_STATE     in COLssStore(), which the LSS master has caused: the budget of stores is used up
/// \retval CO_ERR_BAD_ARG       an argument is null
CO_ERR COParaRestore(const CO_PARA* pg, struct CO_NODE_T* node) CO_NEEDS(USE_PARA);

/// Loads all groups of 1010h with this \a type, then executes a reset that a callback has requested meanwhile. An
/// autonomous group that has changed, and whose store is delayed by the budget, keeps its values.
/// Returns the last error, which is also the node's.
/// \retval CO_ERR_NONE          all groups of this type are loaded
/// \retval CO_ERR_PARA_LOAD     a record is damaged, of another group or layout, or unreadable; COParaLost() was called
/// \retval CO_ERR_PARA_STORE    a group does not fit the memory
/// \retval CO_ERR_PARA_OVERLAP  a group overlaps one with a lower sub-index
/// \retval CO_ERR_PARA_RESTORE  COParaDefault() has failed
/// \retval CO_ERR_BAD_ARG       \a node is null
CO_ERR CONodeParaLoad(struct CO_NODE_T* node, enum CO_NMT_RESET_T type) CO_NEEDS(USE_PARA);

/// \name Callbacks of the application (see co_nmt.h on how to define them)
/// \{

/// Called when the default values of a group are restored ("load"), after Default (if any) was copied. The callback
/// sets values that are not in Default. Called by every load of the group, also at later power-ons, until the group is
/// stored again; with a driver without Shape function, not after the power was off. \a pg is the group of the table,
/// which may be constant.
/// \retval 0      success
/// \retval other  failure: the node's error is CO_ERR_PARA_RESTORE
int16_t COParaDefault(struct CO_PARA_T* pg);

/// Called when the stored record of a group is invalid; the group now holds its default values. If an older record is
/// loaded instead of a damaged one, CO_CALLBACKS.ParaRecovered is called instead. docs/storage.md shows how the
/// application reports both to the network (EMCY 6300h).
void COParaLost(struct CO_NODE_T* node, const CO_PARA* pg);
/// \}

#ifdef __cplusplus
}
#endif

#endif
