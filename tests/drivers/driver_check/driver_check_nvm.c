// SPDX-License-Identifier: Apache-2.0
#include <string.h>

#include "driver_check.h"

#define BUFFER_BYTES 256u
#define ERASED 0xFFu

// The memory and its driver. Written data are a pattern of the address, so that bytes at wrong addresses are detected.
typedef struct NVM_T {
  CO_DRIVER_CHECK* Check;
  const CO_IF_NVM_DRV* Plain;
  const CO_IF_NVM_DRV_EX* Ex;
  void* Ctx;
  CO_NVM_SHAPE Shape;
} NVM;

static uint8_t Buffer[BUFFER_BYTES + 2];

static uint32_t Read(const NVM* nvm, uint32_t start, uint8_t* to, uint32_t size) {
  return nvm->Ex != NULL ? nvm->Ex->Read(nvm->Ctx, start, to, size) : nvm->Plain->Read(start, to, size);
}

static uint32_t Write(const NVM* nvm, uint32_t start, uint8_t* from, uint32_t size) {
  return nvm->Ex != NULL ? nvm->Ex->Write(nvm->Ctx, start, from, size) : nvm->Plain->Write(start, from, size);
}

static void Init(const NVM* nvm) { nvm->Ex != NULL ? nvm->Ex->Init(nvm->Ctx) : nvm->Plain->Init(); }

static uint8_t Pattern(uint32_t address, uint8_t seed) {
  return (uint8_t)(seed ^ address * 7u ^ address >> 8 ^ address >> 16 ^ address >> 24);
}

// Returns the largest number of bytes that the buffer holds in whole units of programming.
static uint32_t Piece(const NVM* nvm) { return BUFFER_BYTES - BUFFER_BYTES % nvm->Shape.ProgramSize; }

static bool MakeWritable(const NVM* nvm) {
  const bool flash = nvm->Ex != NULL && nvm->Shape.EraseSize != 0;
  return !flash || (nvm->Ex->Erase != NULL && nvm->Ex->Erase(nvm->Ctx, 0, nvm->Shape.Capacity));
}

static bool WritePattern(const NVM* nvm, uint32_t start, uint32_t size, uint8_t seed) {
  for (uint32_t n = 0; n < size; ++n) {
    Buffer[n] = Pattern(start + n, seed);
  }
  return Write(nvm, start, Buffer, size) == size;
}

// Reads size bytes, and checks that the bytes beside them in the buffer do not change. Returns the index of the first
// wrong byte, or size.
static uint32_t FirstWrong(const NVM* nvm, uint32_t start, uint32_t size, uint8_t seed) {
  memset(Buffer, 0xC3, sizeof(Buffer));
  if (Read(nvm, start, Buffer + 1, size) != size || Buffer[0] != 0xC3 || Buffer[size + 1] != 0xC3) {
    return 0;
  }
  uint32_t n = 0;
  while (n < size && Buffer[n + 1] == Pattern(start + n, seed)) {
    ++n;
  }
  return n;
}

static bool Holds(const NVM* nvm, uint32_t start, uint32_t size, uint8_t seed) {
  return FirstWrong(nvm, start, size, seed) == size;
}

static bool WriteAll(const NVM* nvm, uint8_t seed) {
  for (uint32_t at = 0; at < nvm->Shape.Capacity;) {
    const uint32_t left = nvm->Shape.Capacity - at;
    const uint32_t size = left < Piece(nvm) ? left : Piece(nvm);
    if (!WritePattern(nvm, at, size, seed)) {
      return false;
    }
    at += size;
  }
  return true;
}

// Returns the first address with wrong data, or the capacity.
static uint32_t FindWrong(const NVM* nvm, uint8_t seed) {
  for (uint32_t at = 0; at < nvm->Shape.Capacity;) {
    const uint32_t left = nvm->Shape.Capacity - at;
    const uint32_t size = left < BUFFER_BYTES ? left : BUFFER_BYTES;
    const uint32_t good = FirstWrong(nvm, at, size, seed);
    if (good != size) {
      return at + good;
    }
    at += size;
  }
  return nvm->Shape.Capacity;
}

static void CheckShape(const NVM* nvm) {
  const CO_NVM_SHAPE s = nvm->Shape;
  const uint32_t unit = s.EraseSize == 0 ? s.ProgramSize : s.EraseSize;
  if (unit == 0 || s.ProgramSize == 0 || s.EraseSize % s.ProgramSize != 0 || s.Capacity % unit != 0) {
    CheckFail(nvm->Check, "nvm.shape", "Capacity is not a multiple of EraseSize, or EraseSize not of ProgramSize");
  } else if (s.ProgramSize > CO_STORE_BUFFER || s.Capacity / unit < 2) {
    CheckFail(nvm->Check, "nvm.shape",
              "ProgramSize exceeds CO_STORE_BUFFER, or the memory has fewer than two erase units");
  } else if (s.EraseSize != 0 && nvm->Ex->Erase == NULL) {
    CheckFail(nvm->Check, "nvm.shape", "EraseSize is not 0, but the driver has no Erase function");
  } else {
    CheckSay(nvm->Check, CHECK_OK, "nvm.shape", "# bytes, in units of #", s.Capacity, unit);
  }
}

static void CheckWhole(const NVM* nvm) {
  for (uint8_t pass = 0; pass < 2; ++pass) {
    const uint8_t seed = pass == 0 ? 0x5A : 0xA5;
    if (!MakeWritable(nvm) || !WriteAll(nvm, seed)) {
      CheckFail(nvm->Check, "nvm.whole", "the whole memory cannot be erased and written");
      return;
    }
    const uint32_t wrong = FindWrong(nvm, seed);
    if (wrong != nvm->Shape.Capacity) {
      CheckSay(nvm->Check, CHECK_FAILED, "nvm.whole", "address $h does not hold the written byte", wrong, 0);
      return;
    }
  }
  CheckSay(nvm->Check, CHECK_OK, "nvm.whole", "# bytes were written twice and read back", nvm->Shape.Capacity, 0);
}

// Reads at unaligned addresses and of any size. Must be called after nvm.whole: the memory then holds the pattern.
static void CheckReads(const NVM* nvm) {
  const uint32_t top = nvm->Shape.Capacity < BUFFER_BYTES ? nvm->Shape.Capacity : BUFFER_BYTES;
  for (uint32_t start = 0; start < 9 && start < top; ++start) {
    for (uint32_t size = 0; start + size <= top; ++size) {
      const bool first = Holds(nvm, start, size, 0xA5);
      const bool last = Holds(nvm, nvm->Shape.Capacity - start - size, size, 0xA5);
      if (!first || !last) {
        CheckSay(nvm->Check, CHECK_FAILED, "nvm.read",
                 "# bytes from address # (or at this distance from the end) are read wrongly", size, start);
        return;
      }
    }
  }
  CheckPass(nvm->Check, "nvm.read", "all lengths are read from all addresses");
}

static void CheckKept(const NVM* nvm) {
  Init(nvm);
  if (FindWrong(nvm, 0xA5) != nvm->Shape.Capacity) {
    CheckFail(nvm->Check, "nvm.kept", "Init changes the stored data");
    return;
  }
  CheckPass(nvm->Check, "nvm.kept", "Init keeps the stored data");
}

// Erases whole units from address 0 on that contain at least size bytes. For flash only.
static bool EraseFront(const NVM* nvm, uint32_t size) {
  const uint32_t unit = nvm->Shape.EraseSize;
  return nvm->Ex->Erase(nvm->Ctx, 0, (size + unit - 1) / unit * unit);
}

static bool IsErased(const NVM* nvm, uint32_t start, uint32_t size) {
  for (uint32_t n = 0; n < size; ++n) {
    uint8_t byte = 0;
    if (Read(nvm, start + n, &byte, 1) != 1 || byte != ERASED) {
      return false;
    }
  }
  return true;
}

// Overwrites a range and checks that the adjacent bytes do not change.
static bool Overwrites(const NVM* nvm, uint32_t start, uint32_t size) {
  const uint32_t unit = nvm->Shape.ProgramSize;
  const uint32_t end = start + size;
  return WritePattern(nvm, start - unit, unit, 0x11) && WritePattern(nvm, end, unit, 0x11) &&
         WritePattern(nvm, start, size, 0x22) && Holds(nvm, start, size, 0x22) &&
         Holds(nvm, start - unit, unit, 0x11) && Holds(nvm, end, unit, 0x11);
}

// Programs a range and checks that the adjacent bytes stay erased.
static bool Programs(const NVM* nvm, uint32_t start, uint32_t size) {
  const uint32_t unit = nvm->Shape.ProgramSize;
  return EraseFront(nvm, start + size + unit) && WritePattern(nvm, start, size, 0x22) &&
         Holds(nvm, start, size, 0x22) && IsErased(nvm, start - unit, unit) && IsErased(nvm, start + size, unit);
}

static void CheckWrites(const NVM* nvm) {
  static const uint8_t units[] = {1, 2, 3, 5, 8, 15, 16, 17, 31, 32, 33, 63, 64, 65, 100, 128, 130, 200};
  const uint32_t unit = nvm->Shape.ProgramSize;
  for (uint32_t n = 0; n < sizeof(units); ++n) {
    const uint32_t size = units[n] * unit;
    const uint32_t start = (n % 3 + 1) * unit;
    if (size > Piece(nvm) || start + size + unit > nvm->Shape.Capacity) {
      break;
    }
    const bool good = nvm->Shape.EraseSize == 0 ? Overwrites(nvm, start, size) : Programs(nvm, start, size);
    if (!good) {
      CheckSay(nvm->Check, CHECK_FAILED, "nvm.write", "writing # bytes to address # fails or changes other bytes", size,
               start);
      return;
    }
  }
  CheckPass(nvm->Check, "nvm.write", "pieces of all sizes are written without changes to other bytes");
}

static void CheckBuffer(const NVM* nvm) {
  const uint32_t size = Piece(nvm) < nvm->Shape.Capacity ? Piece(nvm) : nvm->Shape.ProgramSize;
  bool same = MakeWritable(nvm) && WritePattern(nvm, 0, size, 0x3C);
  for (uint32_t n = 0; n < size; ++n) {
    same = same && Buffer[n] == Pattern(n, 0x3C);
  }
  if (!same) {
    CheckFail(nvm->Check, "nvm.buffer", "Write changes the buffer of its caller");
    return;
  }
  CheckPass(nvm->Check, "nvm.buffer", "Write does not change the buffer of its caller");
}

// Accesses addresses beyond the end of the memory. Returns the fault, or null.
static const char* Overflow(const NVM* nvm, uint32_t start, uint32_t size) {
  memset(Buffer, 0, sizeof(Buffer));
  if (Read(nvm, start, Buffer, size) >= size) {
    return "# bytes are read from address $h, beyond the end";
  }
  if (Write(nvm, start, Buffer, size) >= size) {
    return "# bytes are written to address $h, beyond the end";
  }
  return NULL;
}

static void CheckOverflow(const NVM* nvm) {
  const uint32_t unit = nvm->Shape.ProgramSize;
  const uint32_t end = nvm->Shape.Capacity;
  const uint32_t starts[] = {end, end - unit, end + 4 * unit, 0u - unit};
  if (!MakeWritable(nvm) || !WriteAll(nvm, 0x77)) {
    CheckFail(nvm->Check, "nvm.overflow", "the memory cannot be written");
    return;
  }
  for (size_t n = 0; n < sizeof(starts) / sizeof(starts[0]); ++n) {
    const char* const wrong = Overflow(nvm, starts[n], 2 * unit);
    if (wrong != NULL) {
      CheckSay(nvm->Check, CHECK_FAILED, "nvm.overflow", wrong, 2 * unit, starts[n]);
      return;
    }
  }
  if (!Holds(nvm, 0, unit, 0x77)) {
    CheckFail(nvm->Check, "nvm.overflow", "a write beyond the end has changed the beginning");
    return;
  }
  CheckPass(nvm->Check, "nvm.overflow", "an access beyond the end is refused or truncated");
}

static void CheckErase(const NVM* nvm) {
  const uint32_t unit = nvm->Shape.EraseSize;
  const uint32_t last = nvm->Shape.Capacity - unit;
  if (!MakeWritable(nvm) || !WriteAll(nvm, 0x66) || !nvm->Ex->Erase(nvm->Ctx, last, unit)) {
    CheckFail(nvm->Check, "nvm.erase", "the last unit cannot be erased");
  } else if (!IsErased(nvm, last, unit)) {
    CheckFail(nvm->Check, "nvm.erase", "an erased byte is not FFh");
  } else if (!Holds(nvm, last - 1, 1, 0x66) || !Holds(nvm, 0, 1, 0x66)) {
    CheckFail(nvm->Check, "nvm.erase", "Erase changes bytes outside its range");
  } else if (nvm->Ex->Erase(nvm->Ctx, nvm->Shape.Capacity, unit) || !Holds(nvm, 0, 1, 0x66)) {
    CheckFail(nvm->Check, "nvm.erase", "an erase beyond the end is not refused");
  } else {
    CheckSay(nvm->Check, CHECK_OK, "nvm.erase", "a unit of # bytes is erased to FFh without changes to others", unit,
             0);
  }
}

static bool FindMemory(NVM* nvm, CO_DRIVER_CHECK* c) {
  memset(nvm, 0, sizeof(*nvm));
  nvm->Check = c;
  nvm->Shape.Capacity = c->NvmSize;
  nvm->Shape.ProgramSize = 1;
  if (c->Ext != NULL && c->Ext->Nvm != NULL) {
    nvm->Ex = c->Ext->Nvm;
    nvm->Ctx = c->Ext->NvmCtx;
  } else {
    nvm->Plain = c->Drv == NULL ? NULL : c->Drv->Nvm;
  }
  return nvm->Ex != NULL || nvm->Plain != NULL;
}

void CODriverCheckNvm(CO_DRIVER_CHECK* check) {
  NVM nvm;
  if (!FindMemory(&nvm, check)) {
    CheckSkip(check, "nvm", "no driver is set");
    return;
  }
  Init(&nvm);
  if (nvm.Ex != NULL && nvm.Ex->Shape != NULL) {
    nvm.Shape = nvm.Ex->Shape(nvm.Ctx);
    const uint16_t failed = check->Failed;
    CheckShape(&nvm);
    if (check->Failed != failed) {
      return;
    }
  }
  if (nvm.Shape.Capacity < 4 * nvm.Shape.ProgramSize || nvm.Shape.ProgramSize > BUFFER_BYTES) {
    CheckSkip(check, "nvm", "the size of the memory is unknown or too small");
    return;
  }
  CheckWhole(&nvm);
  CheckReads(&nvm);
  CheckKept(&nvm);
  CheckWrites(&nvm);
  CheckBuffer(&nvm);
  CheckOverflow(&nvm);
  if (nvm.Shape.EraseSize != 0) {
    CheckErase(&nvm);
  }
}
