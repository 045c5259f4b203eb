// SPDX-License-Identifier: Apache-2.0
/// \file memory.h
/// Memories of the examples.
#ifndef MEMORY_H_
#define MEMORY_H_

#include "co_nvm_eeprom_i2c.h"
#include "co_nvm_eeprom_spi.h"
#include "flash_stm32.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_EEPROM_I2C EepromI2c;  ///< eeprom_i2c_pins.c
extern const CO_EEPROM_SPI EepromSpi;  ///< eeprom_spi_pins.c

/// Frees the I2C bus. Call it before CONodeInitEx().
void EepromI2cFree(void);

#ifdef __cplusplus
}
#endif

#endif
