// SPDX-License-Identifier: Apache-2.0
// Parameters in an EEPROM 25LC256 on four pins of any microcontroller, SPI mode 0,0.
#include "memory.h"
#include "pins.h"

static void Select(void* ctx, bool selected) {
  (void)ctx;
  BoardSetCs(!selected);
  BoardWaitMicroseconds(1);
}

static void Transfer(void* ctx, const uint8_t* out, uint8_t* in, uint32_t num) {
  (void)ctx;
  for (uint32_t n = 0; n < num; ++n) {
    uint8_t byte = out == NULL ? 0 : out[n];
    for (unsigned bit = 0; bit < 8; ++bit) {
      BoardSetMosi((byte & 0x80) != 0);
      BoardSetSck(true);
      byte = (uint8_t)(byte << 1 | (BoardGetMiso() ? 1 : 0));
      BoardSetSck(false);
    }
    if (in != NULL) {
      in[n] = byte;
    }
  }
}

static void Wait(void* ctx, uint32_t microseconds) {
  (void)ctx;
  BoardWaitMicroseconds(microseconds);
}

static const CO_EEPROM_SPI_BUS Bus = {Select, Transfer, Wait};
const CO_EEPROM_SPI EepromSpi = {.Bus = &Bus, .Capacity = 32768, .PageSize = 64, .AddressBytes = 2, .WriteTime = 5};
