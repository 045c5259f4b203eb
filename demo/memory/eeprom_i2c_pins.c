// SPDX-License-Identifier: Apache-2.0
// Parameters in an EEPROM 24LC256 on two pins of any microcontroller, at 100 kbit/s at most.
#include "memory.h"
#include "pins.h"

#define HALF_BIT 5u       // microseconds
#define STRETCH_MAX 100u  // half bits for which a device may hold SCL low

static void Wait(void* ctx, uint32_t microseconds) {
  (void)ctx;
  BoardWaitMicroseconds(microseconds);
}

// Releases SCL. Returns false if it stays low.
static bool RaiseScl(void) {
  BoardSetScl(true);
  for (uint32_t n = 0; n < STRETCH_MAX; ++n) {
    BoardWaitMicroseconds(HALF_BIT);
    if (BoardGetScl()) {
      return true;
    }
  }
  return false;
}

// Transmits a bit (true also for a bit to be received). Returns the level of SDA.
static bool TransferBit(bool bit) {
  BoardSetSda(bit);
  BoardWaitMicroseconds(HALF_BIT);
  const bool level = RaiseScl() && BoardGetSda();
  BoardSetScl(false);
  return level;
}

// Transmits a start condition. Returns false if a line is stuck.
static bool Start(void) {
  BoardSetSda(true);
  BoardWaitMicroseconds(HALF_BIT);
  if (!RaiseScl() || !BoardGetSda()) {
    return false;
  }
  BoardSetSda(false);
  BoardWaitMicroseconds(HALF_BIT);
  BoardSetScl(false);
  return true;
}

static void Stop(void) {
  BoardSetSda(false);
  BoardWaitMicroseconds(HALF_BIT);
  (void)RaiseScl();
  BoardSetSda(true);
  BoardWaitMicroseconds(HALF_BIT);
}

// Returns whether the device has acknowledged the byte.
static bool SendByte(uint8_t byte) {
  for (uint8_t mask = 0x80; mask != 0; mask >>= 1) {
    (void)TransferBit((byte & mask) != 0);
  }
  return !TransferBit(true);
}

static uint8_t ReceiveByte(bool acknowledge) {
  uint8_t byte = 0;
  for (unsigned n = 0; n < 8; ++n) {
    byte = (uint8_t)(byte << 1 | (TransferBit(true) ? 1 : 0));
  }
  (void)TransferBit(!acknowledge);
  return byte;
}

static bool SendBytes(const uint8_t* bytes, uint32_t num) {
  uint32_t n = 0;
  while (n < num && SendByte(bytes[n])) {
    ++n;
  }
  return n == num;
}

static bool I2cWrite(void* ctx, uint8_t device, const uint8_t* head, uint8_t headNum, const uint8_t* bytes,
                     uint32_t num) {
  (void)ctx;
  const bool done = Start() && SendByte((uint8_t)(device << 1)) && SendBytes(head, headNum) && SendBytes(bytes, num);
  Stop();
  return done;
}

static bool I2cRead(void* ctx, uint8_t device, const uint8_t* head, uint8_t headNum, uint8_t* to, uint32_t num) {
  (void)ctx;
  const bool found = Start() && SendByte((uint8_t)(device << 1)) && SendBytes(head, headNum) && Start() &&
                     SendByte((uint8_t)(device << 1 | 1));
  for (uint32_t n = 0; found && n < num; ++n) {
    to[n] = ReceiveByte(n + 1 < num);
  }
  Stop();
  return found;
}

// Frees SDA, which the memory holds low if the CPU was reset while it was reading. Call this before CONodeInitEx().
void EepromI2cFree(void) {
  for (unsigned n = 0; n < 9 && !BoardGetSda(); ++n) {
    (void)TransferBit(true);
  }
  Stop();
}

static const CO_EEPROM_I2C_BUS Bus = {I2cWrite, I2cRead, Wait};
const CO_EEPROM_I2C EepromI2c = {
    .Bus = &Bus, .Capacity = 32768, .PageSize = 64, .Device = 0x50, .AddressBytes = 2, .WriteTime = 5};
