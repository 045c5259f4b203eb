// SPDX-License-Identifier: Apache-2.0
#include "co_nvm_file.h"

#include "file_nvm.hpp"

namespace {

co::FileNvm* of(CO_FILE_NVM* memory) { return reinterpret_cast<co::FileNvm*>(memory); }
const co::FileNvm* of(const CO_FILE_NVM* memory) { return reinterpret_cast<const co::FileNvm*>(memory); }

}  // namespace

extern "C" {

CO_FILE_NVM* COFileNvmNew(void) { return reinterpret_cast<CO_FILE_NVM*>(new co::FileNvm); }

void COFileNvmFree(CO_FILE_NVM* memory) { delete of(memory); }

bool COFileNvmOpen(CO_FILE_NVM* memory, const char* path, uint32_t capacity) {
  return of(memory)->open(path, capacity);
}

const char* COFileNvmError(const CO_FILE_NVM* memory) { return of(memory)->error().c_str(); }

}  // extern "C"
