// SPDX-License-Identifier: Apache-2.0
/// \file memory.h
/// Memories of the examples.
#ifndef MEMORY_H_
#define MEMORY_H_

#include "co_nvm_eeprom_i2c.h"
#include "co_nvm_eeprom_spi.h"
#include "co_nvm_flash_pages.h"

#ifdef __cplusplus
extern "C" {
#endif

extern const CO_FLASH_PAGES FlashStm32f4;  ///< flash_stm32f4.c
extern const CO_FLASH_PAGES FlashStm32g4;  ///< flash_stm32g4.c
extern const CO_FLASH_PAGES FlashStm32h7;  ///< flash_stm32h7.c
extern const CO_EEPROM_I2C EepromI2c;      ///< eeprom_i2c_pins.c
extern const CO_EEPROM_SPI EepromSpi;      ///< eeprom_spi_pins.c

/// Notes that a damaged double word was read. Call it in NMI_Handler() of an STM32G4.
void FlashStm32g4Nmi(void);

/// Frees the I2C bus. Call it before CONodeInitEx().
void EepromI2cFree(void);

#ifdef __cplusplus
}
#endif

#endif
