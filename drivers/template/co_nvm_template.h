// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_template.h
/// Template of a driver for non-volatile memory: copy both files, rename everything called "template", fill in what the
/// comments ask for. As it is, it compiles, and stores and finds nothing. docs/porting.md goes through it step by step,
/// and tests/driver_check checks what has become of it.
///
/// This table is for memory that is written byte by byte without being erased before (EEPROM, FRAM). Flash, and the
/// storage that survives a power cut in the middle of writing, need CO_IF_NVM_DRV_EX: the same functions with a first
/// parameter void *ctx, and with Shape (capacity, program size, erase size) and Erase.
/// A node that stores nothing needs no driver: CO_IF_DRV.Nvm may be null.
#ifndef CO_NVM_TEMPLATE_H_
#define CO_NVM_TEMPLATE_H_

#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_IF_NVM_DRV TemplateNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
