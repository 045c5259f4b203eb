// SPDX-License-Identifier: Apache-2.0
/// \file co_nvm_template.h
/// Template of a driver for non-volatile memory: copy both files, rename everything called "template", and implement
/// the parts marked with "Here". Unchanged, it compiles, but stores nothing and returns no data. docs/porting.md
/// describes each step, and tests/drivers/driver_check tests the finished driver.
///
/// This table is for memory that can be written byte by byte without erasing (EEPROM, FRAM). Flash, and storage that
/// survives a power failure during a write, need CO_IF_NVM_DRV_EX: the same functions with a first parameter void *ctx,
/// and with Shape (capacity, program size, erase size) and Erase.
/// A node without stored parameters needs no driver: CO_IF_DRV.Nvm may be null.
#ifndef CO_NVM_TEMPLATE_H_
#define CO_NVM_TEMPLATE_H_

#include "co_if_nvm.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The driver, for CO_IF_DRV.Nvm.
extern const CO_IF_NVM_DRV TemplateNvmDriver;

#ifdef __cplusplus
}
#endif

#endif
