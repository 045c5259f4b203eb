// SPDX-License-Identifier: Apache-2.0
/// \file pins.h
/// Functions of the board that eeprom_i2c_pins.c and eeprom_spi_pins.c need. The board defines them.
#ifndef PINS_H_
#define PINS_H_

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Waits for at least the given time.
void BoardWaitMicroseconds(uint32_t microseconds);

/// \name I2C: two pins with open drain and a pull-up resistor each
/// \{
void BoardSetScl(bool high);  ///< true: releases the line
void BoardSetSda(bool high);  ///< true: releases the line
bool BoardGetScl(void);       ///< returns the level of the line
bool BoardGetSda(void);       ///< returns the level of the line
/// \}

/// \name SPI: three outputs and an input
/// \{
void BoardSetCs(bool high);    ///< chip select, high at the start
void BoardSetSck(bool high);   ///< clock, low at the start
void BoardSetMosi(bool high);  ///< SI of the memory
bool BoardGetMiso(void);       ///< returns the level of SO of the memory
/// \}

#ifdef __cplusplus
}
#endif

#endif
