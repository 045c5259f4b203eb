// SPDX-License-Identifier: Apache-2.0
// Marks of the objects in the object scanner list: pending, sent.
#include "co_assert.h"
#include "service/mpdo/lists.hpp"
#include "service/pdo/multiplex.hpp"

#if CO_MPDO_N > 0

namespace co::mpdo {
namespace {

bool has_bit(const uint8_t* bits, uint16_t position) { return (bits[position / 8U] & (1U << (position % 8U))) != 0; }
void set_bit(uint8_t* bits, uint16_t position) {
  bits[position / 8U] = static_cast<uint8_t>(bits[position / 8U] | 1U << (position % 8U));
}
void clear_bit(uint8_t* bits, uint16_t position) {
  bits[position / 8U] = static_cast<uint8_t>(bits[position / 8U] & ~(1U << (position % 8U)));
}

}  // namespace

bool mark(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  CO_ASSERT(mpdo.ScanNum <= CO_MPDO_N);
  bool found = false;
  for (uint16_t position = 0; position < mpdo.ScanNum; ++position) {
    if (mpdo.Scan[position] == entry) {
      set_bit(mpdo.Waiting, position);
      found = true;
    }
  }
  return found;
}

void mark_all(CO_PDO& pdo) {
  CO_MPDO& mpdo = pdo.Node->Mpdo;
  CO_ASSERT(mpdo.ScanNum <= CO_MPDO_N);
  for (uint16_t position = 0; is_sam(pdo.Map) && position < mpdo.ScanNum; ++position) {
    set_bit(mpdo.Waiting, position);
  }
}

void clear_marks(CO_NODE& node) { __builtin_memset(node.Mpdo.Waiting, 0, sizeof node.Mpdo.Waiting); }

bool is_waiting(const CO_NODE& node) {
  uint8_t any = 0;
  for (const uint8_t bits : node.Mpdo.Waiting) {
    any |= bits;
  }
  return any != 0;
}

bool next(CO_NODE& node, uint16_t& position) {
  const CO_MPDO& mpdo = node.Mpdo;
  position = mpdo.NextObject;
  for (uint16_t n = 0; n < mpdo.ScanNum; ++n, ++position) {
    position = position < mpdo.ScanNum ? position : 0;
    if (has_bit(mpdo.Waiting, position)) {
      return true;
    }
  }
  return false;
}

// Checks the list again, because a callback may have changed it.
void finish_object(CO_NODE& node, uint16_t position, uint16_t entry, bool sent) {
  CO_MPDO& mpdo = node.Mpdo;
  if (position >= mpdo.ScanNum || mpdo.Scan[position] != entry) {
    return;
  }
  clear_bit(mpdo.Waiting, position);
  mpdo.NextObject = static_cast<uint16_t>(position + 1);
  if (sent) {
    set_bit(mpdo.Transferred, position);
  }
}

bool was_sent(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  bool was = false;
  for (uint16_t position = 0; position < mpdo.ScanNum; ++position) {
    if (mpdo.Scan[position] == entry) {
      was |= has_bit(mpdo.Transferred, position);
      clear_bit(mpdo.Transferred, position);
    }
  }
  return was;
}

Transferred transferred(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  unsigned position = 0;
  while (position < mpdo.ScanNum && mpdo.Scan[position] != entry) {
    ++position;
  }
  return {mpdo.Transferred, position, mpdo.ScanNum};
}

}  // namespace co::mpdo

#endif
