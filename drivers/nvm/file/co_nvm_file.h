// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_file.h
/// Driver for a parameter memory in a file, for C programs; C++ programs may use file_nvm.hpp instead.
///
///     CO_FILE_NVM *memory = COFileNvmNew();
///     if (!COFileNvmOpen(memory, "/var/lib/node/parameters", 4096)) { puts(COFileNvmError(memory)); }
///     ext.Nvm = &COFileNvmDriver;  ext.NvmCtx = memory;             /* CO_NODE_EXT */
///
/// Write returns after the data has reached the storage device (fdatasync).
///
/// Context: one thread. Owner: the caller; it must outlive the node. One process per file: the file is not locked.
#ifndef CO_NVM_FILE_H_
#define CO_NVM_FILE_H_

#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A memory; the members are private.
typedef struct CO_FILE_NVM_T CO_FILE_NVM;

/// Returns a memory without file; COFileNvmFree() releases it. Ends the program if there is no memory.
CO_FILE_NVM* COFileNvmNew(void);
/// Closes the file and releases \a memory, which may be null. The node must not use it any more.
void COFileNvmFree(CO_FILE_NVM* memory);

/// Opens the file \a path, or creates it, and fills it with FFh up to \a capacity bytes. A longer file keeps the bytes
/// beyond the capacity. A file that was open is closed.
/// \retval true   the file is open
/// \retval false  it cannot be used; COFileNvmError() returns the reason
bool COFileNvmOpen(CO_FILE_NVM* memory, const char* path, uint32_t capacity);

/// Returns the last error in words, "" if there was none. The text is valid until the next call with \a memory.
const char* COFileNvmError(const CO_FILE_NVM* memory);

/// The driver; its context is a CO_FILE_NVM.
extern const CO_IF_NVM_DRV_EX COFileNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
