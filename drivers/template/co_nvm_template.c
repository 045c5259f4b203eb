// SPDX-License-Identifier: Apache-2.0
#include "co_nvm_template.h"

// Here: the size of the memory, and of the pages across which it cannot be written at once (1: there are none).
#define MEMORY_BYTES 2048u
#define PAGE_BYTES 32u

// Here: read bytes; the range is within the memory. Return false if the memory does not answer.
static bool ReadMemory(uint32_t start, uint8_t* to, uint32_t size) {
  CO_UNUSED(start);
  CO_UNUSED(to);
  CO_UNUSED(size);
  return false;
}

// Here: write a part of one page, wait for the end of the write cycle, and preferably read it back. Do not change the
// bytes at from: they are the parameters themselves. Return false if they are not stored.
static bool WritePage(uint32_t start, const uint8_t* from, uint32_t size) {
  CO_UNUSED(start);
  CO_UNUSED(from);
  CO_UNUSED(size);
  return false;
}

// Returns the number of bytes of an access that are within the memory.
static uint32_t Inside(uint32_t start, uint32_t size) {
  const uint32_t left = start < MEMORY_BYTES ? MEMORY_BYTES - start : 0;
  return size < left ? size : left;
}

// Context of all functions: the loop. They may block for a while: they are called at the start, at an NMT reset and
// when parameters are stored, never in normal operation. The addresses are those that the application has set in its
// parameter groups, from 0.

// Prepare the memory and its bus (SPI, I2C). Do not change the stored data.
static void Init(void) {
  // Here: pins, clock, write protection.
}

// Read size bytes from address start. Returns the number of bytes read; fewer than size mean an error, or the end of
// the memory.
static uint32_t Read(uint32_t start, uint8_t* buffer, uint32_t size) {
  const uint32_t inside = Inside(start, size);
  return inside == 0 || ReadMemory(start, buffer, inside) ? inside : 0;
}

// Write size bytes to address start. Returns the number of bytes that are safely stored; fewer than size mean an error,
// or the end of the memory.
static uint32_t Write(uint32_t start, uint8_t* buffer, uint32_t size) {
  const uint32_t inside = Inside(start, size);
  uint32_t done = 0;
  while (done < inside) {
    const uint32_t room = PAGE_BYTES - (start + done) % PAGE_BYTES;
    const uint32_t piece = inside - done < room ? inside - done : room;
    if (!WritePage(start + done, buffer + done, piece)) {
      break;
    }
    done += piece;
  }
  return done;
}

const CO_IF_NVM_DRV TemplateNvmDriver = {Init, Read, Write};
