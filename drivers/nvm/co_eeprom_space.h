// SPDX-License-Identifier: Apache-2.0
/// \file co_eeprom_space.h
/// Bytes that a parameter group occupies in an EEPROM, for the drivers eeprom_i2c and eeprom_spi.
#ifndef CO_EEPROM_SPACE_H_
#define CO_EEPROM_SPACE_H_

#include "co_para.h"

/// Returns the bytes of memory that a group of \a size bytes occupies in an EEPROM with pages of \a page bytes (0:
/// FRAM). CO_PARA.Offset must be a multiple of CO_EEPROM_UNIT(page). The result depends on CO_STORE_BUFFER: if this
/// setting is changed, records that were stored before cannot be read.
#define CO_EEPROM_SPACE(size, page) CO_PARA_SPACE(size, CO_EEPROM_UNIT(page), CO_EEPROM_PROGRAM(page))
#define CO_EEPROM_UNIT(page) ((page) == 0u ? 1u : (uint32_t)(page))  ///< unit of CO_PARA.Offset
/// Unit of programming that the drivers report, in bytes.
#define CO_EEPROM_PROGRAM(page) ((page) > CO_STORE_BUFFER ? 1u : CO_EEPROM_UNIT(page))

#endif
