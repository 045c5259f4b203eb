/* SPDX-License-Identifier: Apache-2.0 */
/**
 * \file lexican_model.h
 * Access of a driver to modelled registers. A driver that is compiled for host tests calls these functions in place of
 * volatile accesses. Only aligned 32-bit accesses exist.
 */
#ifndef LEXICAN_MODEL_H_
#define LEXICAN_MODEL_H_

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Reads the register of the model whose address range holds the address. Returns 0 and records a fault if none does.
 */
uint32_t lexican_model_read(uintptr_t address);

/** Writes the register of the model whose address range holds the address. Records a fault if none does. */
void lexican_model_write(uintptr_t address, uint32_t value);

#ifdef __cplusplus
}
#endif

#endif
