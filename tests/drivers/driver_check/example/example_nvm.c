// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "example_board.h"

static bool ReadMemory(uint32_t start, uint8_t* to, uint32_t size) { return ExampleEepromRead(start, to, size); }

// Writes within a page. Returns true if the data, read back, are equal.
static bool WritePage(uint32_t start, const uint8_t* from, uint32_t size) {
  uint8_t stored[EXAMPLE_EEPROM_PAGE];
  return ExampleEepromWrite(start, from, size) && ExampleEepromRead(start, stored, size) &&
         memcmp(stored, from, size) == 0;
}

static uint32_t Inside(uint32_t start, uint32_t size) {
  const uint32_t left = start < EXAMPLE_EEPROM_SIZE ? EXAMPLE_EEPROM_SIZE - start : 0;
  return size < left ? size : left;
}

static void Init(void) {}

static uint32_t Read(uint32_t start, uint8_t* buffer, uint32_t size) {
  const uint32_t inside = Inside(start, size);
  return inside == 0 || ReadMemory(start, buffer, inside) ? inside : 0;
}

static uint32_t Write(uint32_t start, uint8_t* buffer, uint32_t size) {
  const uint32_t inside = Inside(start, size);
  uint32_t done = 0;
  while (done < inside) {
    const uint32_t room = EXAMPLE_EEPROM_PAGE - (start + done) % EXAMPLE_EEPROM_PAGE;
    const uint32_t piece = inside - done < room ? inside - done : room;
    if (!WritePage(start + done, buffer + done, piece)) {
      break;
    }
    done += piece;
  }
  return done;
}

const CO_IF_NVM_DRV ExampleNvmDriver = {Init, Read, Write};
