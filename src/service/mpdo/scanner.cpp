// SPDX-License-Identifier: Apache-2.0
// Marks of the objects in the object scanner list: pending, sent.
#include "co_assert.h"
#include "service/mpdo/lists.hpp"
#include "service/pdo/multiplex.hpp"

#if CO_MPDO_N > 0

namespace co::mpdo {
namespace {

bool get(const uint8_t* bits, uint16_t place) { return (bits[place / 8U] & (1U << (place % 8U))) != 0; }
void put(uint8_t* bits, uint16_t place) {
  bits[place / 8U] = static_cast<uint8_t>(bits[place / 8U] | 1U << (place % 8U));
}
void clear(uint8_t* bits, uint16_t place) {
  bits[place / 8U] = static_cast<uint8_t>(bits[place / 8U] & ~(1U << (place % 8U)));
}

}  // namespace

bool mark(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  CO_ASSERT(mpdo.ScanNum <= CO_MPDO_N);
  bool found = false;
  for (uint16_t place = 0; place < mpdo.ScanNum; ++place) {
    if (mpdo.Scan[place] == entry) {
      put(mpdo.Waiting, place);
      found = true;
    }
  }
  return found;
}

void mark_all(CO_PDO& pdo) {
  CO_MPDO& mpdo = pdo.Node->Mpdo;
  CO_ASSERT(mpdo.ScanNum <= CO_MPDO_N);
  for (uint16_t place = 0; is_sam(pdo.Map) && place < mpdo.ScanNum; ++place) {
    put(mpdo.Waiting, place);
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

bool next(CO_NODE& node, uint16_t& place) {
  const CO_MPDO& mpdo = node.Mpdo;
  place = mpdo.NextObject;
  for (uint16_t n = 0; n < mpdo.ScanNum; ++n, ++place) {
    place = place < mpdo.ScanNum ? place : 0;
    if (get(mpdo.Waiting, place)) {
      return true;
    }
  }
  return false;
}

// Checks the list again, because a callback may have changed it.
void finish_object(CO_NODE& node, uint16_t place, uint16_t entry, bool sent) {
  CO_MPDO& mpdo = node.Mpdo;
  if (place >= mpdo.ScanNum || mpdo.Scan[place] != entry) {
    return;
  }
  clear(mpdo.Waiting, place);
  mpdo.NextObject = static_cast<uint16_t>(place + 1);
  if (sent) {
    put(mpdo.Transferred, place);
  }
}

bool was_sent(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  bool was = false;
  for (uint16_t place = 0; place < mpdo.ScanNum; ++place) {
    if (mpdo.Scan[place] == entry) {
      was |= get(mpdo.Transferred, place);
      clear(mpdo.Transferred, place);
    }
  }
  return was;
}

Transferred transferred(CO_NODE& node, uint16_t entry) {
  CO_MPDO& mpdo = node.Mpdo;
  unsigned place = 0;
  while (place < mpdo.ScanNum && mpdo.Scan[place] != entry) {
    ++place;
  }
  return {mpdo.Transferred, place, mpdo.ScanNum};
}

}  // namespace co::mpdo

#endif
