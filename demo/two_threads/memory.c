// SPDX-License-Identifier: Apache-2.0
#include "memory.h"

#include <string.h>

#include "clock.h"

#define CAPACITY 4096u
#define ERASE_SIZE 1024u
#define PROGRAM_SIZE 8u
#define PROGRAM_MICROSECONDS 300u  // for each call of Write()
#define ERASE_MICROSECONDS 4000u

static uint8_t Bytes[CAPACITY];

static void Init(void* ctx) { CO_UNUSED(ctx); }

static bool IsInside(uint32_t start, uint32_t size) { return start <= CAPACITY && size <= CAPACITY - start; }

static uint32_t Read(void* ctx, uint32_t start, uint8_t* buffer, uint32_t size) {
  CO_UNUSED(ctx);
  if (!IsInside(start, size)) {
    return 0;
  }
  memcpy(buffer, &Bytes[start], size);
  return size;
}

static uint32_t Write(void* ctx, uint32_t start, const uint8_t* buffer, uint32_t size) {
  CO_UNUSED(ctx);
  if (!IsInside(start, size)) {
    return 0;
  }
  ClockWait(PROGRAM_MICROSECONDS);
  memcpy(&Bytes[start], buffer, size);
  return size;
}

static bool Erase(void* ctx, uint32_t start, uint32_t size) {
  CO_UNUSED(ctx);
  if (!IsInside(start, size)) {
    return false;
  }
  ClockWait(ERASE_MICROSECONDS);
  memset(&Bytes[start], 0xFF, size);
  return true;
}

static CO_NVM_SHAPE Shape(void* ctx) {
  const CO_NVM_SHAPE shape = {CAPACITY, PROGRAM_SIZE, ERASE_SIZE};
  CO_UNUSED(ctx);
  return shape;
}

const CO_IF_NVM_DRV_EX SlowMemoryDriver = {Init, Read, Write, Erase, Shape};
