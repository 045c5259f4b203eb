// SPDX-License-Identifier: Apache-2.0
/// \file co_para.h
/// Parameter groups: memory that is stored in and loaded from non-volatile memory as a whole. [301:7.5.2.13, 7.5.2.14]
///
///     static struct { uint32_t Limit; uint16_t Rate; } Memory;
///     static const struct … Defaults = { 1000, 5 };
///     static const CO_PARA Group = { 0, sizeof(Memory), (uint8_t *)&Memory, (uint8_t *)&Defaults,
///                                    CO_RESET_NODE, NULL, CO_PARA___E };
///     { CO_KEY(0x1010, 1, CO_OBJ_____RW), CO_TPARA_STORE, (CO_DATA)(&Group) },
///     { CO_KEY(0x1011, 1, CO_OBJ_____RW), CO_TPARA_RESTORE, (CO_DATA)(&Group) },
///
/// The network stores groups by "save" (65766173h) to 1010h and asks for their default values by "load" (64616F6Ch) to
/// 1011h. Sub-index 1 alone is a group; with others behind it (sub-index 0 > 1) it stands for all of them: 2 =
/// communication, 3 = application, 4…127 = the manufacturer's. It names a CO_PARA then, too, whose memory is neither
/// stored nor loaded: { 0, 0, NULL, NULL, CO_RESET_NODE, NULL, CO_PARA___E }. A group is loaded, before anything uses
/// its values, by CONodeInit() and by the NMT reset of its Type: CO_RESET_COM by both resets, CO_RESET_NODE by reset
/// node (and its first ComSize bytes by both). "load" takes effect then, too, also after the power was off in between.
/// Where nothing was stored, and after "load", a group gets its Default values; without any its memory stays as it is.
///
/// What is stored is never torn: with a driver that tells the shape of the memory (CO_IF_NVM_DRV_EX.Shape) a group
/// holds after a power failure, at whatever moment, exactly its old or exactly its new values. It takes CO_PARA_SPACE()
/// bytes from Offset on. Bits 31…8 of Value are the version of its layout (CO_PARA_VERSION()): values of another
/// version or size are not loaded. docs/storage.md shows how. With a driver that tells no shape the bytes of a group
/// lie at Offset as they are, and FFh everywhere means that nothing was stored.
///
/// Groups must not overlap: nothing checks that. Of a string (co_string.h) a group holds the bytes, and its Size only
/// if that lies in the group, too.
///
/// Context: the loop. Functions return when the memory has been read or written.
#ifndef CO_PARA_H_
#define CO_PARA_H_

#include "co_nmt.h"
#include "co_obj.h"
#include "co_types.h"

#if defined(__cplusplus) && !defined(CO_DATA_INTEGER)
#include "co/address.hpp"
typedef co::Address CO_PARA_MEM;
#else
/// Memory of a parameter group. In C++ it is a class of the same size and layout (co/address.hpp) that can be
/// initialised with the address of any object and is used like a uint8_t *; define CO_DATA_INTEGER to get the plain
/// pointer there, too. In C write (uint8_t *)&structure: compilers warn about, or refuse, the address of a structure
/// without the cast.
typedef uint8_t* CO_PARA_MEM;
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// \name CO_PARA.Value
/// \{
#define CO_PARA____ 0u  ///< not stored
#define CO_PARA___E 1u  ///< stored on command
#define CO_PARA__A_ 2u  ///< stored autonomously; only with a driver that tells the shape of its memory
#define CO_PARA__AE 3u  ///< both
/// Version \a n of the layout, 0…FFFFFFh, to be added. Values that were stored under another are not loaded.
#define CO_PARA_VERSION(n) ((uint32_t)(n) << 8)
/// \}

/// Bytes of memory that a group of \a size bytes takes, with a driver that tells the shape of the memory. \a unit: the
/// larger of its ProgramSize and EraseSize. Offset is a multiple of \a unit.
#define CO_PARA_SPACE(size, unit, program) \
  (2u * CO_PARA_ROUND_UP(CO_PARA_ROUND_UP(20u, program) + CO_PARA_ROUND_UP((uint32_t)(size), program), unit))
#define CO_PARA_ROUND_UP(n, unit) (((n) + (unit)-1u) / (unit) * (unit))

typedef struct CO_PARA_T {
  uint32_t Offset;           ///< start address in the non-volatile memory
  uint32_t Size;             ///< bytes
  CO_PARA_MEM Start;         ///< the parameters
  CO_PARA_MEM Default;       ///< their default values, or null
  enum CO_NMT_RESET_T Type;  ///< the reset that loads them
  void* Ident;               ///< for the application; where it calls OD_findStorageGroup(), a name or null
  uint32_t Value;            ///< CO_PARA_…, plus CO_PARA_VERSION()
  /// Of a group with Type CO_RESET_NODE: bytes, from Start on, that hold objects of the communication profile
  /// (1000h…1FFFh). Reset communication loads them, or copies their Default; COParaDefault() is not called for it.
#ifdef __cplusplus
  uint32_t ComSize = 0;
#else
  uint32_t ComSize;
#endif
} CO_PARA;

/// Types of 1010h and 1011h: sub-index 0 as an UNSIGNED8, the others name a CO_PARA. Reading 1010h tells CO_PARA.Value
/// (bit 0: stored on command, bit 1: autonomously), reading 1011h bit 0. Aborts: 0800 0020h another word, or a group
/// that is not stored on command; 0606 0000h the memory does not hold the values, the old ones stay.
extern const CO_OBJ_TYPE COTParaStore;
extern const CO_OBJ_TYPE COTParaRestore;

/// Type of 1020h, sub-index 1 and 2 (date and time of the configuration): an UNSIGNED32 that becomes 0 when the network
/// writes an object of a parameter group, or any string or domain. [301:7.5.2.23]
extern const CO_OBJ_TYPE COTVerifyConfig;

#define CO_TPARA_STORE ((const CO_OBJ_TYPE*)&COTParaStore)
#define CO_TPARA_RESTORE ((const CO_OBJ_TYPE*)&COTParaRestore)
#define CO_TVERIFY_CONFIG ((const CO_OBJ_TYPE*)&COTVerifyConfig)

/// Stores the group; one that is not stored on command (CO_PARA___E) is left alone. CO_ERR_NONE: it is safe, or was so
/// before. CO_ERR_PARA_STORE: Offset and Size do not fit the memory; CO_ERR_IF_NVM_WRITE: the memory does not hold the
/// values; the old ones stay. CO_ERR_BAD_ARG: an argument is null.
CO_ERR COParaStore(const CO_PARA* pg, struct CO_NODE_T* node);

/// The group gets its default values at the reset of its Type. Errors as COParaStore().
CO_ERR COParaRestore(const CO_PARA* pg, struct CO_NODE_T* node);

/// Loads all groups of 1010h of this \a type. Returns the last error, which is also the node's: CO_ERR_PARA_LOAD: what
/// is stored is damaged or foreign, or cannot be read (COParaLost() was called); CO_ERR_PARA_STORE: a group does not
/// fit the memory; CO_ERR_PARA_RESTORE: COParaDefault() has failed. CO_ERR_BAD_ARG: \a node is null.
CO_ERR CONodeParaLoad(struct CO_NODE_T* node, enum CO_NMT_RESET_T type);

/// \name Callbacks of the application (see co_nmt.h on how to define them)
/// \{

/// The group's default values were asked for ("load"); Default, if there is any, has been copied. Put them in place.
/// Called by every load of the group, also at later power-ons, until it is stored again; with a driver that tells no
/// shape, not after the power was off. \a pg is the group of the table, which may be constant. Returns 0; anything
/// else: CO_ERR_PARA_RESTORE.
int16_t COParaDefault(struct CO_PARA_T* pg);

/// What is stored for a group cannot be used; it has its default values now. An application that wants the network to
/// know raises an error of its own (COEmcySet(), code 6300h).
void COParaLost(struct CO_NODE_T* node, const CO_PARA* pg);
/// \}

#ifdef __cplusplus
}
#endif

#endif
