// SPDX-License-Identifier: Apache-2.0
#include "co_nvm_template.h"

// Context of all functions: the loop. They may take their time: they are called at the start, at an NMT reset and when
// parameters are stored, never in normal operation. The addresses are those that the application has given to its
// parameter groups, from 0.

// Prepare the memory and the bus (SPI, I2C) to it.
static void Init(void) {
  // Here: pins, clock, write protection.
}

// Read size bytes from address start. Returns the bytes read; fewer than size means: broken, or behind the end.
static uint32_t Read(uint32_t start, uint8_t* buffer, uint32_t size) {
  CO_UNUSED(start);
  CO_UNUSED(buffer);
  CO_UNUSED(size);
  return 0;
}

// Write size bytes to address start, across page boundaries where the memory has pages. Returns the bytes that are
// safely stored: wait for the end of the last write cycle, and better read them back.
static uint32_t Write(uint32_t start, uint8_t* buffer, uint32_t size) {
  CO_UNUSED(start);
  CO_UNUSED(buffer);
  CO_UNUSED(size);
  return 0;
}

const CO_IF_NVM_DRV TemplateNvmDriver = {Init, Read, Write};
